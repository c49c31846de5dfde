"""The scene: an AprilTag on textured ground, seen by a camera that sways, turns and zooms."""

import math

import cv2
import numpy as np

WIDTH_PX, HEIGHT_PX = 240, 180
DURATION_US = 2_000_000
TAG_ID = 7
GROUND_PX_PER_PX = 4  # the ground is drawn finer than the sensor sees it
GROUND_SIZE = 2048
TAG_SIDE_PX = 80  # on the sensor, when the zoom is 1
WHITE, BLACK = 0.90, 0.06  # reflectance of the printed tag
FULL_SCALE = 65535  # light is 16 bits wide: whole numbers come out alike on every machine


class Scene:
    def __init__(self, seed):
        self._ground = _ground(np.random.default_rng(seed))

    def light(self, t_us):
        """What each pixel receives at a time, as uint16 (height, width), linear in light."""
        to_sensor = _camera(t_us / 1e6)
        return cv2.warpAffine(self._ground, to_sensor, (WIDTH_PX, HEIGHT_PX), flags=cv2.INTER_LINEAR)


def _camera(t_s):
    """The affine map ground -> sensor. Every motion starts gently and keeps changing its direction."""
    zoom = 1 + 0.10 * math.sin(2 * math.pi * 0.4 * t_s)
    angle_rad = math.radians(9) * math.sin(2 * math.pi * 0.3 * t_s)
    x_px = WIDTH_PX / 2 + 30 * math.sin(2 * math.pi * 0.4 * t_s)
    y_px = HEIGHT_PX / 2 + 18 * math.cos(2 * math.pi * 0.5 * t_s)
    scale = zoom / GROUND_PX_PER_PX
    c, s = scale * math.cos(angle_rad), scale * math.sin(angle_rad)
    middle = GROUND_SIZE / 2
    return np.array([[c, -s, x_px - (c - s) * middle], [s, c, y_px - (s + c) * middle]])


def _ground(random):
    light = _texture(random)
    side = TAG_SIDE_PX * GROUND_PX_PER_PX
    _paste(light, np.full((side * 5 // 4,) * 2, WHITE))
    _paste(light, np.where(_tag(side) > 0, WHITE, BLACK))
    one_sensor_pixel = cv2.GaussianBlur(light, (0, 0), 0.5 * GROUND_PX_PER_PX)
    return np.round(one_sensor_pixel * FULL_SCALE).astype(np.uint16)


def _tag(side):
    dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_APRILTAG_36h11)
    return cv2.aruco.drawMarker(dictionary, TAG_ID, side)


def _texture(random):
    """Gravel: blurred noise of several sizes, each as strong as its size."""
    texture = np.zeros((GROUND_SIZE, GROUND_SIZE))
    for sigma in (20, 40, 80):
        noise = cv2.GaussianBlur(random.standard_normal(texture.shape), (0, 0), sigma)
        texture += noise / noise.std() * math.sqrt(sigma)
    texture /= texture.std()
    return np.clip(0.32 * np.exp(0.30 * texture), 0.08, 0.85)


def _paste(light, patch):
    begin = (GROUND_SIZE - patch.shape[0]) // 2
    light[begin : begin + patch.shape[0], begin : begin + patch.shape[1]] = patch
