"""Tensors of random networks, under the names that the published checkpoints use."""

import numpy as np


class Maker:
    def __init__(self, seed):
        self.random = np.random.default_rng(seed)
        self.arrays = {}

    def conv(self, name, outputs, inputs, size, bias=True, transposed=False):
        shape = (inputs, outputs, size, size) if transposed else (outputs, inputs, size, size)
        spread = 1.5 / np.sqrt(inputs * size * size)
        self.arrays[name + ".weight"] = self.random.normal(0, spread, shape).astype(np.float32)
        if bias:
            self.arrays[name + ".bias"] = self.random.normal(0, 0.3, outputs).astype(np.float32)

    def norm(self, name, channels):
        def uniform(low, high):
            return self.random.uniform(low, high, channels).astype(np.float32)

        self.arrays[name + ".weight"] = uniform(0.5, 1.5)
        self.arrays[name + ".bias"] = uniform(-0.3, 0.3)
        self.arrays[name + ".running_mean"] = uniform(-0.3, 0.3)
        self.arrays[name + ".running_var"] = uniform(0.5, 1.5)
        self.arrays[name + ".num_batches_tracked"] = np.array(1234, np.int64)

    def gru(self, name, channels, size=3):
        for gate in ("reset", "update", "out"):
            self.conv(f"{name}.{gate}_gate", channels, 2 * channels, size)


def firenet(seed, channels=6, bins=5, size=3):
    """By FireNet+'s names."""
    maker = Maker(seed)
    maker.conv("head.conv2d", channels, bins, 3)
    for i in (1, 2):
        maker.gru(f"G{i}", channels, size)
        maker.conv(f"R{i}.conv1", channels, channels, size)
        maker.conv(f"R{i}.conv2", channels, channels, size)
    maker.conv("pred.conv2d", 1, channels, 1)
    return maker.arrays


def firenet_by_long_names(seed, **options):
    long = {"head.conv2d": "net.head.conv.conv2d", "G1": "net.head.recurrent_block", "R1": "net.resblocks.0.conv",
            "G2": "net.resblocks.0.recurrent_block", "R2": "net.resblocks.1", "pred.conv2d": "net.pred.conv2d"}

    def renamed(name):
        start = next(short for short in long if name.startswith(short + "."))
        return long[start] + name[len(start) :]

    return {renamed(name): array for name, array in firenet(seed, **options).items()}


def e2vid(seed, channels=4, depth=3, transposed=True, recurrent="lstm", normed=True):
    maker = Maker(seed)

    def conv_norm(conv, norm, outputs, inputs, size, **kind):
        maker.conv(conv, outputs, inputs, size, bias=not normed, **kind)
        if normed:
            maker.norm(norm, outputs)

    root = "unetrecurrent."
    maker.conv(root + "head.conv2d", channels, 5, 5)
    for i in range(depth):
        wide = channels * 2 ** (i + 1)
        name = f"{root}encoders.{i}."
        conv_norm(name + "conv.conv2d", name + "conv.norm_layer", wide, wide // 2, 5)
        if recurrent == "lstm":
            maker.conv(name + "recurrent_block.Gates", 4 * wide, 2 * wide, 3)
        else:
            maker.gru(name + "recurrent_block", wide)
    for i in range(2):
        for k in (1, 2):
            name = f"{root}resblocks.{i}."
            conv_norm(f"{name}conv{k}", f"{name}bn{k}", channels * 2**depth, channels * 2**depth, 3)
    for i in range(depth):
        wide = channels * 2 ** (depth - i)
        name = f"{root}decoders.{i}."
        which = "transposed_conv2d" if transposed else "conv2d"
        conv_norm(name + which, name + "norm_layer", wide // 2, wide, 5, transposed=transposed)
    conv_norm(root + "pred.conv2d", root + "pred.norm_layer", 1, channels, 1)
    return maker.arrays
