"""Reads a pickle stream that torch wrote, and builds nothing but numbers, texts, containers and tensors.

A pickle can name any function of Python to be called. Here a name is either one of the few below, or an error.
"""

import collections
import dataclasses
import pickle

import numpy as np

from .errors import ExportError

ELEMENT_TYPES = {
    "DoubleStorage": "<f8",
    "FloatStorage": "<f4",
    "HalfStorage": "<f2",
    "LongStorage": "<i8",
    "IntStorage": "<i4",
    "ShortStorage": "<i2",
    "CharStorage": "<i1",
    "ByteStorage": "<u1",
    "BoolStorage": "<u1",
}

# What published checkpoints hold besides tensors (the training's settings). It is read over, not built.
READ_OVER = {
    ("parse_config", "ConfigParser"),
    ("pathlib", "PosixPath"),
    ("pathlib", "WindowsPath"),
}


@dataclasses.dataclass(frozen=True)
class StorageKey:
    """A storage whose bytes stand elsewhere in the file."""

    name: str
    dtype: np.dtype
    count: int


@dataclasses.dataclass(frozen=True)
class Tensor:
    """A view of a storage: offset, sizes and strides, counted in elements."""

    storage: StorageKey
    offset: int
    shape: tuple
    strides: tuple

    def array(self, flat):
        """The tensor's values, out of the storage's."""
        numbers = (self.offset, *self.shape, *self.strides)
        if any(not isinstance(n, int) or n < 0 for n in numbers) or len(self.shape) != len(self.strides):
            raise ExportError(f"a tensor has the shape {self.shape} and strides {self.strides}")
        reach = self.offset + sum((n - 1) * s for n, s in zip(self.shape, self.strides))
        count = int(np.prod([int(n) for n in self.shape], dtype=object))
        if count == 0:
            return np.zeros(self.shape, flat.dtype)
        if reach >= len(flat) or count > len(flat):
            raise ExportError(f"a tensor of shape {self.shape} reaches beyond its {len(flat)} stored values")
        strides = [s * flat.itemsize for s in self.strides]
        return np.array(np.lib.stride_tricks.as_strided(flat[self.offset :], self.shape, strides))


class _ReadOver:
    """Stands for an object that is of no account."""

    def __init__(self, *args):
        pass

    def __setstate__(self, state):
        pass


class _Dictionary(collections.OrderedDict):
    """A dictionary whose attributes (torch's _metadata) are left out."""

    def __setstate__(self, state):
        pass


def _rebuild_tensor(storage, offset, shape, strides, *_):
    if not isinstance(storage, StorageKey):
        raise ExportError("a tensor has no storage")
    return Tensor(storage, offset, tuple(shape), tuple(strides))


def _rebuild_parameter(tensor, *_):
    return tensor


_KNOWN = {
    ("collections", "OrderedDict"): _Dictionary,
    ("torch._utils", "_rebuild_tensor_v2"): _rebuild_tensor,
    ("torch._utils", "_rebuild_parameter"): _rebuild_parameter,
}


class TensorUnpickler(pickle.Unpickler):
    """`storages` takes a StorageKey for each storage that the stream refers to, by name."""

    def __init__(self, file):
        super().__init__(file, encoding="latin-1")
        self.storages = {}

    def find_class(self, module, name):
        if (module, name) in READ_OVER:
            return _ReadOver
        if module == "torch" and name in ELEMENT_TYPES:
            return np.dtype(ELEMENT_TYPES[name])
        if (module, name) not in _KNOWN:
            raise ExportError(f"it asks for {module}.{name}, which has no place among a network's weights")
        return _KNOWN[module, name]

    def persistent_load(self, pid):
        if not (isinstance(pid, tuple) and len(pid) >= 5 and pid[0] == "storage" and isinstance(pid[1], np.dtype)):
            raise ExportError("it refers to something other than a storage")
        if not isinstance(pid[4], int) or pid[4] < 0:
            raise ExportError(f"a storage claims {pid[4]} values")
        key = StorageKey(str(pid[2]), pid[1], pid[4])
        return self.storages.setdefault(key.name, key)
