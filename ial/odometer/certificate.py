"""`isolated`: which candidates are proved to be single configurations, by the interval Newton method."""

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import Boxes
from ial.contractors.expressions.function import Function
from ial.contractors.expressions.variables import variables
from ial.contractors.intervals.interval import Interval
from ial.contractors.intervals.trigonometric import cos, sin
from ial.contractors.solving.zeros import certify
from ial.odometer.configurations import FloatArray
from ial.odometer.wall_table import WallTable

_ROOM = 3.0  # a box is tried with so many of its widths more, since a zero on its border is never proved
_LEAST = 1e-12


def isolated(
    walls: WallTable, origins: FloatArray, first: tuple[float, float], second: tuple[float, float], turn: tuple[float, float]
) -> npt.NDArray[np.bool_]:
    """Return which candidates are proved to be exactly one solution of their equations, for all lengths and turns within bounds.

    In a, b and c of `ial.odometer.triples`: w is as long as d_1, and p_c − p_b = (d_2/d_1)·R·w, in two coordinates. Boxes of a chain along
    a curve are proved to be none; sight is not looked at, which can only take away solutions.

    Parameters
    ----------
    walls
        The environment.
    origins
        What `ial.odometer.triples.candidates` says of where candidates come from.
    first, second
        Bounds of the lengths of the two drives, in metres.
    turn
        Bounds of the turn between them, in radians.
    """
    ratio = Interval(*second) / Interval(*first)
    cosine, sine = Interval(*cos(*turn)), Interval(*sin(*turn))
    proved = np.zeros(len(origins), dtype=np.bool_)
    for at, row in enumerate(origins):
        a, b, c = variables("a b c")
        parts, numbers = (a, b, c), row[6:].astype(np.int64).tolist()
        (ax, ay), (bx, by), (cx, cy) = (_point(walls, number, part) for number, part in zip(numbers, parts, strict=True))
        wx, wy = bx - ax, by - ay
        function = Function(
            wx**2 + wy**2 - Interval(*first) ** 2,
            cx - bx - ratio * (cosine * wx - sine * wy),
            cy - by - ratio * (sine * wx + cosine * wy),
        )
        low, high = row[0:6:2], row[1:6:2]
        room = _ROOM * (high - low) + _LEAST
        proved[at] = bool(certify(function, Boxes((low - room)[None, :], (high + room)[None, :])).unique[0])
    return proved


def _point(walls: WallTable, number: int, part):  # type: ignore[no-untyped-def]
    """Return the formulas of the coordinates of a point on a wall."""
    corner, edge = walls.corners[number].tolist(), walls.edges[number].tolist()
    return tuple(Interval(*corner[at : at + 2]) + part * Interval(*edge[at : at + 2]) for at in (0, 2))
