"""The sensor: pixels that fire when log intensity has moved by a contrast threshold."""

import dataclasses

import numpy as np

from . import scene

STEP_US = 500  # between two looks at the scene log intensity is a straight line
LOG_UNIT = 1e-6  # log intensity in whole millionths
THRESHOLD = 0.35  # contrast threshold C (ln), the same for ON and OFF
MISMATCH = 0.03  # its deviation from pixel to pixel
NOISE_HZ = 0.5  # shot noise, ON and OFF together, per pixel
HOT_PIXELS, HOT_HZ = 6, 40
FRAME_PERIOD_US, EXPOSURE_US = 50_000, 8_000


@dataclasses.dataclass
class Events:
    """Columns sorted by time."""

    t: np.ndarray  # int64, microseconds
    x: np.ndarray
    y: np.ndarray
    on: np.ndarray  # bool

    def before(self, t_us):
        return self.slice(0, np.searchsorted(self.t, t_us))

    def slice(self, begin, end):
        return Events(self.t[begin:end], self.x[begin:end], self.y[begin:end], self.on[begin:end])


@dataclasses.dataclass
class IntensityFrame:
    begin_us: int  # of the exposure
    end_us: int
    grey: np.ndarray  # uint8 (height, width)


def record(view, seed):
    """All events of the scene, with noise."""
    random = np.random.default_rng(seed)
    parts = [*_Pixels(view, random).fire(), _hot_pixels(random)]
    t, pixel, on = (np.concatenate(column) for column in zip(*parts))
    order = np.lexsort((pixel, t))
    t, pixel, on = t[order], pixel[order], on[order]
    return Events(t, pixel % scene.WIDTH_PX, pixel // scene.WIDTH_PX, on)


def expose(view, first_us, duration_us):
    """Intensity frames of the first `duration_us` after `first_us`; their times count from there."""
    frames = []
    for begin_us in range(0, duration_us - EXPOSURE_US + 1, FRAME_PERIOD_US):
        times = range(begin_us, begin_us + EXPOSURE_US, STEP_US)
        light = sum(view.light(first_us + t).astype(np.int64) for t in times) // len(times)
        grey = (light * 255 // scene.FULL_SCALE).astype(np.uint8)
        frames.append(IntensityFrame(begin_us, begin_us + EXPOSURE_US, grey))
    return frames


def _in_log_units(values):
    return np.round(values / LOG_UNIT).astype(np.int64)


_LOG = _in_log_units(np.log(np.maximum(np.arange(scene.FULL_SCALE + 1), 1)))
_PIXELS = scene.WIDTH_PX * scene.HEIGHT_PX


class _Pixels:
    def __init__(self, view, random):
        self._view = view
        self._random = random
        threshold = THRESHOLD + MISMATCH * random.standard_normal((2, _PIXELS))
        self._on_step, self._off_step = _in_log_units(np.maximum(threshold, THRESHOLD / 3))
        self._old = self._log_intensity(0)
        # Where in its threshold band a pixel stands at the start is chance.
        phase = random.triangular(-1, 0, 1, _PIXELS)
        self._memory = self._old + (phase * np.minimum(self._on_step, self._off_step)).astype(np.int64)

    def fire(self):
        """Pieces (t, pixel, on), in no order."""
        for begin_us in range(0, scene.DURATION_US, STEP_US):
            new = self._log_intensity(begin_us + STEP_US)
            yield from self._crossings(new, begin_us, True)
            yield from self._crossings(new, begin_us, False)
            yield self._noise(new, begin_us)
            self._old = new

    def _log_intensity(self, t_us):
        return _LOG[self._view.light(t_us).ravel()]

    def _crossings(self, new, begin_us, on):
        sign, step = (1, self._on_step) if on else (-1, self._off_step)
        crossed = np.flatnonzero(sign * (new - self._memory) >= step)
        while crossed.size:
            self._memory[crossed] += sign * step[crossed]
            way, whole = (self._memory - self._old)[crossed], (new - self._old)[crossed]
            t = begin_us + np.clip(STEP_US * way // np.where(whole == 0, 1, whole), 0, STEP_US)
            yield t, crossed, np.full(crossed.size, on)
            crossed = crossed[sign * (new - self._memory)[crossed] >= step[crossed]]

    def _noise(self, new, begin_us):
        """Noise lifts a pixel over the nearer of its thresholds, so that it does not add up."""
        count = self._random.poisson(NOISE_HZ * _PIXELS * STEP_US / 1e6)
        pixel = np.unique(self._random.integers(0, _PIXELS, count))
        on = new[pixel] > self._memory[pixel]
        self._memory[pixel] += np.where(on, self._on_step[pixel], -self._off_step[pixel])
        return begin_us + self._random.integers(0, STEP_US, pixel.size), pixel, on


def _hot_pixels(random):
    pixel = np.repeat(random.integers(0, _PIXELS, HOT_PIXELS), round(HOT_HZ * scene.DURATION_US / 1e6))
    return random.integers(0, scene.DURATION_US, pixel.size), pixel, np.full(pixel.size, True)
