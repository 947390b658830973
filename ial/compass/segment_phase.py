"""`SegmentPhase`: the first part of a plan, motions along walls until only single points are left of what is possible."""

from collections.abc import Iterator
from typing import Literal

import numpy as np

from ial.compass.primitive import MOST_BITS, Direction, bits, primitive, reverse
from ial.compass.state import InformationState
from ial.compass.transition import Transition
from ial.compass.wall_distances import WallDistances
from ial.errors import MapError, SequenceError
from ial.maps.polygons.exact.shooter import Shooter

Order = Literal["paper", "greedy"]
"""Along which wall to go next, and which points to bring together.

`paper`: along the leftmost piece, so that no piece comes back across a vertical line that sweeps to the right; then any two points
(O'Kane 2005, sections 3.2.1 and 3.2.2). `greedy`: along one of the walls that carry most, whichever leaves least and leaves it close
together; then the points that are nearest to each other. This needs fewer motions.
"""

_LINES = 4  # directions of walls that the greedy order tries, both ways
_PIECE_COST = 0.02  # of the whole boundary: what a piece more is worth beside the length of all pieces
_POINT_COST = 0.005  # and a point more
_SPAN_COST = 0.004  # and another motion between them
_PATIENCE = 5  # motions without progress after which the greedy order gives way to the paper's
_MOST_MOTIONS = 20  # for each wall


class SegmentPhase:
    """Motions along walls, each of which collapses the pieces on them to points.

    Parameters
    ----------
    transition
        What a motion does.
    order
        Along which wall to go next.
    distances
        How far walls are apart, for the greedy order.

    Raises
    ------
    MapError
        If a wall has a direction of more than 64 bits.
    """

    def __init__(self, transition: Transition, order: Order, distances: WallDistances) -> None:
        self.transition = transition
        self.order = order
        self._distances = distances
        shooter = transition.shooter
        self._lines = [wall_direction(shooter, edge) for edge in range(len(shooter))]
        self._lengths = [float(np.hypot(float(ex), float(ey))) for ex, ey in shooter.edges]
        self._around = sum(self._lengths)
        longest = max(self._lines, key=bits)
        if bits(longest) > MOST_BITS:
            raise MapError(
                f"wall {1 + self._lines.index(longest)} has a direction of {bits(longest)} bits, and a compass takes {MOST_BITS}; give "
                "corners with fewer digits"
            )

    def __repr__(self) -> str:
        return f"<SegmentPhase in {self.transition.shooter!r}, {self.order} order>"

    def run(self, state: InformationState) -> Iterator[tuple[Direction, InformationState]]:
        """Yield motions and the states after them; in the last one there are no pieces.

        Raises
        ------
        SequenceError
            If there are still pieces after 20 motions for each wall. In a polygon without holes the paper's order needs O(n³) at most, and
            was never seen to need more than two.
        """
        least, waited = self._cost(state)[0], 0
        for _ in range(_MOST_MOTIONS * len(self._lines)):
            if not state.pieces:
                return
            if self.order == "greedy" and waited < _PATIENCE:
                direction, state = self._least(state)
                cost = self._cost(state)[0]
                waited = 0 if cost < least else waited + 1
                least = min(cost, least)
            else:
                direction = self._along_leftmost(state)
                state = self.transition(state, direction)
            yield direction, state
        if state.pieces:
            raise SequenceError(
                f"none found: after {_MOST_MOTIONS * len(self._lines)} motions whole pieces of walls are still possible; this is no proof "
                "that there is no sequence"
            )

    def _along_leftmost(self, state: InformationState) -> Direction:
        """Return the direction with x ≥ 0 along the piece that begins leftmost."""
        shooter = self.transition.shooter
        begins = [(min(shooter.on_edge(each.edge, part).x for part in (each.low, each.high)), each.edge) for each in state.pieces]
        direction = self._lines[min(begins)[1]]
        return reverse(direction) if direction < (0, 0) else direction

    def _least(self, state: InformationState) -> tuple[Direction, InformationState]:
        """Return the direction along one of the walls that carry most after which least is left, and the state then."""
        carried: dict[Direction, float] = {}
        for piece in state.pieces:
            line = max(self._lines[piece.edge], reverse(self._lines[piece.edge]))
            carried[line] = carried.get(line, 0.0) + float(piece.high - piece.low) * self._lengths[piece.edge]
        lines = sorted(carried, key=lambda line: (-carried[line], line))[:_LINES]
        after = [(each, self.transition(state, each)) for line in lines for each in (line, reverse(line))]
        return min(after, key=lambda each: (sum(self._cost(each[1])), each[0]))

    def _cost(self, state: InformationState) -> tuple[float, float]:
        """Return how much is left, and how it lies, in the same unit."""
        length = sum(float(piece.high - piece.low) * self._lengths[piece.edge] for piece in state.pieces)
        walls = [*(piece.edge for piece in state.pieces), *(point.edge for point in state.points)]
        lies = _POINT_COST * len(state.points) + _SPAN_COST * float(self._distances.spans(np.array([walls]))[0])
        return length / self._around + _PIECE_COST * len(state.pieces), lies


def wall_direction(shooter: Shooter, edge: int) -> Direction:
    """Return the direction along an edge."""
    return primitive(*shooter.edges[edge])
