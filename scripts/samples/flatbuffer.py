"""Just enough of FlatBuffers to write AEDAT 4: tables of scalars, structs, strings and vectors.

Written front to back: a table's vtable, its slots, then what the slots point at. References point forward, as
the format wants, and all data are aligned as counted from the size prefix.
"""

import dataclasses
import struct


@dataclasses.dataclass
class Scalar:
    """A number, or a struct of numbers, stored inside its table. `code` as module struct has it."""

    code: str
    values: tuple


@dataclasses.dataclass
class Vector:
    """Elements of equal size, aligned to `align`."""

    count: int
    data: bytes
    align: int = 4


@dataclasses.dataclass
class String:
    text: str


@dataclasses.dataclass
class Tables:
    """A vector of tables; each is a list like the root's."""

    rows: list


def size_prefixed(identifier, root):
    """A buffer with its size in front. `root` lists the slots in order, None where a slot is left out."""
    out = bytearray(8) + identifier.encode("ascii")
    position = _table(out, root)
    struct.pack_into("<I", out, 4, position - 4)
    _align(out, 8)
    struct.pack_into("<I", out, 0, len(out) - 4)
    return bytes(out)


def _align(out, align):
    out.extend(bytes(-len(out) % align))


def _table(out, slots):
    """Appends a table with all it refers to; returns where it is."""
    codes = [slot.code if isinstance(slot, Scalar) else "I" for slot in slots]
    _align(out, 8)
    vtable = len(out)
    out.extend(bytes(-(-(4 + 2 * len(slots)) // 8) * 8))
    table = len(out)
    out.extend(struct.pack("<i", table - vtable))
    used = [i for i, slot in enumerate(slots) if slot is not None]
    place = {}
    for i in sorted(used, key=lambda i: -_alignment(codes[i])):
        _align(out, _alignment(codes[i]))
        place[i] = len(out)
        values = slots[i].values if isinstance(slots[i], Scalar) else (0,)
        out.extend(struct.pack("<" + codes[i], *values))
    offsets = [place[i] - table if i in place else 0 for i in range(len(slots))]
    struct.pack_into(f"<HH{len(slots)}H", out, vtable, 4 + 2 * len(slots), len(out) - table, *offsets)
    for i, position in place.items():
        if not isinstance(slots[i], Scalar):
            struct.pack_into("<I", out, position, _content(out, slots[i]) - position)
    return table


def _alignment(code):
    return max(struct.calcsize("=" + letter) for letter in code)


def _content(out, value):
    """Appends a string or a vector; returns where its length is."""
    if isinstance(value, Tables):
        return _tables(out, value.rows)
    if isinstance(value, String):
        text = value.text.encode("utf-8")
        value = Vector(len(text), text + b"\0")
    _align(out, 4)
    while (len(out) + 4) % value.align:  # the elements, not the length before them, are aligned
        out.extend(bytes(4))
    position = len(out)
    out.extend(struct.pack("<I", value.count))
    out.extend(value.data)
    return position


def _tables(out, rows):
    _align(out, 4)
    position = len(out)
    out.extend(struct.pack("<I", len(rows)) + bytes(4 * len(rows)))
    for i, row in enumerate(rows):
        reference = position + 4 + 4 * i
        struct.pack_into("<I", out, reference, _table(out, row) - reference)
    return position
