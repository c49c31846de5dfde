#!/usr/bin/python3
"""usage: make_network_cases.py FOLDER                  random networks, a folder for each
       make_network_cases.py FOLDER CASE CHECKPOINT    a published one

Writes FOLDER/CASE/model.onnx as scripts/export_onnx makes it, and what it has to give: voxels.f32 (frames, 5, height,
width) and images.f32 (frames, height, width), evaluated by reference.py from the checkpoint's own tensors.
"""

import pathlib
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "scripts")]
sys.dont_write_bytecode = True

import random_networks as networks  # noqa: E402
import reference  # noqa: E402
import torch_file  # noqa: E402
from onnx_export.checkpoint import read_weights  # noqa: E402
from onnx_export.export import export  # noqa: E402

FRAMES, HEIGHT, WIDTH = 10, 16, 24

CASES = {
    "firenet": (networks.firenet_by_long_names, {}, reference.FireNetByLongNames, torch_file.write_legacy),
    "firenet_plus": (networks.firenet, {}, reference.FireNet, torch_file.write_zip),
    "e2vid": (networks.e2vid, {}, reference.E2vid, torch_file.write_legacy),
    "e2vid_upsampling": (networks.e2vid, {"transposed": False}, reference.E2vid, torch_file.write_zip),
    "e2vid_gru": (networks.e2vid, {"recurrent": "gru", "normed": False}, reference.E2vid, torch_file.write_zip),
}


def make_case(folder, checkpoint, network):
    export(checkpoint, folder / "model.onnx")
    voxels = np.random.default_rng(2).normal(size=(FRAMES, 5, HEIGHT, WIDTH)).astype(np.float32)
    images = np.stack([network.run(voxel.astype(np.float64)) for voxel in voxels])
    voxels.astype("<f4").tofile(folder / "voxels.f32")
    images.astype("<f4").tofile(folder / "images.f32")


def main():
    for case in [sys.argv[2]] if len(sys.argv) > 2 else CASES:
        make, options, evaluate, write = CASES[case]
        folder = pathlib.Path(sys.argv[1]) / case
        folder.mkdir()
        checkpoint = folder / "random.pth"
        if len(sys.argv) > 2:
            checkpoint = pathlib.Path(sys.argv[3])
            arrays = read_weights(checkpoint)
        else:
            arrays = make(1, **options)
            write(checkpoint, arrays)
        make_case(folder, checkpoint, evaluate(arrays))


if __name__ == "__main__":
    main()
