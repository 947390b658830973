"""`rounded_share`: what becomes of a localizing sequence whose directions are rounded to doubles."""

import math
from collections.abc import Iterable
from fractions import Fraction

from ial.compass.primitive import Direction
from ial.compass.robot import CompassRobot
from ial.compass.sequence import Sequence
from ial.maps.polygons.polygon import ExactPoint

NEAR_M = 1e-3


def rounded(direction: Direction) -> Direction:
    """Return a direction of length 1 as two doubles hold it, as whole numbers."""
    x, y = direction
    largest = max(abs(x), abs(y))
    fx, fy = x / largest, y / largest
    length = math.hypot(fx, fy)
    exact = Fraction(fx / length), Fraction(fy / length)
    scale = math.lcm(exact[0].denominator, exact[1].denominator)
    return int(exact[0] * scale), int(exact[1] * scale)


def rounded_share(sequence: Sequence, starts: Iterable[ExactPoint], near_m: float = NEAR_M) -> float:
    """Return which part of some starts end near the end of a sequence if its directions are unit vectors of doubles.

    Everything else is carried out exactly. A motion along a wall is one no more when it is rounded: it stops at once, or leaves the wall.
    That is why the sequences of the papers, whose directions are unit vectors, must not be computed in doubles.

    Parameters
    ----------
    sequence
        The sequence.
    starts
        Where robots start, at least one.
    near_m
        How near is near, in metres.

    Raises
    ------
    MapError
        If a start lies outside of the environment.
    """
    directions = [rounded(each) for each in sequence.directions]
    near = []
    for start in starts:
        robot = CompassRobot(sequence.polygon, start)
        for direction in directions:
            robot.drive(*direction)
        near.append(math.hypot(*(float(one - other) for one, other in zip(robot.place, sequence.end, strict=True))) <= near_m)
    return sum(near) / len(near)
