"""From a checkpoint to an ONNX file."""

import os
import tempfile

from . import e2vid, firenet
from .checkpoint import read_weights
from .errors import ExportError

ARCHITECTURES = (firenet, e2vid)
KEYS_SHOWN = 6


def build_model(arrays):
    """The ONNX model of the architecture whose tensors these are."""
    for architecture in ARCHITECTURES:
        if architecture.recognises(arrays):
            return architecture.build(arrays)
    names = sorted(arrays)
    more = f" and {len(names) - KEYS_SHOWN} more" if len(names) > KEYS_SHOWN else ""
    raise ExportError("these are not the weights of FireNet, FireNet+ or E2VID: the checkpoint holds "
                      + ", ".join(names[:KEYS_SHOWN]) + more)


def write_whole(path, data):
    """The file appears whole or not at all."""
    folder, name = os.path.split(os.path.abspath(path))
    handle, part = tempfile.mkstemp(prefix=name + ".", suffix=".part", dir=folder)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(part, 0o666 & ~mask)
        os.replace(part, path)
    except BaseException:
        os.unlink(part)
        raise


def export(checkpoint, output):
    """Returns the model's name. Throws an ExportError."""
    model = build_model(read_weights(checkpoint))
    write_whole(output, model.SerializeToString(deterministic=True))
    return model.graph.name
