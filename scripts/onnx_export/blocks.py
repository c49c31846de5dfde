"""The recurrent and residual blocks that FireNet and E2VID share."""

import numpy as np


def gru(graph, weights, name, state, x, channels, scale=1):
    """u = s(conv[x, h]), r = s(conv[x, h]), q = tanh(conv[x, r h]), h' = h + u (q - h)"""
    def gate(which):
        return weights.conv(f"{name}.{which}_gate", 2 * channels, channels)

    h = graph.state(state, channels, scale)
    both = graph.concat(x, h)
    update = graph.sigmoid(graph.conv(both, gate("update")))
    reset = graph.sigmoid(graph.conv(both, gate("reset")))
    candidate = graph.tanh(graph.conv(graph.concat(x, graph.mul(reset, h)), gate("out")))
    new = graph.add(h, graph.mul(update, graph.sub(candidate, h)))
    graph.keep(state, new, channels, scale)
    return new


def lstm(graph, weights, name, state, x, channels, scale):
    """i, f, o, g = s, s, s, tanh of a quarter of conv[x, h] each; c' = f c + i g, h' = o tanh(c')"""
    kernel, bias = weights.conv(name + ".Gates", 2 * channels, 4 * channels)
    h = graph.state("h" + state, channels, scale)
    c = graph.state("c" + state, channels, scale)
    both = graph.concat(x, h)
    quarters = zip(np.split(kernel, 4), np.split(bias, 4))
    enter, forget, leave, cell = (graph.conv(both, (np.ascontiguousarray(k), b)) for k, b in quarters)
    kept = graph.mul(graph.sigmoid(forget), c)
    new_c = graph.add(kept, graph.mul(graph.sigmoid(enter), graph.tanh(cell)))
    new_h = graph.mul(graph.sigmoid(leave), graph.tanh(new_c))
    graph.keep("h" + state, new_h, channels, scale)
    graph.keep("c" + state, new_c, channels, scale)
    return new_h


def residual(graph, weights, name, x, channels):
    """relu(x + conv(relu(conv(x)))), each convolution with its normalisation where there is one"""
    first = weights.conv_norm(name + ".conv1", name + ".bn1", channels, channels)
    second = weights.conv_norm(name + ".conv2", name + ".bn2", channels, channels)
    return graph.relu(graph.add(x, graph.conv(graph.relu(graph.conv(x, first)), second)))
