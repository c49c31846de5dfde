#!/usr/bin/python3
"""usage: make_network_case.py CASE FOLDER [CHECKPOINT]

Writes FOLDER/model.onnx, made by scripts/export_onnx from a random checkpoint (or from the CHECKPOINT given), and what
it has to give: voxels.f32 (frames, 5, height, width) and images.f32 (frames, height, width) by reference.py.
"""

import pathlib
import subprocess
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(pathlib.Path(__file__).parent)]

import random_networks as networks  # noqa: E402
import reference  # noqa: E402
import torch_file  # noqa: E402
from onnx_export.checkpoint import read_weights  # noqa: E402

FRAMES, HEIGHT, WIDTH = 10, 16, 24

CASES = {
    "firenet": (networks.firenet_by_long_names, {}, reference.FireNetByLongNames, torch_file.write_legacy),
    "firenet_plus": (networks.firenet, {}, reference.FireNet, torch_file.write_zip),
    "e2vid": (networks.e2vid, {}, reference.E2vid, torch_file.write_legacy),
    "e2vid_upsampling": (networks.e2vid, {"transposed": False}, reference.E2vid, torch_file.write_zip),
    "e2vid_gru": (networks.e2vid, {"recurrent": "gru", "normed": False}, reference.E2vid, torch_file.write_zip),
}


def main():
    case, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    make, options, evaluate, write = CASES[case]
    checkpoint = folder / "random.pth"
    if len(sys.argv) > 3:
        checkpoint = pathlib.Path(sys.argv[3])
        arrays = read_weights(checkpoint)
    else:
        arrays = make(1, **options)
        write(checkpoint, arrays)
    subprocess.run([ROOT / "scripts" / "export_onnx", checkpoint, folder / "model.onnx"], check=True)
    voxels = np.random.default_rng(2).normal(size=(FRAMES, 5, HEIGHT, WIDTH)).astype(np.float32)
    network = evaluate(arrays)
    images = np.stack([network.run(voxel.astype(np.float64)) for voxel in voxels])
    voxels.astype("<f4").tofile(folder / "voxels.f32")
    images.astype("<f4").tofile(folder / "images.f32")


if __name__ == "__main__":
    main()
