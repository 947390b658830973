"""Rotations with translations that lay one polygon upon another: the symmetries of a polygon, and what two polygons have in common.

No reflections: a robot that turns left knows its left from its right.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.maps.polygons.exact.rational import Rational, rational
from ial.maps.polygons.polygon import ExactRing, Polygon

FloatArray = npt.NDArray[np.float64]
Sides = list[tuple[Rational, Rational, Rational]]


@dataclass(frozen=True)
class Congruence:
    """A rotation about the origin, and then a translation.

    Parameters
    ----------
    cosine, sine
        Of the rotation.
    x, y
        The translation in metres.
    exact
        Whether it lays each corner exactly upon a corner; otherwise within the tolerance that was asked for.
    """

    cosine: Rational | float
    sine: Rational | float
    x: Rational | float
    y: Rational | float
    exact: bool

    @property
    def turn_rad(self) -> float:
        """The angle of the rotation, from −π to π."""
        return math.atan2(float(self.sine), float(self.cosine))

    def moved(self, x: float, y: float) -> tuple[float, float]:
        """Return where a point comes to, in metres, to about the nearest doubles."""
        c, s = float(self.cosine), float(self.sine)
        return c * x - s * y + float(self.x), s * x + c * y + float(self.y)


def congruences(one: Polygon, other: Polygon) -> list[Congruence]:
    """Return every rotation with a translation that lays one polygon exactly upon another, by their outer rings.

    Corners at which a ring goes straight on do not count.

    The lengths of the sides and the dot and cross products of each with the next one are a string that no motion changes; it is searched
    for in the other's, written twice, by the algorithm of Knuth, Morris and Pratt. Holes are then compared corner by corner.

    Returns
    -------
    list
        Of `one` upon itself, the identity comes first; there are 1, 2 or 4 then, since corners are rational.
    """
    one, other = _bent(one), _bent(other)
    text = _sides(other.outer)
    return [found for shift in _occurrences(_sides(one.outer), text) if (found := _exact(one, other, shift)) is not None]


def near_congruences(one: Polygon, other: Polygon, tolerance_m: float) -> list[Congruence]:
    """Return the rotations with translations that lay each corner of a polygon within a tolerance of a corner of another one.

    A regular pentagon has no corners in rational numbers, and its exact symmetries are lost; these are not. Computed in doubles, so that
    the tolerance must be far above 1e-15 of the size. Corners at which a ring goes straight on do not count.

    Parameters
    ----------
    one, other
        The polygons.
    tolerance_m
        How far a corner may miss the other one, in metres.
    """
    one, other = _bent(one), _bent(other)
    if len(one.outer) != len(other.outer) or sorted(map(len, one.holes)) != sorted(map(len, other.holes)):
        return []
    corners, targets = _complex(one.outer), _complex(other.outer)
    middle, middle_there = corners.mean(), targets.mean()
    lengths, lengths_there = np.abs(np.roll(corners, -1) - corners), np.abs(np.roll(targets, -1) - targets)
    numbers = np.arange(len(corners))
    differ = np.abs(lengths[None, :] - lengths_there[(numbers[:, None] + numbers[None, :]) % len(corners)]).max(axis=1)
    found = []
    for shift in np.flatnonzero(differ <= 2.0 * tolerance_m).tolist():
        turn = np.vdot(corners - middle, np.roll(targets, -shift) - middle_there)  # the least squares fit
        if abs(turn) == 0.0:
            continue
        turn /= abs(turn)
        offset = middle_there - turn * middle
        if np.abs(turn * corners + offset - np.roll(targets, -shift)).max() <= tolerance_m and _holes_match(
            one.holes, other.holes, complex(turn), complex(offset), tolerance_m
        ):
            found.append(Congruence(float(turn.real), float(turn.imag), float(offset.real), float(offset.imag), False))
    return found


def _bent(polygon: Polygon) -> Polygon:
    """Return the same area without the corners at which its rings go straight on."""
    outer, *holes = (
        tuple(corner for corner, (_, _, cross) in zip(ring[1:] + ring[:1], _sides(ring), strict=True) if cross) for ring in polygon.rings
    )
    return Polygon.trusted(outer, tuple(holes))


def _holes_match(holes: Sequence[ExactRing], others: Sequence[ExactRing], turn: complex, offset: complex, tolerance_m: float) -> bool:
    """Return whether each hole, moved, lies upon one of the others, no two upon the same."""
    left = [_complex(ring) for ring in others]
    for hole in holes:
        moved = turn * _complex(hole) + offset
        for at, target in enumerate(left):
            if len(target) == len(moved) and any(
                np.abs(moved - np.roll(target, -shift)).max() <= tolerance_m for shift in range(len(target))
            ):
                del left[at]
                break
        else:
            return False
    return not left


def _complex(ring: ExactRing) -> npt.NDArray[np.complex128]:
    return np.array([complex(float(x), float(y)) for x, y in ring])


def _sides(ring: ExactRing) -> Sides:
    """Return for each side its squared length, and its dot and cross product with the next one."""
    corners = [(rational(x), rational(y)) for x, y in ring]
    ways = [(bx - ax, by - ay) for (ax, ay), (bx, by) in zip(corners, corners[1:] + corners[:1], strict=True)]
    return [(ax * ax + ay * ay, ax * bx + ay * by, ax * by - ay * bx) for (ax, ay), (bx, by) in zip(ways, ways[1:] + ways[:1], strict=True)]


def _occurrences(pattern: Sides, ring: Sides) -> Iterator[int]:
    """Yield the shifts at which a cyclic string of the same length is a given one."""
    if len(pattern) != len(ring):
        return
    failure, length = [0] * len(pattern), 0
    for at in range(1, len(pattern)):
        while length and pattern[at] != pattern[length]:
            length = failure[length - 1]
        length += pattern[at] == pattern[length]
        failure[at] = length
    length = 0
    for at in range(2 * len(ring) - 1):
        while length and (length == len(pattern) or ring[at % len(ring)] != pattern[length]):
            length = failure[length - 1]
        length += ring[at % len(ring)] == pattern[length]
        if length == len(pattern):
            yield at - length + 1


def _exact(one: Polygon, other: Polygon, shift: int) -> Congruence | None:
    """Return the motion that lays the first side of an outer ring upon a side of another one, if all rings fit then."""
    count = len(one.outer)
    (ax, ay), (bx, by) = ((rational(x), rational(y)) for x, y in one.outer[:2])
    (cx, cy), (dx, dy) = ((rational(x), rational(y)) for x, y in (other.outer[shift % count], other.outer[(shift + 1) % count]))
    ux, uy, vx, vy = bx - ax, by - ay, dx - cx, dy - cy
    square = ux * ux + uy * uy
    cosine, sine = (ux * vx + uy * vy) / square, (ux * vy - uy * vx) / square
    x, y = cx - cosine * ax + sine * ay, cy - sine * ax - cosine * ay
    targets = {_key(ring) for ring in other.rings}
    for ring in one.rings:
        moved = [(cosine * px - sine * py + x, sine * px + cosine * py + y) for px, py in ring]
        if _key(moved) not in targets:
            return None
    return Congruence(cosine, sine, x, y, True) if len(one.rings) == len(other.rings) else None


def _key(ring: Sequence[tuple[Rational, Rational]]) -> tuple[tuple[Rational, Rational], ...]:
    """Return the same ring, begun at its least corner."""
    first = min(range(len(ring)), key=lambda at: ring[at])
    return tuple((rational(x), rational(y)) for x, y in (*ring[first:], *ring[:first]))
