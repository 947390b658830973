"""Phase 2 of a plan: motions that bring the points which are left together, with directions of few bits."""

from collections.abc import Iterator
from itertools import combinations

from ial.compass.chase import Chase, edges_of
from ial.compass.primitive import Direction, reverse
from ial.compass.segment_phase import wall_direction
from ial.compass.state import InformationState
from ial.compass.transition import Transition
from ial.errors import SequenceError
from ial.maps.polygons.exact.shooter import BoundaryPoint
from ial.maps.polygons.exact.shortest_path import ShortestPaths
from ial.maps.polygons.exact.visibility import Visibility

_PAIRS = 3  # that are chased at once


class PointPhase:
    """Merges points two by two: one chases another along the shortest path between them (O'Kane 2005, section 3.2.2).

    It departs from the thesis in its directions. An exact direction from one point to another makes the next points longer to write
    down, up to millions of bits. Here a chase only brings a point near another one, by a direction of few bits, so that it lands on the
    same wall; two points on one wall are merged along it, exactly.

    Parameters
    ----------
    transition
        What a motion does.
    """

    def __init__(self, transition: Transition) -> None:
        self.transition = transition
        self.shooter = transition.shooter
        self.paths = ShortestPaths(Visibility(self.shooter))

    def __repr__(self) -> str:
        return f"<PointPhase in {self.shooter!r}>"

    def run(self, state: InformationState) -> Iterator[tuple[Direction, InformationState]]:
        """Yield motions and the states after them, until one point is left.

        Parameters
        ----------
        state
            Points only.

        Raises
        ------
        SequenceError
            If no pair of points is brought together. That is no proof that none can be.
        """
        while len(state.points) > 1:
            merging = self._merging(state)
            directions = [merging] if merging else self._chase(state)
            for direction in directions:
                state = self.transition(state, direction)
                yield direction, state

    def _merging(self, state: InformationState) -> Direction | None:
        """Return the direction along a wall with several points that merges most, if there is such a wall."""
        carried: dict[int, int] = {}
        for point in state.points:
            for edge in edges_of(self.shooter, point):
                carried[edge] = carried.get(edge, 0) + 1
        lines = {wall_direction(self.shooter, edge) for edge, held in carried.items() if held > 1}
        ways = [each for line in lines for each in (line, reverse(line))]
        return min(ways, key=lambda each: (len({self.transition.point(point, each).place for point in state.points}), each), default=None)

    def _chase(self, state: InformationState) -> list[Direction]:
        """Return the motions after which two points are one, or on one wall."""
        for wide in (False, True):
            found = Chase(self.transition, self.paths, wide).search(state, self._nearest(state))
            if found is not None:
                return found
        raise SequenceError(
            f"none found: {len(state.points)} places are left of which no two are brought together; this is no proof that there is no sequence"
        )

    def _nearest(self, state: InformationState) -> list[tuple[int, int]]:
        """Return which pairs of points have the shortest paths between them."""
        points = state.points
        pairs = sorted(combinations(range(len(points)), 2), key=lambda pair: _straight(points[pair[0]], points[pair[1]]))
        found: list[tuple[float, tuple[int, int]]] = []
        for one, other in pairs:
            if len(found) >= _PAIRS and _straight(points[one], points[other]) >= found[_PAIRS - 1][0]:
                break
            found.append((self.paths.length(points[one].place, points[other].place), (one, other)))
            found.sort()
        return [pair for _, pair in found[:_PAIRS]]


def _straight(one: BoundaryPoint, other: BoundaryPoint) -> float:
    return float((float(one.x - other.x) ** 2 + float(one.y - other.y) ** 2) ** 0.5)
