"""`ContactEdge`: where the centre of a disk is when it touches a wall or a corner, edge by edge; for a point, the walls themselves.

The centre of a disk that touches a wall lies on a parallel line at the distance of its radius. Where it touches a reflex corner, it lies on
an arc, of which the edge is a chord. At a convex corner the parallels are cut off where they cross. What is farther away is not looked at:
edges may cross each other, and run where the disk does not fit. But every point of them lies within the radius of a wall, so the centre can
cross none of them, and wherever the disk touches something it can bump into, its centre is on one of them, or over a chord.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from ial.contractors.margins import ABOVE, ROUNDINGS
from ial.maps.polygons.polygon import ExactPoint, ExactRing
from ial.maps.polygons.ring import cross

_BITS = 160  # of roots; what is rounded there is far below the rounding of a coordinate to a double
_WIDEST_DEG = 15.0
NO_FACT = 2


@dataclass(frozen=True)
class ContactEdge:
    """An edge, with free space on its left. It ends where the next one of its ring starts.

    Parameters
    ----------
    x, y
        Where it starts, in metres.
    bend
        1 if the edges that meet there are cut off at a convex corner, 0 on a straight line, −1 where they go around a reflex corner, 2 at a
        convex corner that is too close to another one to be cut off: nothing is known of which side of the one the other lies.
    bulge_m
        How far the arc lies before its chord, at most; 0 for all that is straight.
    tilt
        By how much the arc turns from its chord, at most, in radians; −2 where the centre is in no contact: they only close rings.
    """

    x: Fraction
    y: Fraction
    bend: int
    bulge_m: float = 0.0
    tilt: float = 0.0


BARRIER = -2.0


@dataclass(frozen=True)
class _Side:
    """A wall: its length, its unit vector and its parallel's distance vector, right to far more bits than a double has."""

    length: Fraction
    ux: Fraction
    uy: Fraction

    @classmethod
    def of(cls, a: ExactPoint, b: ExactPoint) -> "_Side":
        ex, ey = b[0] - a[0], b[1] - a[1]
        square = ex * ex + ey * ey
        length = Fraction(math.isqrt(square.numerator * square.denominator << 2 * _BITS), square.denominator << _BITS)
        return cls(length, ex / length, ey / length)

    def beside(self, corner: ExactPoint, radius: Fraction) -> ExactPoint:
        """Return the point at a distance to the left of a corner."""
        return corner[0] - radius * self.uy, corner[1] + radius * self.ux


def contact_edges(ring: ExactRing, radius: Fraction) -> list[ContactEdge]:
    """Return the edges for a ring of walls with free space on its left.

    Parameters
    ----------
    ring
        The corners.
    radius
        The radius of the disk in metres; 0 for a point, whose edges are the walls.
    """
    count = len(ring)
    bends = [_sign(cross(ring[at - 1], ring[at], ring[(at + 1) % count])) for at in range(count)]  # type: ignore[arg-type]
    if not radius:
        return [ContactEdge(x, y, bend) for (x, y), bend in zip(ring, bends, strict=True)]
    sides = [_Side.of(ring[at], ring[(at + 1) % count]) for at in range(count)]
    cuts = [_cut(sides[at - 1], sides[at], radius) if bends[at] >= 0 else Fraction(0) for at in range(count)]
    # A wall whose cuts leave nothing of it, or end nearly at its ends, keeps all of its parallel.
    whole = [(cuts[at] + cuts[(at + 1) % count]) * ABOVE >= sides[at].length for at in range(count)]
    edges: list[ContactEdge] = []
    for at, corner in enumerate(ring):
        before, after = sides[at - 1], sides[at]
        if bends[at] < 0:
            edges += _around(corner, before, after, radius)
        elif bends[at] == 0:
            edges.append(ContactEdge(*after.beside(corner, radius), 0))
        elif whole[at - 1] or whole[at]:
            edges += [
                ContactEdge(*before.beside(corner, radius), NO_FACT, tilt=BARRIER),
                ContactEdge(*after.beside(corner, radius), NO_FACT),
            ]
        else:
            share = radius / (1 + before.ux * after.ux + before.uy * after.uy)
            edges.append(ContactEdge(corner[0] - share * (before.uy + after.uy), corner[1] + share * (before.ux + after.ux), bends[at]))
    return edges


def _sign(value: Fraction) -> int:
    return (value > 0) - (value < 0)


def _cut(before: _Side, after: _Side, radius: Fraction) -> Fraction:
    """Return how long both walls of a convex corner must be so that the parallels are cut off where they cross.

    They cross at r·tan(θ/2) from the corner, for walls that turn by θ; the points beyond lie nearer to the other wall than the radius, if
    that is so long that it is nearest to it, r·sin θ.
    """
    cosine, sine = before.ux * after.ux + before.uy * after.uy, before.ux * after.uy - before.uy * after.ux
    if 1 + cosine <= Fraction(1, 1 << 40):
        return before.length + after.length  # the walls nearly fold back on each other
    return radius * sine * max(1 / (1 + cosine), Fraction(1))


def _around(corner: ExactPoint, before: _Side, after: _Side, radius: Fraction) -> Iterator[ContactEdge]:
    """Yield the chords around a reflex corner, and the parallel after them."""
    begin = math.atan2(float(before.ux), -float(before.uy))  # the direction from the corner to the centre
    turned = math.atan2(
        float(before.uy * after.ux - before.ux * after.uy), float(before.ux * after.ux + before.uy * after.uy)
    )  # clockwise, from 0 to π
    chords = max(math.ceil(math.degrees(turned) / _WIDEST_DEG), 1)
    tilt = turned / (2 * chords) * ABOVE + 8.0 * ROUNDINGS  # half of what a chord spans; its ends are rounded angles below 2π
    bulge = float(radius) * (2.0 * math.sin(0.5 * tilt) ** 2) * ABOVE
    for chord in range(chords):
        angle = begin - turned * chord / chords
        x, y = corner[0] + radius * Fraction(math.cos(angle)), corner[1] + radius * Fraction(math.sin(angle))
        yield ContactEdge(*((x, y) if chord else before.beside(corner, radius)), -1, bulge, tilt)
    yield ContactEdge(*after.beside(corner, radius), -1)
