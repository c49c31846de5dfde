"""FireNet (Scheerlinck et al. 2020) and FireNet+ (Stoffregen et al. 2020): one network, two ways to name it."""

from . import blocks
from .graph import Graph
from .weights import Weights

# FireNet's names, and what FireNet+ calls the same.
LONG_NAMES = {
    "net.head.conv.": "head.",
    "net.head.recurrent_block.": "G1.",
    "net.resblocks.0.conv.": "R1.",
    "net.resblocks.0.recurrent_block.": "G2.",
    "net.resblocks.1.": "R2.",
    "net.pred.": "pred.",
}


def recognises(arrays):
    return "net.head.conv.conv2d.weight" in arrays or ("head.conv2d.weight" in arrays and "G1.out_gate.weight" in arrays)


def _short(name):
    for long, short in LONG_NAMES.items():
        if name.startswith(long):
            return short + name[len(long) :]
    return name


def build(arrays):
    """image = pred(R2(G2(R1(G1(relu(head(voxel)))))))"""
    weights = Weights({_short(name): array for name, array in arrays.items()})
    head = weights.conv("head.conv2d")
    channels, bins = head[0].shape[:2]
    graph = Graph(bins)
    x = graph.relu(graph.conv("voxel", head))
    x = blocks.gru(graph, weights, "G1", "h1", x, channels)
    x = blocks.residual(graph, weights, "R1", x, channels)
    x = blocks.gru(graph, weights, "G2", "h2", x, channels)
    x = blocks.residual(graph, weights, "R2", x, channels)
    return graph.model(graph.conv(x, weights.conv("pred.conv2d", channels, 1)), "FireNet")
