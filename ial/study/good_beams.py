"""How many beams of a scan are good at a pose, by the exact definition of a good beam.

This is the slow, obvious twin of the localizer's test: it works on one pose, walks over the cells around each end point and measures
distances. It shares no code with the search that it judges.
"""

import math

import numpy as np

from ial.contractors.kernels import kernel
from ial.lidar.beams import Beams
from ial.maps.occupancy_grid import OCCUPIED, OccupancyGrid
from ial.pose import Pose
from ial.study.blocked_rays import blocked_rays


@kernel
def _point_to_cell(x, y, column, row):  # type: ignore[no-untyped-def]
    """Return the distance of a point from a closed cell, all in cells."""
    dx = max(column - x, 0.0, x - column - 1.0)
    dy = max(row - y, 0.0, y - row - 1.0)
    return math.sqrt(dx * dx + dy * dy)


@kernel
def _corner_to_segment(cx, cy, ax, ay, bx, by):  # type: ignore[no-untyped-def]
    dx, dy = bx - ax, by - ay
    length = dx * dx + dy * dy
    t = 0.0 if length == 0.0 else min(max(((cx - ax) * dx + (cy - ay) * dy) / length, 0.0), 1.0)
    return math.sqrt((ax + t * dx - cx) ** 2 + (ay + t * dy - cy) ** 2)


@kernel
def _meets_cell(ax, ay, bx, by, column, row):  # type: ignore[no-untyped-def]
    """Return whether a segment passes through a closed cell (Liang and Barsky's clipping)."""
    start, stop = 0.0, 1.0
    for a, d, low in ((ax, bx - ax, column), (ay, by - ay, row)):
        if d == 0.0:
            if a < low or a > low + 1.0:
                return False
        else:
            t0, t1 = (low - a) / d, (low + 1.0 - a) / d
            start = max(start, min(t0, t1))
            stop = min(stop, max(t0, t1))
    return start <= stop


@kernel
def _segment_to_cell(ax, ay, bx, by, column, row):  # type: ignore[no-untyped-def]
    """Return the distance of a segment from a closed cell, all in cells: at an end of the segment or at a corner, unless they meet."""
    if _meets_cell(ax, ay, bx, by, column, row):
        return 0.0
    nearest = min(_point_to_cell(ax, ay, column, row), _point_to_cell(bx, by, column, row))
    for cx in (column, column + 1.0):
        for cy in (row, row + 1.0):
            nearest = min(nearest, _corner_to_segment(cx, cy, ax, ay, bx, by))
    return nearest


@kernel
def _near_occupied(ax, ay, bx, by, distance, occupied):  # type: ignore[no-untyped-def]
    rows, columns = occupied.shape
    left = max(int(math.floor(min(ax, bx) - distance)) - 1, 0)
    right = min(int(math.floor(max(ax, bx) + distance)) + 1, columns - 1)
    below = max(int(math.floor(min(ay, by) - distance)) - 1, 0)
    above = min(int(math.floor(max(ay, by) + distance)) + 1, rows - 1)
    for row in range(below, above + 1):
        for column in range(left, right + 1):
            if occupied[row, column] and _segment_to_cell(ax, ay, bx, by, float(column), float(row)) <= distance:
                return True
    return False


@kernel
def _good(ends, directions, errors, x, y, theta, distance, resolution, occupied, good):  # type: ignore[no-untyped-def]
    c, s = math.cos(theta), math.sin(theta)
    for i in range(len(ends)):
        dx = c * directions[i, 0] - s * directions[i, 1]
        dy = s * directions[i, 0] + c * directions[i, 1]
        ex = x + c * ends[i, 0] - s * ends[i, 1]
        ey = y + s * ends[i, 0] + c * ends[i, 1]
        along, across = errors[i, 0], errors[i, 1]
        lines = 1 + 2 * int(math.ceil(across / (0.1 * resolution)))
        for line in range(lines):
            shift = across * (2.0 * line / (lines - 1.0) - 1.0) if lines > 1 else 0.0
            mx, my = ex - shift * dy, ey + shift * dx
            ax, ay = (mx - along * dx) / resolution, (my - along * dy) / resolution
            bx, by = (mx + along * dx) / resolution, (my + along * dy) / resolution
            if _near_occupied(ax, ay, bx, by, distance / resolution, occupied):
                good[i] = True
                break


def bad_beams(beams: Beams, pose: Pose, grid: OccupancyGrid, map_error_m: float) -> int:
    """Return how many beams are bad at a pose of the base in the grid's frame: those that end nowhere, and those that are blocked."""
    bad = ~good_beams(beams, pose, grid, map_error_m)
    if beams.rays is None:
        return int(bad.sum())
    numbers = beams.rays.beams[blocked_rays(beams.rays, pose, grid)]
    bad[numbers[numbers >= 0]] = True
    return int(bad.sum() + (numbers < 0).sum())


def good_beams(beams: Beams, pose: Pose, grid: OccupancyGrid, map_error_m: float) -> np.ndarray:
    """Return which beams are good at a pose of the base in the grid's frame, bool of shape (n,).

    A beam is good if a point of its error region lies within `map_error_m` (Euclidean distance) of a closed occupied cell. The region
    is scanned by segments along the beam, a tenth of a cell apart; with a bearing error a beam that is good by less than that may be
    counted as bad, never the other way round.
    """
    good = np.zeros(len(beams.ends), dtype=np.bool_)
    occupied = grid.mask(OCCUPIED)
    _good(beams.ends, beams.directions, beams.errors, pose.x, pose.y, pose.theta, map_error_m, grid.resolution, occupied, good)
    return good
