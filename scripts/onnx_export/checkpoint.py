"""Reads the weights out of a file that torch.save wrote, without torch: both of its formats, nothing executed."""

import collections.abc
import io
import os
import zipfile

import numpy as np

from .errors import ExportError
from .unpickler import Tensor, TensorUnpickler

LEGACY_MAGIC = 0x1950A86A20F9469CFC6C
LEGACY_PROTOCOL = 1001


def read_weights(path):
    """The tensors of a checkpoint by name, as float32 arrays in native layout."""
    with open(path, "rb") as file:
        size = os.fstat(file.fileno()).st_size
        is_zip = file.read(4) == b"PK\x03\x04"
        file.seek(0)
        try:
            root, storages = _read_zip(file, size) if is_zip else _read_legacy(file, size)
            return _arrays(_state_dict(root), storages)
        except ExportError:
            raise
        except Exception as error:  # a damaged stream makes Python's readers raise nearly anything
            raise ExportError(f"the checkpoint is truncated or damaged ({_line(error)})") from error


def _line(error):
    return " ".join(str(error).split()) or type(error).__name__


def _load(file):
    unpickler = TensorUnpickler(file)
    return unpickler.load(), unpickler.storages


def _read_legacy(file, size):
    """Five pickles (magic, protocol, system, the object, the storages' names), then each storage: an int64 count
    and its values."""
    try:
        magic = _load(file)[0]
    except Exception as error:
        raise ExportError("not a checkpoint that torch.save wrote") from error
    if magic != LEGACY_MAGIC or _load(file)[0] != LEGACY_PROTOCOL:
        raise ExportError("not a checkpoint that torch.save wrote")
    system = _load(file)[0]
    if isinstance(system, dict) and system.get("little_endian") is False:
        raise ExportError("the checkpoint was written on a big-endian machine; save it again on a usual one")
    root, keys = _load(file)
    names = _load(file)[0]
    storages = {}
    for name in names:
        if name not in keys:
            raise ExportError(f"the storage {name!r} belongs to no tensor")
        count = int.from_bytes(_take(file, 8, size), "little", signed=True)
        if count != keys[name].count:
            raise ExportError(f"the storage {name!r} holds {count} values where {keys[name].count} are announced")
        dtype = keys[name].dtype
        storages[name] = np.frombuffer(_take(file, count * dtype.itemsize, size), dtype)
    return root, storages


def _take(file, count, size):
    if count < 0 or file.tell() + count > size:
        raise EOFError(f"{count} bytes are missing from byte {file.tell()} on")
    return file.read(count)


def _read_zip(file, size):
    """A stored zip with NAME/data.pkl and NAME/data/<storage>."""
    with zipfile.ZipFile(file) as archive:
        found = [name for name in archive.namelist() if name.endswith("/data.pkl") or name == "data.pkl"]
        if not found:
            raise ExportError("the zip holds no data.pkl, so torch.save did not write it")
        folder = found[0][: -len("data.pkl")]
        if folder + "byteorder" in archive.namelist() and _member(archive, folder + "byteorder", size) != b"little":
            raise ExportError("the checkpoint was written on a big-endian machine; save it again on a usual one")
        root, keys = _load(io.BytesIO(_member(archive, found[0], size)))
        storages = {}
        for name, key in keys.items():
            values = _member(archive, f"{folder}data/{name}", size)
            if len(values) < key.count * key.dtype.itemsize:
                raise ExportError(f"the storage {name!r} holds {len(values)} bytes, too few for {key.count} values")
            storages[name] = np.frombuffer(values, key.dtype, key.count)
        return root, storages


def _member(archive, name, size):
    try:
        info = archive.getinfo(name)
    except KeyError as error:
        raise ExportError(f"the zip holds no {name}") from error
    if info.compress_type != zipfile.ZIP_STORED or info.file_size > size:
        raise ExportError(f"{name} is compressed, which torch.save does not do")
    return archive.read(info)


def _state_dict(root):
    if isinstance(root, collections.abc.Mapping):
        for key in ("state_dict", "model_state_dict", "model"):
            if isinstance(root.get(key), collections.abc.Mapping):
                root = root[key]
                break
    tensors = {}
    if isinstance(root, collections.abc.Mapping):
        tensors = {name: value for name, value in root.items() if isinstance(value, Tensor) and isinstance(name, str)}
    if not tensors:
        raise ExportError("the checkpoint holds no state_dict of tensors")
    return {name.removeprefix("module."): value for name, value in tensors.items()}


def _arrays(tensors, storages):
    arrays = {}
    for name, tensor in tensors.items():
        if tensor.storage.name not in storages:
            raise ExportError(f"{name}: its values are missing from the file")
        try:
            values = tensor.array(storages[tensor.storage.name])
        except ExportError as error:
            raise ExportError(f"{name}: {error}") from error
        arrays[name] = values.astype(np.float32)
    return arrays
