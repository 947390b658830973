"""`Visibility`: which points of a closed polygon see each other, exactly, and which pairs of its corners are bitangents."""

from collections.abc import Iterator, Sequence
from functools import cached_property

import numpy as np
import numpy.typing as npt

from ial.contractors.margins import ROUNDINGS
from ial.maps.polygons.exact.rational import Rational
from ial.maps.polygons.exact.shooter import Shooter

FloatArray = npt.NDArray[np.float64]
Place = Sequence[Rational]


class Visibility:
    """Sight among the walls of a polygon: a line of sight may slide along walls and touch corners, since the free space is closed.

    Parameters
    ----------
    shooter
        The walls.

    Examples
    --------
    >>> from fractions import Fraction
    >>> from ial.maps.polygons.polygon import Polygon
    >>> sight = Visibility(Shooter(Polygon(((0, 0), (4, 0), (4, 2), (2, 2), (2, 4), (0, 4)))))
    >>> sight.sees((Fraction(4), Fraction(0)), (Fraction(0), Fraction(4)))  # past the corner
    True
    >>> sight.sees((Fraction(4), Fraction(1)), (Fraction(0), Fraction(4)))
    False
    """

    def __init__(self, shooter: Shooter) -> None:
        self.shooter = shooter
        mx, my = shooter.corners[0]
        self._origin = mx, my
        self._corners = np.array([(float(x - mx), float(y - my)) for x, y in shooter.corners])
        self._scale = float(np.abs(self._corners).max())
        self._ends = self._corners[np.array(shooter.after)]

    def __repr__(self) -> str:
        return f"<Visibility in {self.shooter!r}>"

    def sees(self, one: Place, other: Place) -> bool:
        """Return whether the whole segment between two points of the closed polygon lies in it."""
        return self.seen(one, [other])[0]

    @cached_property
    def turns(self) -> list[int]:
        """The corners at which a shortest path can turn: those with more than half a turn of free space."""
        edges, before = self.shooter.edges, self.shooter.before
        return [corner for corner, (bx, by) in enumerate(edges) if edges[before[corner]][0] * by - edges[before[corner]][1] * bx < 0]

    def seen_turns(self, place: Place) -> list[int]:
        """Return which corners of `turns` a point sees."""
        corners = self._doubtful(place)
        seen = self.seen(place, [self.shooter.corners[corner] for corner in corners])
        return [corner for corner, each in zip(corners, seen, strict=True) if each]

    def is_bitangent(self, one: int, other: int) -> bool:
        """Return whether two corners see each other, and a line of sight through them goes on behind both.

        Such a line is a spurious edge of two visibility polygons at once, in opposite directions (O'Kane 2005, section 3.2.2).
        """
        if one == other:
            return False
        begin, end = self.shooter.corners[one], self.shooter.corners[other]
        ahead = end[0] - begin[0], end[1] - begin[1]
        before, behind = self.shooter.shoot_all([begin, end], [(-ahead[0], -ahead[1]), ahead])
        return before.place != begin and behind.place != end and self.sees(begin, end)

    def bitangents(self) -> Iterator[tuple[int, int]]:
        """Yield the pairs of corners of `turns` that are bitangents, the lesser number first."""
        for at, one in enumerate(self.turns):
            yield from ((one, other) for other in self.turns[at + 1 :] if self.is_bitangent(one, other))

    def seen(self, place: Place, others: Sequence[Place]) -> list[bool]:
        """Return for each of some points whether a point sees it, as `sees` does; faster for many of them."""
        ways = [(x - place[0], y - place[1]) for x, y in others]
        apart = [way for way in ways if any(way)]
        ends = iter(self.shooter.shoot_all([place] * len(apart), apart))
        seen = []
        for (x, y), (dx, dy) in zip(others, ways, strict=True):
            end = next(ends) if dx or dy else None
            seen.append(end is None or (end.x - x) * dx + (end.y - y) * dy >= 0)
        return seen

    def _doubtful(self, place: Place) -> list[int]:
        """Return the corners of `turns` that no wall hides for certain, by doubles."""
        if not self.turns:
            return []
        (mx, my), (px, py) = self._origin, place
        point = np.array([float(px - mx), float(py - my)])
        turns = np.array(self.turns)
        to = self._corners[turns] - point
        begin, end = self._corners - point, self._ends - point
        certain = 16.0 * ROUNDINGS * self._scale**2  # each product is of two numbers of at most twice the scale, rounded a few times
        one = to[:, :1] * begin[:, 1] - to[:, 1:] * begin[:, 0]  # on which side of the line of sight a wall begins
        other = to[:, :1] * end[:, 1] - to[:, 1:] * end[:, 0]
        way = end - begin
        here = way[:, 1] * begin[:, 0] - way[:, 0] * begin[:, 1]  # on which side of a wall the point is
        there = here[None, :] - (way[:, 1] * to[:, :1] - way[:, 0] * to[:, 1:])
        hidden = _apart(one, other, certain) & _apart(here[None, :], there, certain)
        return [int(each) for each in turns[~hidden.any(axis=1)]]


def _apart(one: FloatArray, other: FloatArray, certain: float) -> npt.NDArray[np.bool_]:
    """Return where two numbers certainly have different signs."""
    return (np.minimum(one, other) < -certain) & (np.maximum(one, other) > certain)
