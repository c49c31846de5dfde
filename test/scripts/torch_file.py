"""Writes tensors as torch.save does, in both of its formats, without torch: opcode by opcode."""

import pickle
import struct
import zipfile

import numpy as np

MAGIC = 0x1950A86A20F9469CFC6C
STORAGES = {"f4": "FloatStorage", "f8": "DoubleStorage", "f2": "HalfStorage", "i8": "LongStorage"}


class _Named:
    """Pickles as a name of another module, which need not be there."""

    def __init__(self, module, name):
        self.module, self.name = module, name


class _Storage:
    def __init__(self, array, key):
        self.array, self.key = array, key


class _Pickler(pickle._Pickler):  # the one in Python: its names can be forged
    dispatch = dict(pickle._Pickler.dispatch)

    def _save_named(self, named):
        self.write(pickle.GLOBAL + f"{named.module}\n{named.name}\n".encode())

    dispatch[_Named] = _save_named

    def persistent_id(self, thing):
        if not isinstance(thing, _Storage):
            return None
        kind = _Named("torch", STORAGES[thing.array.dtype.str[1:]])
        return ("storage", kind, thing.key, "cuda:0", thing.array.size, *self.after_count)

    def _save_tensor(self, tensor):
        strides = tuple(s // tensor.array.itemsize for s in np.empty(tensor.shape, tensor.array.dtype).strides)
        self.save(_Named("torch._utils", "_rebuild_tensor_v2"))
        self.save((_Storage(tensor.array, tensor.key), 0, tensor.shape, strides, False, {}))
        self.write(pickle.REDUCE)

    def _save_call(self, call):
        self.save(_Named(*call.name))
        self.save(call.arguments)
        self.write(pickle.REDUCE)


class _Tensor:
    def __init__(self, array, key):
        self.array, self.shape, self.key = np.ascontiguousarray(array), tuple(array.shape), key


class Call:
    """An object that unpickles by calling a function by name."""

    def __init__(self, module, name, *arguments):
        self.name, self.arguments = (module, name), arguments


_Pickler.dispatch[_Tensor] = _Pickler._save_tensor
_Pickler.dispatch[Call] = _Pickler._save_call


def _pickled(thing, file, after_count):
    pickler = _Pickler(file, 2)
    pickler.after_count = after_count
    pickler.dump(thing)


def _with_tensors(arrays, extra):
    tensors = {name: _Tensor(array, str(1000 + i)) for i, (name, array) in enumerate(arrays.items())}
    return {"arch": "Net", "state_dict": tensors, **extra}, list(tensors.values())


def write_legacy(path, arrays, **extra):
    root, tensors = _with_tensors(arrays, extra)
    with open(path, "wb") as file:
        for header in (MAGIC, 1001, {"protocol_version": 1001, "little_endian": True}):
            pickle.dump(header, file, protocol=2)
        _pickled(root, file, (None,))
        pickle.dump([t.key for t in tensors], file, protocol=2)
        for tensor in tensors:
            file.write(struct.pack("<q", tensor.array.size))
            file.write(tensor.array.astype(tensor.array.dtype.newbyteorder("<")).tobytes())


def write_zip(path, arrays, **extra):
    root, tensors = _with_tensors(arrays, extra)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_STORED) as archive:
        with archive.open("archive/data.pkl", "w") as file:
            _pickled(root, file, ())
        for tensor in tensors:
            archive.writestr(f"archive/data/{tensor.key}", tensor.array.tobytes())
        archive.writestr("archive/version", "3\n")
