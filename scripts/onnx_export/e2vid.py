"""E2VID (Rebecq et al. 2019): a U-net whose encoders are each followed by a ConvLSTM (or a ConvGRU)."""

from . import blocks
from .errors import ExportError
from .graph import Graph
from .weights import Weights

PREFIX = "unetrecurrent."


def recognises(arrays):
    return PREFIX + "head.conv2d.weight" in arrays


def _count(weights, name):
    i = 0
    while any(key.startswith(f"{name}.{i}.") for key in weights.arrays):
        i += 1
    return i


def _encoder(graph, weights, i, x, channels):
    """Halves the size and doubles the channels."""
    name, scale, wider = f"encoders.{i}", 2 ** (i + 1), 2 * channels
    conv = weights.conv_norm(name + ".conv.conv2d", name + ".conv.norm_layer", channels, wider)
    x = graph.relu(graph.conv(x, conv, stride=2))
    if name + ".recurrent_block.Gates.weight" in weights:
        return blocks.lstm(graph, weights, name + ".recurrent_block", str(i + 1), x, wider, scale)
    return blocks.gru(graph, weights, name + ".recurrent_block", f"h{i + 1}", x, wider, scale)


def _decoder(graph, weights, i, x, channels):
    """Doubles the size and halves the channels."""
    name, narrower = f"decoders.{i}", channels // 2
    norm = name + ".norm_layer"
    if name + ".transposed_conv2d.weight" in weights:
        conv = weights.conv_norm(name + ".transposed_conv2d", norm, channels, narrower, transposed=True)
        return graph.relu(graph.conv_transpose(x, conv))
    return graph.relu(graph.conv(graph.upsample(x), weights.conv_norm(name + ".conv2d", norm, channels, narrower)))


def build(arrays):
    weights = Weights({name[len(PREFIX) :]: array for name, array in arrays.items() if name.startswith(PREFIX)})
    head = weights.conv("head.conv2d")
    channels, bins = head[0].shape[:2]
    depth = _count(weights, "encoders")
    if depth == 0 or _count(weights, "decoders") != depth:
        raise ExportError(f"{depth} encoders and {_count(weights, 'decoders')} decoders: an E2VID has as many of both")
    graph = Graph(bins)
    x = graph.relu(graph.conv("voxel", head))
    skipped = [x]
    for i in range(depth):
        x = _encoder(graph, weights, i, x, channels * 2**i)
        skipped.append(x)
    for i in range(_count(weights, "resblocks")):
        x = blocks.residual(graph, weights, f"resblocks.{i}", x, channels * 2**depth)
    for i in range(depth):
        x = _decoder(graph, weights, i, graph.add(x, skipped.pop()), channels * 2 ** (depth - i))
    pred = weights.conv_norm("pred.conv2d", "pred.norm_layer", channels, 1)
    return graph.model(graph.sigmoid(graph.conv(graph.add(x, skipped.pop()), pred)), "E2VID")
