"""Text as RPG writes it, and HDF5 in the layout of DSEC."""

import h5py
import numpy as np


def write_text(path, events):
    """`t x y p`, t in seconds. Whole microseconds are printed as they are, without a detour over floats."""
    with open(path, "w", encoding="ascii", newline="\n") as file:
        for t, x, y, on in zip(events.t.tolist(), events.x.tolist(), events.y.tolist(), events.on.tolist()):
            file.write(f"{t // 1_000_000}.{t % 1_000_000:06d} {x} {y} {int(on)}\n")


def write_dsec(path, events, t_offset_us):
    """events/{x,y,p,t}, ms_to_idx, t_offset. gzip, which HDF5 has built in: no plugin is needed."""
    with h5py.File(path, "w", libver=("earliest", "v110")) as file:
        chunk = (min(65536, len(events.t)),)
        compact = dict(chunks=chunk, compression="gzip", compression_opts=9, shuffle=True)
        file.create_dataset("events/p", data=events.on.astype("<u1"), **compact)
        file.create_dataset("events/t", data=events.t.astype("<u4"), **compact)
        file.create_dataset("events/x", data=events.x.astype("<u2"), **compact)
        file.create_dataset("events/y", data=events.y.astype("<u2"), **compact)
        file.create_dataset("ms_to_idx", data=_first_event_of_each_ms(events.t).astype("<u8"))
        file.create_dataset("t_offset", data=np.int64(t_offset_us))


def _first_event_of_each_ms(t_us):
    return np.searchsorted(t_us, np.arange(0, t_us[-1] + 1, 1000))
