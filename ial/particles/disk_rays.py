"""`DiskRays`: how far disks can drive among the walls of an environment, in plain doubles; for guesses, not for bounds."""

from fractions import Fraction

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import FloatArray
from ial.contractors.kernels import kernel
from ial.errors import ConfigError
from ial.maps.polygons.environment import Environment

_TOUCH = 2.0**-20  # metres and radians: what is nearer touches, and what is passed more nearly in parallel is only grazed


@kernel
def _distances(walls, radius, poses, distances):  # type: ignore[no-untyped-def]
    for i in range(len(poses)):
        x, y, heading = poses[i]
        c, s = np.cos(heading), np.sin(heading)
        nearest = np.inf
        for k in range(len(walls)):
            ax, ay, ex, ey, length = walls[k]
            px, py = x - ax, y - ay
            height, speed = ex * py - ey * px, ex * s - ey * c
            if speed < -_TOUCH and height - radius >= -_TOUCH:
                way = max((height - radius) / -speed, 0.0)
                along = ex * (px + way * c) + ey * (py + way * s)
                if -_TOUCH <= along <= length + _TOUCH:
                    nearest = min(nearest, way)
            if radius > 0.0:
                ahead = -(c * px + s * py)
                aside = abs(c * py - s * px)
                if ahead > 0.0 and aside < radius - _TOUCH:
                    nearest = min(nearest, max(ahead - np.sqrt(radius * radius - aside * aside), 0.0))
        distances[i] = nearest


@kernel
def _are_free(walls, radius, places, free):  # type: ignore[no-untyped-def]
    for i in range(len(places)):
        x, y = places[i]
        inside, clear = False, True
        for k in range(len(walls)):
            ax, ay, ex, ey, length = walls[k]
            px, py = x - ax, y - ay
            if (py < 0.0) != (py - length * ey < 0.0) and px < length * ex * py / (length * ey):
                inside = not inside
            along = min(max(ex * px + ey * py, 0.0), length)
            if (px - along * ex) ** 2 + (py - along * ey) ** 2 < radius * radius:
                clear = False
        free[i] = inside and clear


class DiskRays:
    """Rays of a disk or a point, which stop where it touches a wall that it drives towards. What it passes in parallel it only grazes.

    Parameters
    ----------
    environment
        The free space; the boundaries of all polygons are walls.
    radius_m
        The radius of the disk in metres; 0 for a point.

    Raises
    ------
    ConfigError
        If the radius is negative.
    """

    def __init__(self, environment: Environment, radius_m: Fraction = Fraction(0)) -> None:
        if radius_m < 0:
            raise ConfigError(f"the radius of the robot is {float(radius_m):g} m; give 0 for a point, or a positive number")
        rings = [np.array([[float(x), float(y)] for x, y in ring]) for polygon in environment.polygons for ring in polygon.rings]
        ways = [np.roll(ring, -1, axis=0) - ring for ring in rings]
        lengths = [np.hypot(way[:, 0], way[:, 1])[:, None] for way in ways]
        parts = [np.column_stack([ring, way / length, length]) for ring, way, length in zip(rings, ways, lengths, strict=True)]
        self.walls = np.concatenate(parts)
        self.radius_m = float(radius_m)

    def __repr__(self) -> str:
        return f"<DiskRays among {len(self.walls)} walls, radius {self.radius_m:g} m>"

    def distances(self, poses: FloatArray) -> FloatArray:
        """Return how far the disk can drive from each pose (x, y in metres, heading in radians); infinity where nothing stops it."""
        distances = np.empty(len(poses))
        _distances(self.walls, self.radius_m, poses, distances)
        return distances

    def are_free(self, places: FloatArray) -> npt.NDArray[np.bool_]:
        """Return whether the disk lies in the free space with its centre at each place (x, y in metres)."""
        free = np.empty(len(places), dtype=np.bool_)
        _are_free(self.walls, self.radius_m, places, free)
        return free
