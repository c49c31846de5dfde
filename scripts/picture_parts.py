"""What make_picture and make_montage share: images that esi-recon makes, and how they are put together."""

import pathlib
import subprocess
import tempfile

import cv2
import numpy as np

GAP_PX = 8


def reconstructions(tool, recording, times, options):
    """The images that esi-recon shows at these times (s after the first event)."""
    with tempfile.TemporaryDirectory() as folder:
        list_of_times = pathlib.Path(folder) / "times.txt"
        list_of_times.write_text("".join(f"{time}\n" for time in times))
        subprocess.run(
            [tool, recording, "--quiet", "--time-zero", "first-event", "--times", list_of_times]
            + [*options, "-o", f"{folder}/frames"],
            check=True,
        )
        return [cv2.imread(f"{folder}/frames/frame_{index:010}.png") for index in range(len(times))]


def joined(pictures, axis):
    shape = list(pictures[0].shape)
    shape[axis] = GAP_PX
    gap = np.full(shape, 255, np.uint8)
    parts = [part for picture in pictures for part in (picture, gap)]
    return np.concatenate(parts[:-1], axis=axis)
