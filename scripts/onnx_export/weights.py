"""Asks a checkpoint for its tensors, and checks what it gets."""

import numpy as np

from .errors import ExportError

BATCH_NORM_EPS = 1e-5


class Weights:
    """Tensors by name; each is asked for with what is known of its shape."""

    def __init__(self, arrays):
        self.arrays = arrays

    def __contains__(self, name):
        return name in self.arrays

    def get(self, name, *shape):
        """The tensor `name`. None in `shape` stands for any length."""
        if name not in self.arrays:
            raise ExportError(f"the tensor {name} is missing")
        array = self.arrays[name]
        if len(array.shape) != len(shape) or any(w not in (None, n) for w, n in zip(shape, array.shape)):
            wanted = "x".join("?" if n is None else str(n) for n in shape)
            given = "x".join(str(n) for n in array.shape) or "scalar"
            raise ExportError(f"the tensor {name} has the shape {given}, not {wanted}")
        if not np.isfinite(array).all():
            raise ExportError(f"the tensor {name} holds values that are not finite")
        return array

    def conv(self, name, inputs=None, outputs=None):
        """Kernel (out, in, k, k) and bias of a convolution."""
        kernel = self.get(name + ".weight", outputs, inputs, None, None)
        if kernel.shape[2] != kernel.shape[3] or kernel.shape[2] % 2 == 0:
            raise ExportError(f"the tensor {name}.weight is no odd square kernel")
        return kernel, self.get(name + ".bias", kernel.shape[0])

    def conv_norm(self, name, norm, inputs=None, outputs=None, transposed=False):
        """The same with the batch normalisation `norm` after it, where there is one, folded in.

        A transposed convolution's kernel is (in, out, k, k).
        """
        shape = (inputs, outputs) if transposed else (outputs, inputs)
        kernel = self.get(name + ".weight", *shape, None, None)
        out_axis = 1 if transposed else 0
        count = kernel.shape[out_axis]
        if kernel.shape[2] != kernel.shape[3] or kernel.shape[2] % 2 == 0:
            raise ExportError(f"the tensor {name}.weight is no odd square kernel")
        if norm + ".running_mean" not in self:
            return kernel, self.get(name + ".bias", count)
        bias = self.get(name + ".bias", count) if name + ".bias" in self else 0.0
        mean = self.get(norm + ".running_mean", count).astype(np.float64)
        variance = self.get(norm + ".running_var", count).astype(np.float64)
        if (variance + BATCH_NORM_EPS <= 0).any():
            raise ExportError(f"the tensor {norm}.running_var holds a negative variance")
        scale = self.get(norm + ".weight", count) / np.sqrt(variance + BATCH_NORM_EPS)
        along = [1, 1, 1, 1]
        along[out_axis] = count
        folded = (bias - mean) * scale + self.get(norm + ".bias", count)
        return (kernel * scale.reshape(along)).astype(np.float32), folded.astype(np.float32)
