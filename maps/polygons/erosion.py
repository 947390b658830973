"""`erode`: where the centre of a disk robot can be, decided with whole squared distances."""

import math
from fractions import Fraction

import numpy as np

from ial.errors import ConfigError
from ial.maps.polygons.raster import Raster, Rule


def erode(raster: Raster, radius: Fraction, rule: Rule = "centre") -> Raster:
    """Return the cells in which a disk keeps clear of every closed cell that is not free and of everything outside of the raster.

    Parameters
    ----------
    raster
        The free cells of a point.
    radius
        The radius of the disk in metres; it may touch an obstacle.
    rule
        ``centre``: the centre of the cell keeps the distance, as for a robot that bumps there. ``inside``: the whole cell does.

    Raises
    ------
    ConfigError
        If the radius is negative.
    """
    if radius < 0:
        raise ConfigError(f"the radius of the robot is {radius}; give 0 for a point, or a positive number in metres")
    halves = 2 * radius / raster.cell  # the radius in half cells
    limit = math.ceil(halves**2)  # a whole squared distance is at least the squared radius exactly if it is at least this
    reach = math.isqrt(max(limit - 1, 0)) // 2 + 2
    blocked = np.pad(~raster.free, reach, constant_values=True)
    rows, columns = raster.free.shape
    near = ~raster.free
    before = np.zeros((blocked.shape[0], blocked.shape[1] + 1), dtype=np.int32)
    np.cumsum(blocked, axis=1, out=before[:, 1:])
    for up in range(-reach, reach + 1):
        width = _reached(limit - _gap(up, rule) ** 2, rule)
        if width >= 0:
            band = before[reach + up : reach + up + rows]
            first, stop = reach - width, reach + width + 1
            near |= band[:, stop : stop + columns] > band[:, first : first + columns]
    return Raster(~near, raster.cell, raster.x, raster.y)


def _gap(cells: int, rule: Rule) -> int:
    """Return the distance along one axis, in half cells, to the closed square so many cells away."""
    return max(2 * abs(cells) - (2 if rule == "inside" else 1), 0)


def _reached(rest: int, rule: Rule) -> int:
    """Return how many cells away along the other axis a square is still too near; −1 if none is."""
    if rest <= 0:
        return -1
    half = math.isqrt(rest - 1)  # the largest gap whose square is below what is left
    return half // 2 + 1 if rule == "inside" else (half + 1) // 2
