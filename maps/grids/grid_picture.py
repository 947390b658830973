"""A grid as a picture for people, such as a notebook shows."""

import math

import cv2
import numpy as np
import numpy.typing as npt

_SIDE = 600  # pixels along the longer side of the picture, about
_ORDER = np.array([1, 2, 0], dtype=np.uint8)  # of free, occupied, unknown: what hides what
_GREY = np.array([200, 255, 40], dtype=np.uint8)  # in that order


def png(cells: npt.NDArray[np.uint8]) -> bytes:
    """Return a PNG of cells as `OccupancyGrid` has them: row 0 at the bottom, free white, occupied black, unknown grey.

    Where several cells share a pixel, an occupied one hides the others, so that thin walls stay visible, and a free one an unknown one.
    """
    longest = max(cells.shape)
    hiding = _ORDER[cells]
    step = math.ceil(longest / _SIDE)
    for axis in (0, 1):
        hiding = np.maximum.reduceat(hiding, np.arange(0, hiding.shape[axis], step), axis=axis)
    pixels = _GREY[hiding[::-1]]
    each = max(1, _SIDE // longest)
    pixels = np.ascontiguousarray(pixels.repeat(each, axis=0).repeat(each, axis=1))
    _, data = cv2.imencode(".png", pixels)
    return data.tobytes()
