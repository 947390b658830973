"""Which pairs of walls a straight way of a given length may join, and in which directions: a sieve before anything is solved.

Computed in plain doubles with two margins. Coordinates are below the size of the polygon and each is rounded once; what follows are fewer
than twenty roundings, below 1e-14 of the size in a distance, and below 1e-8 in the angle of a vector that is longer than `_SHORT`.
"""

import math

import numpy as np

from ial.contractors.kernels import kernel
from ial.contractors.margins import ROUNDINGS

_SHORT = 1e-6  # of the size: the angle of a shorter vector is not looked at
_LENGTH = 512.0 * ROUNDINGS  # of the size: what may be rounded in a distance
_ANGLE = _LENGTH / (8.0 * _SHORT)  # radians


@kernel
def _to_segment(px, py, ax, ay, ex, ey):  # type: ignore[no-untyped-def]
    """Return the distance of a point from a wall."""
    part = ((px - ax) * ex + (py - ay) * ey) / (ex * ex + ey * ey)
    part = min(max(part, 0.0), 1.0)
    return math.hypot(px - ax - part * ex, py - ay - part * ey)


@kernel
def wrapped(angle):  # type: ignore[no-untyped-def]
    """Return about the same angle between −π and π."""
    return angle - 2.0 * math.pi * math.floor(angle / (2.0 * math.pi) + 0.5)


@kernel
def chords(corners, edges, links, size):  # type: ignore[no-untyped-def]
    """Return a table of all pairs of walls, float64 of shape (n, n, 4).

    For each: the least and the greatest distance between points of them, the middle of the directions from one to the other, and how far
    directions are from that at most. A pair of which the second wall cannot be reached from the first has an empty range of distances.
    """
    n = len(corners)
    table = np.empty((n, n, 4))
    for i in range(n):
        ax, ay, ex, ey = corners[i, 0], corners[i, 2], edges[i, 0], edges[i, 2]
        for j in range(n):
            bx, by, fx, fy = corners[j, 0], corners[j, 2], edges[j, 0], edges[j, 2]
            table[i, j, 0], table[i, j, 1], table[i, j, 2], table[i, j, 3] = np.inf, -np.inf, 0.0, np.inf
            one, other = fx * (ay - by) - fy * (ax - bx), fx * (ay + ey - by) - fy * (ax + ex - bx)  # left of the other wall?
            doubt = _LENGTH * size * math.hypot(fx, fy)
            if i == j or (one < -doubt and other < -doubt):
                continue
            one, other = ex * (by - ay) - ey * (bx - ax), ex * (by + fy - ay) - ey * (bx + fx - ax)
            doubt = _LENGTH * size * math.hypot(ex, ey)
            if one < -doubt and other < -doubt:
                continue
            joined = links[i, 0] == j or links[j, 0] == i
            least = min(
                min(_to_segment(ax, ay, bx, by, fx, fy), _to_segment(ax + ex, ay + ey, bx, by, fx, fy)),
                min(_to_segment(bx, by, ax, ay, ex, ey), _to_segment(bx + fx, by + fy, ax, ay, ex, ey)),
            )
            least = 0.0 if joined else least
            table[i, j, 0] = least - _LENGTH * size
            most, known = 0.0, joined or least > _SHORT * size
            middle = math.atan2(by + 0.5 * fy - ay - 0.5 * ey, bx + 0.5 * fx - ax - 0.5 * ex)
            low, high = 0.0, 0.0
            for s in range(2):
                for t in range(2):
                    dx, dy = bx + t * fx - ax - s * ex, by + t * fy - ay - s * ey
                    length = math.hypot(dx, dy)
                    most = max(most, length)
                    if joined and length < _LENGTH * size:
                        continue  # the corner that both have
                    known = known and length > _SHORT * size
                    off = wrapped(math.atan2(dy, dx) - middle)
                    low, high = min(low, off), max(high, off)
            table[i, j, 1] = most + _LENGTH * size
            if known:
                table[i, j, 2] = middle + 0.5 * (low + high)
                table[i, j, 3] = 0.5 * (high - low) + _ANGLE
    return table


@kernel
def blocked(corners, edges, px, py, qx, qy, doubt):  # type: ignore[no-untyped-def]
    """Return whether a wall crosses the way from p to q well inside of both: by more than a doubt, in metres."""
    ux, uy = qx - px, qy - py
    length = math.hypot(ux, uy)
    for j in range(len(corners)):
        cx, cy, ex, ey = corners[j, 0] - px, corners[j, 2] - py, edges[j, 0], edges[j, 2]
        one = (ux * cy - uy * cx) / length
        other = one + (ux * ey - uy * ex) / length
        if min(one, other) < -doubt and max(one, other) > doubt:
            wide = math.hypot(ex, ey)
            start, end = (cx * ey - cy * ex) / wide, ((cx - ux) * ey - (cy - uy) * ex) / wide
            if min(start, end) < -doubt and max(start, end) > doubt:
                return True
    return False
