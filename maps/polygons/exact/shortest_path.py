"""`ShortestPaths`: the shortest way between two points of a closed polygon, with or without holes."""

from functools import cached_property

import numpy as np
import numpy.typing as npt
from scipy.sparse.csgraph import dijkstra

from ial.maps.polygons.exact.rational import Rational
from ial.maps.polygons.exact.visibility import Place, Visibility
from ial.maps.polygons.polygon import ExactPoint

FloatArray = npt.NDArray[np.float64]

_KEPT = 10_000  # points whose sight is kept: a search asks for the same ones again and again


class ShortestPaths:
    """Shortest paths by the graph of corners that see each other.

    Which points see each other is decided exactly, so that a path never cuts a corner; lengths are doubles, so that of two paths whose
    lengths differ by a rounding either may be taken.

    Parameters
    ----------
    visibility
        Sight in the polygon.

    Examples
    --------
    >>> from fractions import Fraction
    >>> from ial.maps.polygons.exact.shooter import Shooter
    >>> from ial.maps.polygons.polygon import Polygon
    >>> sight = Visibility(Shooter(Polygon(((0, 0), (4, 0), (4, 2), (2, 2), (2, 4), (0, 4)))))
    >>> paths = ShortestPaths(sight)
    >>> round(paths.length((Fraction(4), Fraction(1)), (Fraction(1), Fraction(4))), 6)
    4.472136
    >>> [str(x) for x, _ in paths.path((Fraction(4), Fraction(1)), (Fraction(1), Fraction(4)))]
    ['4', '2', '1']
    """

    def __init__(self, visibility: Visibility) -> None:
        self.visibility = visibility
        self._position = {corner: at for at, corner in enumerate(visibility.turns)}

        self._fans: dict[tuple[Rational, Rational], tuple[npt.NDArray[np.int64], FloatArray]] = {}

    def __repr__(self) -> str:
        return f"<ShortestPaths in {self.visibility.shooter!r}>"

    def length(self, one: Place, other: Place) -> float:
        """Return the length of the shortest path between two points of the closed polygon, in metres, to nearest."""
        return self._best(one, other)[0]

    def path(self, one: Place, other: Place) -> list[ExactPoint]:
        """Return the shortest path: both points, and the corners at which it turns, exactly.

        Parameters
        ----------
        one, other
            x and y in metres, in the closed polygon; elsewhere the result means nothing.
        """
        return self.route(one, other)[1]

    def route(self, one: Place, other: Place) -> tuple[float, list[ExactPoint]]:
        """Return the length of the shortest path and the path itself."""
        places = self.visibility.shooter.corners
        length, begin, end = self._best(one, other)
        corners: list[int] = []
        if end is not None and begin is not None:
            _, came_from = self._tables
            at = end
            while at >= 0:
                corners.append(self.visibility.turns[at])
                at = int(came_from[begin, at])
            corners.reverse()
        found: list[ExactPoint] = [(one[0], one[1])]
        for place in (*(places[corner] for corner in corners), (other[0], other[1])):
            if place != found[-1]:
                found.append(place)
        return length, found

    def fan(self, place: Place) -> tuple[npt.NDArray[np.int64], FloatArray]:
        """Return the corners where a path from a point can turn first, as positions in `Visibility.turns`, and how far they are."""
        key = place[0], place[1]
        if key in self._fans:
            return self._fans[key]
        if len(self._fans) >= _KEPT:
            self._fans.clear()
        seen = self.visibility.seen_turns(place)
        far = [_distance(place, self.visibility.shooter.corners[corner]) for corner in seen]
        self._fans[key] = np.array([self._position[corner] for corner in seen], dtype=np.int64), np.array(far)
        return self._fans[key]

    @property
    def between(self) -> FloatArray:
        """The lengths of the shortest paths between all pairs of corners of `Visibility.turns`, in metres."""
        return self._tables[0]

    @cached_property
    def hops(self) -> npt.NDArray[np.int64]:
        """How many straight parts the shortest paths between all pairs of corners of `Visibility.turns` have."""
        lengths, came_from = self._tables
        parts = np.zeros(lengths.shape, dtype=np.int64)
        for begin, before in enumerate(came_from):
            for end in np.argsort(lengths[begin], kind="stable").tolist():
                if before[end] >= 0:
                    parts[begin, end] = 1 + parts[begin, before[end]]
        return parts

    def _best(self, one: Place, other: Place) -> tuple[float, int | None, int | None]:
        """Return the length of the shortest path, and where it turns first and last."""
        if self.visibility.sees(one, other):
            return _distance(one, other), None, None
        (first, near), (last, far) = self.fan(one), self.fan(other)
        lengths = near[:, None] + self.between[np.ix_(first, last)] + far[None, :]
        at, to = np.unravel_index(int(np.argmin(lengths)), lengths.shape)
        return float(lengths[at, to]), int(first[at]), int(last[to])

    @cached_property
    def _tables(self) -> tuple[FloatArray, npt.NDArray[np.int32]]:
        """For all pairs of corners of `Visibility.turns` the length between them, and which corner comes before the second one."""
        turns, corners = self.visibility.turns, self.visibility.shooter.corners
        weights = np.zeros((len(turns), len(turns)))  # 0: no line of sight
        for at, corner in enumerate(turns):
            for seen in self.visibility.seen_turns(corners[corner]):
                weights[at, self._position[seen]] = _distance(corners[corner], corners[seen])
        lengths, came_from = dijkstra(weights, directed=False, return_predecessors=True)
        return lengths, came_from


def _distance(one: Place, other: Place) -> float:
    (ax, ay), (bx, by) = one, other
    dx: Rational = bx - ax
    dy: Rational = by - ay
    return float(np.hypot(float(dx), float(dy)))
