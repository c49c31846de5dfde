#!/usr/bin/python3
"""usage: make_tiny_network.py OUT.onnx

The network of test/models/tiny_network.onnx: FireNet's form with 2 channels, and weights made up here. It sees 3 x 3
pixels in its first layer and single pixels after it, so that what happens in one place of the image stays near it;
more brightness in makes more brightness out, as with a real one.
"""

import pathlib
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parents[1] / "scripts")]
sys.dont_write_bytecode = True

from onnx_export.export import build_model, write_whole  # noqa: E402


def tiny_network():
    """Channel 0 holds brightness above the mean, channel 1 below it."""
    arrays = {}

    def conv(name, kernel, bias):
        arrays[name + ".weight"] = np.array(kernel, np.float32)
        arrays[name + ".bias"] = np.array(bias, np.float32)

    def pointwise(name, matrix, bias):
        conv(name, np.array(matrix)[:, :, None, None], bias)

    around = np.array([[1, 2, 1], [2, 5, 2], [1, 2, 1]]) / 17
    bright = np.array([0.5, 0.7, 0.9, 1.1, 1.3])[:, None, None] * around
    conv("head.conv2d", [bright, -bright], [0.02, 0.03])
    for i in (1, 2):
        pointwise(f"G{i}.update_gate", [[0.3, 0.1, 0.2, 0], [0.1, 0.3, 0, 0.2]], [0.4, 0.5])
        pointwise(f"G{i}.reset_gate", [[0.2, 0, 0.1, 0], [0, 0.2, 0, 0.1]], [0.3, 0.2])
        pointwise(f"G{i}.out_gate", [[0.8, 0, 0.3, 0], [0, 0.8, 0, 0.3]], [0.0, 0.0])
        pointwise(f"R{i}.conv1", [[0.5, 0], [0, 0.5]], [0.1, 0.1])
        pointwise(f"R{i}.conv2", [[0.4, 0], [0, 0.4]], [0.0, 0.0])
    pointwise("pred.conv2d", [[0.45, -0.45]], [0.5])
    return arrays


if __name__ == "__main__":
    write_whole(sys.argv[1], build_model(tiny_network()).SerializeToString(deterministic=True))
