"""How far a disk can drive along an axis among walls along the axes, in fractions: an oracle that shares no code with the simulation."""

from fractions import Fraction
from math import isqrt

from ial.maps.polygons.environment import Environment

Point = tuple[Fraction, Fraction]


def turned(point: Point, quarters: int) -> Point:
    """Return a point turned about (0, 0), clockwise."""
    x, y = point
    for _ in range(quarters):
        x, y = y, -x
    return x, y


def below_root(square: Fraction) -> Fraction:
    """Return the square root of a number from 0 to 9, exactly if it is rational, or less than 2^-200 below it."""
    whole = isqrt(square.numerator), isqrt(square.denominator)
    if (whole[0] ** 2, whole[1] ** 2) == (square.numerator, square.denominator):
        return Fraction(*whole)
    return Fraction(isqrt(square.numerator * 4**210 // square.denominator), 2**210)


def way(environment: Environment, centre: Point, quarters: int, radius: Fraction) -> Fraction:
    """Return how far a disk can drive that overlaps nothing, in a heading of so many quarter turns.

    The disk sweeps an open strip. A wall that has no point in the strip is not in its way, whether or not it touches the strip. Of one that
    has, the point nearest to the middle line is met first.
    """
    x0, y0 = turned(centre, quarters)
    ways = []
    for polygon in environment.polygons:
        for ring in polygon.rings:
            corners = [turned(corner, quarters) for corner in ring]
            for (ax, ay), (bx, by) in zip(corners, corners[1:] + corners[:1], strict=True):
                assert ax == bx or ay == by
                low, high = sorted((ay - y0, by - y0))
                if low >= radius or high <= -radius or min(ax, bx) < x0:
                    continue  # beside the strip, or behind: a wall along the strip that reaches from behind to ahead would be overlapped
                aside = max(low, -high, Fraction(0))
                ways.append(min(ax, bx) - x0 - below_root(radius**2 - aside**2))
    return min(ways)


def is_free(environment: Environment, centre: Point, radius: Fraction) -> bool:
    """Return whether a disk overlaps no wall and lies inside."""
    x, y = centre
    inside = False
    for polygon in environment.polygons:
        for ring in polygon.rings:
            for (ax, ay), (bx, by) in zip(ring, (*ring[1:], ring[0]), strict=True):
                dx, dy = max(min(ax, bx) - x, x - max(ax, bx), Fraction(0)), max(min(ay, by) - y, y - max(ay, by), Fraction(0))
                if dx**2 + dy**2 < radius**2:
                    return False
                inside ^= ax == bx and ax < x and (ay > y) != (by > y)
    return inside
