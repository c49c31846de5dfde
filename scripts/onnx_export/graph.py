"""Builds an ONNX model out of convolutions and what stands between them.

The form: inputs `voxel` and `NAME_in` for each recurrent state, outputs `image` and `NAME_out`. Height and width
are symbols ("height", "height/2"), so one file serves every sensor whose padded size the symbols divide.
"""

import numpy as np
import onnx
from onnx import TensorProto, helper, numpy_helper

OPSET = 13
IR_VERSION = 7


def _shape(channels, scale):
    suffix = "" if scale == 1 else f"/{scale}"
    return [1, channels, "height" + suffix, "width" + suffix]


class Graph:
    """Every function adds a node and returns its result's name."""

    def __init__(self, bins):
        self._nodes, self._tensors, self._inputs, self._outputs = [], [], [], []
        self._declare(self._inputs, "voxel", bins, 1)

    def _declare(self, where, name, channels, scale):
        where.append(helper.make_tensor_value_info(name, TensorProto.FLOAT, _shape(channels, scale)))

    def _add(self, operator, inputs, **attributes):
        name = f"{operator.lower()}_{len(self._nodes)}"
        self._nodes.append(helper.make_node(operator, inputs, [name], name=name, **attributes))
        return name

    def _constant(self, array):
        name = f"w_{len(self._tensors)}"
        self._tensors.append(numpy_helper.from_array(array, name))
        return name

    def conv(self, x, weights, stride=1):
        """Zero padding that keeps the size, but for the stride."""
        kernel, bias = weights
        pad = kernel.shape[2] // 2
        return self._add("Conv", [x, self._constant(kernel), self._constant(bias)],
                         kernel_shape=kernel.shape[2:], strides=[stride] * 2, pads=[pad] * 4)

    def conv_transpose(self, x, weights):
        """Doubles the size."""
        kernel, bias = weights
        pad = kernel.shape[2] // 2
        return self._add("ConvTranspose", [x, self._constant(kernel), self._constant(bias)],
                         kernel_shape=kernel.shape[2:], strides=[2] * 2, pads=[pad] * 4, output_padding=[1, 1])

    def upsample(self, x):
        """Doubles the size, bilinear, corners not aligned."""
        scales = self._constant(np.array([1, 1, 2, 2], np.float32))
        return self._add("Resize", [x, "", scales], mode="linear", coordinate_transformation_mode="half_pixel")

    def relu(self, x):
        return self._add("Relu", [x])

    def sigmoid(self, x):
        return self._add("Sigmoid", [x])

    def tanh(self, x):
        return self._add("Tanh", [x])

    def add(self, a, b):
        return self._add("Add", [a, b])

    def sub(self, a, b):
        return self._add("Sub", [a, b])

    def mul(self, a, b):
        return self._add("Mul", [a, b])

    def concat(self, a, b):
        return self._add("Concat", [a, b], axis=1)

    def state(self, name, channels, scale):
        """A recurrent state as it was after the last run; zeros before the first."""
        self._declare(self._inputs, name + "_in", channels, scale)
        return name + "_in"

    def keep(self, name, value, channels, scale):
        """What a recurrent state becomes."""
        self._output(name + "_out", value, channels, scale)

    def _output(self, name, value, channels, scale):
        self._nodes.append(helper.make_node("Identity", [value], [name], name=name))
        self._declare(self._outputs, name, channels, scale)

    def model(self, image, architecture):
        """The whole, checked."""
        self._output("image", image, 1, 1)
        graph = helper.make_graph(self._nodes, architecture, self._inputs, self._outputs, self._tensors)
        model = helper.make_model(graph, producer_name="esi export_onnx",
                                  opset_imports=[helper.make_opsetid("", OPSET)])
        model.ir_version = IR_VERSION
        onnx.checker.check_model(model)
        return model
