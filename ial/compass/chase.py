"""`Chase`: the search for motions that bring two of some points together."""

from collections.abc import Iterator
from heapq import heappop, heappush
from itertools import count

from ial.compass.primitive import MOST_BITS, Direction, bits, primitive, reverse
from ial.compass.segment_phase import wall_direction
from ial.compass.state import InformationState
from ial.compass.transition import Transition
from ial.maps.polygons.exact.rational import rational
from ial.maps.polygons.exact.shooter import BoundaryPoint, Shooter
from ial.maps.polygons.exact.shortest_path import ShortestPaths

_DIRECTION_BITS = 24
_TILTS = (0.0, 2.0**-18, -(2.0**-18), 2.0**-8, -(2.0**-8))
_MORE_TILTS = (2.0**-5, -(2.0**-5), 2.0**-3, -(2.0**-3), 0.5, -0.5, 2.0, -2.0)
_FINE = 1e-10
_MOST_TRIES = 60  # places of all points from which motions are tried

Points = tuple[BoundaryPoint, ...]
Pair = tuple[int, int]


class Chase:
    """A best-first search through motions towards each other along shortest paths, rounded to 24 bits and perhaps tilted a little.

    A tilt lets a point pass the corner at which the path turns. It is also what the special case of a bitangent needs, in which the
    directions of the thesis alternate for ever (O'Kane 2005, figure 3.6); the search itself never comes back to where it was.

    Parameters
    ----------
    transition
        What a motion does.
    paths
        The shortest paths.
    wide
        Whether to try larger tilts and all walls, too.
    """

    def __init__(self, transition: Transition, paths: ShortestPaths, wide: bool) -> None:
        self._transition = transition
        self._shooter = transition.shooter
        self._paths = paths
        self._wide = wide

    def __repr__(self) -> str:
        return f"<Chase in {self._shooter!r}>"

    def search(self, state: InformationState, pairs: list[Pair]) -> list[Direction] | None:
        """Return motions after which there are fewer points, None if none were found.

        Parameters
        ----------
        state
            Points only.
        pairs
            Which of them to bring together, by their numbers.
        """
        order = count()
        queue: list[tuple[float, float, int, Points, Pair, list[Direction]]] = []
        for pair in pairs:
            heappush(queue, (*self._promise(state.points, pair, 0), next(order), state.points, pair, []))
        seen = {key(state.points, self._shooter)}
        for _ in range(_MOST_TRIES * (1 + 4 * self._wide)):
            if not queue:
                return None
            _, _, _, points, pair, directions = heappop(queue)
            ways = [each for each in dict.fromkeys(self._ways(points, pair)) if bits(each) <= MOST_BITS]
            images = self._transition.points(points, ways)
            left = [len({point.place for point in moved}) for moved in images]
            if min(left) < len(points):
                return [*directions, ways[left.index(min(left))]]
            for way, moved in zip(ways, images, strict=True):
                if key(moved, self._shooter) not in seen:
                    seen.add(key(moved, self._shooter))
                    longer = [*directions, way]
                    heappush(queue, (*self._promise(moved, pair, len(longer)), next(order), moved, pair, longer))
        return None

    def _promise(self, points: Points, pair: Pair, taken: int) -> tuple[float, float]:
        """Return how many motions a chase will take about, those that it has taken included, and how far the two points are apart."""
        one, other = points[pair[0]], points[pair[1]]
        if edges_of(self._shooter, one) & edges_of(self._shooter, other):
            return taken, 0.0
        length, path = self._paths.route(one.place, other.place)
        return taken + len(path) - 1, length

    def _ways(self, points: Points, pair: Pair) -> Iterator[Direction]:
        """Yield directions in which one of two points drives to the other, or to the first turn on the way there; and along its walls."""
        for one, other in ((points[pair[0]], points[pair[1]]), (points[pair[1]], points[pair[0]])):
            for edge in range(len(self._shooter)) if self._wide else sorted(edges_of(self._shooter, one)):
                yield wall_direction(self._shooter, edge)
                yield reverse(wall_direction(self._shooter, edge))
            x, y = self._paths.path(one.place, other.place)[1]
            largest = max(abs(x - one.x), abs(y - one.y))
            dx, dy = float(rational(x - one.x) / largest), float(rational(y - one.y) / largest)
            for tilt in _TILTS + _MORE_TILTS * self._wide:
                scale = 2.0**_DIRECTION_BITS / max(1.0, 2.0 * abs(tilt))
                yield primitive(round((dx - tilt * dy) * scale), round((dy + tilt * dx) * scale))


def edges_of(shooter: Shooter, point: BoundaryPoint) -> set[int]:
    """Return the edges on which a point lies: two, if it is a corner."""
    return {point.edge, shooter.before[point.edge]} if point.corner else {point.edge}


def key(points: Points, shooter: Shooter) -> tuple[tuple[int, int], ...]:
    """Return what tells places of points apart, but for tiny parts of the size of the environment."""
    fine = _FINE * shooter.size_m
    return tuple((round(float(point.x) / fine), round(float(point.y) / fine)) for point in points)
