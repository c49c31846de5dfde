"""AEDAT 4.0 as iniVation's DV writes it: header, packets of events and intensity frames, file table."""

import lz4.frame
import numpy as np

from . import scene
from .flatbuffer import Scalar, String, Tables, Vector, size_prefixed

LZ4 = 1
EVENTS, FRAMES = 0, 1  # stream ids
PACKET_US = 10_000
EVENT = np.dtype({"names": ["t", "x", "y", "on"], "formats": ["<i8", "<i2", "<i2", "u1"], "itemsize": 16})


def write(path, events, frames, offset_us):
    packets = _event_packets(events, offset_us) + _frame_packets(frames, offset_us)
    packets.sort(key=lambda packet: packet["end_us"])
    body, rows = bytearray(), []
    header_size = len(_header(0, offset_us))
    for packet in packets:
        payload = _compressed(packet["data"])
        body += np.array([packet["stream"], len(payload)], "<i4").tobytes()
        rows.append(_table_row(packet, header_size + len(body), len(payload)))
        body += payload
    table = _compressed(size_prefixed("FTAB", [Tables(rows)]))
    path.write_bytes(_header(header_size + len(body), offset_us) + body + table)


def _table_row(packet, offset, size):
    """`offset` is the payload's, behind the packet's 8-byte header."""
    times = _i64(packet["begin_us"]), _i64(packet["end_us"])
    return [_i64(offset), Scalar("ii", (packet["stream"], size)), _i64(packet["elements"]), *times]


def _compressed(data):
    """One LZ4 frame of linked 64 KB blocks without its content's size, as the real recordings have it."""
    block = lz4.frame.BLOCKSIZE_MAX64KB
    return lz4.frame.compress(data, 9, block_size=block, block_linked=True, store_size=False)


def _i64(value):
    return Scalar("q", (int(value),))


def _event_packets(events, offset_us):
    bounds = np.arange(0, events.t[-1] + PACKET_US + 1, PACKET_US)
    cuts = np.searchsorted(events.t, bounds)
    pieces = [events.slice(begin, end) for begin, end in zip(cuts, cuts[1:]) if end > begin]
    return [_event_packet(piece, offset_us) for piece in pieces]


def _event_packet(events, offset_us):
    rows = np.zeros(len(events.t), EVENT)
    rows["t"], rows["x"], rows["y"], rows["on"] = events.t + offset_us, events.x, events.y, events.on
    data = size_prefixed("EVTS", [Vector(len(rows), rows.tobytes(), align=8)])
    return dict(stream=EVENTS, data=data, elements=len(rows), begin_us=rows["t"][0], end_us=rows["t"][-1])


def _frame_packets(frames, offset_us):
    return [_frame_packet(frame, offset_us + frame.begin_us, offset_us + frame.end_us) for frame in frames]


def _frame_packet(frame, begin_us, end_us):
    """timestamp is the exposure's middle, format 0 is 8-bit grey, source 0 is the sensor."""
    height, width = frame.grey.shape
    times = [_i64(t) for t in ((begin_us + end_us) // 2, begin_us, end_us, begin_us, end_us)]
    place = [Scalar("h", (value,)) for value in (width, height, 0, 0)]
    pixels = Vector(frame.grey.size, frame.grey.tobytes())
    slots = [*times, Scalar("b", (0,)), *place, pixels, _i64(end_us - begin_us), Scalar("b", (0,))]
    data = size_prefixed("FRME", slots)
    return dict(stream=FRAMES, data=data, elements=1, begin_us=begin_us, end_us=end_us)


def _header(table_position, offset_us):
    streams = _stream(EVENTS, "events", "EVTS", "Array of events", offset_us)
    streams += _stream(FRAMES, "frames", "FRME", "Standard frame", offset_us)
    info = String('<dv version="2.0">' + _node("outInfo", "", streams) + "</dv>")
    return b"#!AER-DAT4.0\r\n" + size_prefixed("IOHE", [Scalar("i", (LZ4,)), _i64(table_position), info])


def _node(name, parent, content):
    return f'<node name="{name}" path="/mainloop/make_samples/{parent}{name}/">{content}</node>'


def _stream(number, output, identifier, description, offset_us):
    path = f"outInfo/{number}/"
    info = (
        _attribute("sizeX", "int", scene.WIDTH_PX)
        + _attribute("sizeY", "int", scene.HEIGHT_PX)
        + _attribute("source", "string", "esi_make_samples")
        + _attribute("tsOffset", "long", offset_us)
    )
    stream = (
        _attribute("compression", "string", "LZ4")
        + _attribute("originalModuleName", "string", "make_samples")
        + _attribute("originalOutputName", "string", output)
        + _attribute("typeDescription", "string", description)
        + _attribute("typeIdentifier", "string", identifier)
        + _node("info", path, info)
    )
    return _node(str(number), "outInfo/", stream)


def _attribute(key, kind, value):
    return f'<attr key="{key}" type="{kind}">{value}</attr>'
