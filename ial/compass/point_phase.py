"""`PointPhase`: the second part of a plan, motions that bring the points which are left together, with directions of few bits."""

from collections.abc import Iterator
from itertools import combinations

from ial.compass.chase import Chase, Pair
from ial.compass.gathering import Gathering
from ial.compass.primitive import Direction
from ial.compass.segment_phase import Order
from ial.compass.state import InformationState
from ial.compass.transition import Transition
from ial.compass.wall_distances import WallDistances
from ial.errors import SequenceError
from ial.maps.polygons.exact.shooter import BoundaryPoint
from ial.maps.polygons.exact.shortest_path import ShortestPaths

_PAIRS = 3  # that the greedy order chases at once


class PointPhase:
    """Merges points until one is left, as pairs in the paper's order, and as many at once as possible in the greedy one.

    Two points on one wall become one by a motion along it, exactly. To get there one chases the other along the shortest path between
    them, by directions that are rounded to few bits (O'Kane 2005, section 3.2.2). The thesis drives straight from one point to the other
    instead; its directions, and with them the points, get longer with each motion, up to millions of bits.

    Parameters
    ----------
    transition
        What a motion does.
    order
        Which points to bring together first.
    paths
        The shortest paths.
    distances
        How far walls are apart.
    """

    def __init__(self, transition: Transition, order: Order, paths: ShortestPaths, distances: WallDistances) -> None:
        self.transition = transition
        self.order = order
        self._paths = paths
        self._gathering = Gathering(transition, distances) if order == "greedy" else None

    def __repr__(self) -> str:
        return f"<PointPhase in {self.transition.shooter!r}, {self.order} order>"

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
            found = None if self._gathering is None else self._gathering.search(state)
            for direction in found or self._chase(state):
                state = self.transition(state, direction)
                yield direction, state

    def _chase(self, state: InformationState) -> list[Direction]:
        """Return the motions after which there are fewer points."""
        pairs = [(0, 1)] if self.order == "paper" else self._nearest(state)
        for wide in (False, True):
            found = Chase(self.transition, self._paths, wide).search(state, pairs)
            if found is not None:
                return found
        raise SequenceError(
            f"none found: {len(state.points)} places are left of which no two are brought together; this is no proof that there is no "
            "sequence"
        )

    def _nearest(self, state: InformationState) -> list[Pair]:
        """Return which pairs of points have the shortest paths between them."""
        points = state.points
        pairs = sorted(combinations(range(len(points)), 2), key=lambda pair: _straight(points[pair[0]], points[pair[1]]))
        found: list[tuple[float, Pair]] = []
        for one, other in pairs:
            if len(found) >= _PAIRS and _straight(points[one], points[other]) >= found[_PAIRS - 1][0]:
                break
            found.append((self._paths.length(points[one].place, points[other].place), (one, other)))
            found.sort()
        return [pair for _, pair in found[:_PAIRS]]


def _straight(one: BoundaryPoint, other: BoundaryPoint) -> float:
    return float((float(one.x - other.x) ** 2 + float(one.y - other.y) ** 2) ** 0.5)
