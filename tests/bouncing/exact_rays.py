"""Rays among exact walls, in 60 digits: an oracle of the ray mode that shares no code with it."""

from dataclasses import dataclass
from fractions import Fraction

import mpmath

from ial.maps.polygons.environment import Environment

DIGITS = 60
_SURE = mpmath.mpf(10) ** -40  # what decides is never nearer to 0 than this, unless it is 0


def exact(value: float | Fraction) -> mpmath.mpf:
    """Return a number in 60 digits."""
    with mpmath.workdps(DIGITS):
        fraction = Fraction(value)
        return mpmath.mpf(fraction.numerator) / fraction.denominator


@dataclass(frozen=True)
class ExactWalls:
    """The walls of an environment, from corner to corner, counted from its lower left corner."""

    starts: list[tuple[mpmath.mpf, mpmath.mpf]]
    ends: list[tuple[mpmath.mpf, mpmath.mpf]]

    @classmethod
    def of(cls, environment: Environment) -> "ExactWalls":
        """Return all walls, in the order of the rings."""
        x0, y0, _, _ = environment.bounds
        rings = [[(exact(x - x0), exact(y - y0)) for x, y in ring] for polygon in environment.polygons for ring in polygon.rings]
        starts = [corner for ring in rings for corner in ring]
        return cls(starts, [ring[(at + 1) % len(ring)] for ring in rings for at in range(len(ring))])

    def point(self, wall: int, part: float) -> tuple[mpmath.mpf, mpmath.mpf]:
        """Return a point of a wall."""
        with mpmath.workdps(DIGITS):
            (ax, ay), (bx, by) = self.starts[wall], self.ends[wall]
            return ax + exact(part) * (bx - ax), ay + exact(part) * (by - ay)

    def angle(self, wall: int) -> mpmath.mpf:
        """Return the direction of a wall, from −π to π."""
        with mpmath.workdps(DIGITS):
            (ax, ay), (bx, by) = self.starts[wall], self.ends[wall]
            return mpmath.atan2(by - ay, bx - ax)

    def first_hit(self, wall: int, part: float, heading: mpmath.mpf) -> tuple[int, mpmath.mpf, mpmath.mpf] | None:
        """Return which wall a robot meets that leaves a point between the ends of a wall: the wall, the part of it, and the distance.

        None if its heading does not certainly lead away from its wall, or if it meets a corner.
        """
        with mpmath.workdps(DIGITS):
            x, y = self.point(wall, part)
            dx, dy = mpmath.cos(heading), mpmath.sin(heading)
            hits = []
            for at, ((ax, ay), (bx, by)) in enumerate(zip(self.starts, self.ends, strict=True)):
                ex, ey = bx - ax, by - ay
                cut = dx * ey - dy * ex  # positive where the robot would leave the free space
                if at == wall:
                    if cut > -_SURE:
                        return None
                elif abs(cut) > _SURE:
                    way = ((ax - x) * ey - (ay - y) * ex) / cut
                    there = ((ax - x) * dy - (ay - y) * dx) / cut
                    if way > 0 and -_SURE < there < 1 + _SURE:
                        hits.append((way, at, there, cut))
            way, at, there, cut = min(hits)
            return (at, there, way) if cut > 0 and _SURE < there < 1 - _SURE else None
