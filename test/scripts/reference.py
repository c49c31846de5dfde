"""The networks once more, straight from their equations and the checkpoint's tensors, in double precision."""

import numpy as np


def sigmoid(x):
    return 1 / (1 + np.exp(-x))


def relu(x):
    return np.maximum(x, 0)


class Network:
    """Keeps the recurrent states from one voxel grid to the next."""

    def __init__(self, arrays):
        self.w = {name: array.astype(np.float64) for name, array in arrays.items()}
        self.states = {}

    def conv(self, name, x, stride=1, norm=None):
        """x: (channels, height, width); zero padding"""
        kernel = self.w[name + ".weight"]
        pad = kernel.shape[2] // 2
        height, width = x.shape[1:]
        padded = np.pad(x, ((0, 0), (pad, pad), (pad, pad)))
        out = np.zeros((kernel.shape[0], -(-height // stride), -(-width // stride)))
        for i in range(kernel.shape[2]):
            for k in range(kernel.shape[3]):
                part = padded[:, i : i + height : stride, k : k + width : stride]
                out += np.einsum("oc,chw->ohw", kernel[:, :, i, k], part)
        return self.finish(name, norm, out)

    def conv_transpose(self, name, x, norm=None):
        """Each pixel of x paints the kernel around twice its place."""
        kernel = self.w[name + ".weight"]  # (in, out, k, k)
        size, pad = kernel.shape[2], kernel.shape[2] // 2
        height, width = x.shape[1:]
        out = np.zeros((kernel.shape[1], 2 * height + size, 2 * width + size))
        for i in range(size):
            for k in range(size):
                out[:, i : i + 2 * height : 2, k : k + 2 * width : 2] += np.einsum("co,chw->ohw", kernel[:, :, i, k], x)
        return self.finish(name, norm, out[:, pad : pad + 2 * height, pad : pad + 2 * width])

    def finish(self, name, norm, out):
        if name + ".bias" in self.w:
            out = out + self.w[name + ".bias"][:, None, None]
        if norm is None or norm + ".running_mean" not in self.w:
            return out
        mean, variance, weight, bias = (
            self.w[f"{norm}.{key}"][:, None, None] for key in ("running_mean", "running_var", "weight", "bias"))
        return (out - mean) / np.sqrt(variance + 1e-5) * weight + bias

    def state(self, name, like):
        return self.states.get(name, np.zeros_like(like))

    def gru(self, name, x):
        h = self.state(name, x)
        both = np.concatenate([x, h])
        update = sigmoid(self.conv(name + ".update_gate", both))
        reset = sigmoid(self.conv(name + ".reset_gate", both))
        candidate = np.tanh(self.conv(name + ".out_gate", np.concatenate([x, reset * h])))
        self.states[name] = (1 - update) * h + update * candidate
        return self.states[name]

    def lstm(self, name, x):
        h, c = self.state(name, x), self.state(name + " cell", x)
        enter, forget, leave, cell = np.split(self.conv(name + ".Gates", np.concatenate([x, h])), 4)
        c = sigmoid(forget) * c + sigmoid(enter) * np.tanh(cell)
        self.states[name + " cell"] = c
        self.states[name] = sigmoid(leave) * np.tanh(c)
        return self.states[name]

    def residual(self, name, x):
        inner = relu(self.conv(name + ".conv1", x, norm=name + ".bn1"))
        return relu(x + self.conv(name + ".conv2", inner, norm=name + ".bn2"))


class FireNet(Network):
    NAMES = {"head": "head.conv2d", "G1": "G1", "R1": "R1", "G2": "G2", "R2": "R2", "pred": "pred.conv2d"}

    def run(self, voxel):
        n = self.NAMES
        x = relu(self.conv(n["head"], voxel))
        x = self.residual(n["R1"], self.gru(n["G1"], x))
        x = self.residual(n["R2"], self.gru(n["G2"], x))
        return self.conv(n["pred"], x)[0]


class FireNetByLongNames(FireNet):
    NAMES = {"head": "net.head.conv.conv2d", "G1": "net.head.recurrent_block", "R1": "net.resblocks.0.conv",
             "G2": "net.resblocks.0.recurrent_block", "R2": "net.resblocks.1", "pred": "net.pred.conv2d"}


class E2vid(Network):
    def run(self, voxel):
        root = "unetrecurrent."
        depth = len({name.split(".")[2] for name in self.w if name.startswith(root + "encoders.")})
        head = relu(self.conv(root + "head.conv2d", voxel))
        blocks, x = [], head
        for i in range(depth):
            name = f"{root}encoders.{i}."
            x = relu(self.conv(name + "conv.conv2d", x, stride=2, norm=name + "conv.norm_layer"))
            is_lstm = name + "recurrent_block.Gates.weight" in self.w
            x = self.lstm(name + "recurrent_block", x) if is_lstm else self.gru(name + "recurrent_block", x)
            blocks.append(x)
        for i in range(2):
            x = self.residual(f"{root}resblocks.{i}", x)
        for i in range(depth):
            name, x = f"{root}decoders.{i}.", x + blocks[depth - 1 - i]
            if name + "transposed_conv2d.weight" in self.w:
                x = self.conv_transpose(name + "transposed_conv2d", x, norm=name + "norm_layer")
            else:
                x = self.conv(name + "conv2d", upsampled(x), norm=name + "norm_layer")
            x = relu(x)
        return sigmoid(self.conv(root + "pred.conv2d", x + head, norm=root + "pred.norm_layer"))[0]


def upsampled(x):
    """Twice the size, bilinear; pixel centres at halves, borders repeated."""
    for axis in (1, 2):
        n = x.shape[axis]
        place = np.clip((np.arange(2 * n) + 0.5) / 2 - 0.5, 0, n - 1)
        left = np.floor(place).astype(int)
        right = np.minimum(left + 1, n - 1)
        part = (place - left).reshape([-1 if a == axis else 1 for a in range(3)])
        x = np.take(x, left, axis) * (1 - part) + np.take(x, right, axis) * part
    return x
