"""Phase 1 of a plan: motions along walls, until only single points are left of what is possible."""

from collections.abc import Iterator
from typing import Literal

from ial.compass.primitive import Direction, primitive, reverse
from ial.compass.state import InformationState
from ial.compass.transition import Transition
from ial.maps.polygons.exact.shooter import Shooter

Order = Literal["paper", "greedy"]
"""Along which wall to go next.

`paper`: along the leftmost piece, so that no piece comes back across a vertical line that sweeps to the right (O'Kane 2005, section 3.2.1).
`greedy`: along one of the walls that carry most, whichever leaves least; this needs fewer motions.
"""

_LINES = 4  # walls that the greedy order tries
_PIECE_COST = 0.02  # of the whole boundary; what a piece more is worth beside the length of all pieces


def segment_phase(transition: Transition, state: InformationState, order: Order) -> Iterator[tuple[Direction, InformationState]]:
    """Yield motions and the states after them; in the last one there are no pieces.

    The greedy order falls back to the paper's as soon as what is left does not become less, so that it ends whenever that one does: in a
    polygon without holes always.
    """
    least = _cost(transition.shooter, state)
    greedy = order == "greedy"
    while state.pieces:
        direction = None
        if greedy:
            direction, cost = _least(transition, state)
            greedy = cost < least
            least = min(cost, least)
        if not greedy or direction is None:
            direction = _along_leftmost(transition.shooter, state)
        state = transition(state, direction)
        yield direction, state


def wall_direction(shooter: Shooter, edge: int) -> Direction:
    """Return the direction along an edge."""
    return primitive(*shooter.edges[edge])


def length(shooter: Shooter, state: InformationState) -> float:
    """Return how long all pieces of a state are together, in metres, to nearest."""
    return sum(float(piece.high - piece.low) * _edge_length(shooter, piece.edge) for piece in state.pieces)


def _edge_length(shooter: Shooter, edge: int) -> float:
    ex, ey = shooter.edges[edge]
    return float((float(ex) ** 2 + float(ey) ** 2) ** 0.5)


def _cost(shooter: Shooter, state: InformationState) -> float:
    around = sum(_edge_length(shooter, edge) for edge in range(len(shooter)))
    return length(shooter, state) / around + _PIECE_COST * len(state.pieces)


def _along_leftmost(shooter: Shooter, state: InformationState) -> Direction:
    """Return the direction with x ≥ 0 along the piece that begins leftmost."""
    begins = [(min(shooter.on_edge(each.edge, part).x for part in (each.low, each.high)), each.edge) for each in state.pieces]
    direction = wall_direction(shooter, min(begins)[1])
    return reverse(direction) if direction < (0, 0) else direction


def _least(transition: Transition, state: InformationState) -> tuple[Direction, float]:
    """Return the direction along one of the walls which carry most that leaves least, and what it leaves."""
    shooter = transition.shooter
    carried: dict[Direction, float] = {}
    for piece in state.pieces:
        line = max(wall_direction(shooter, piece.edge), reverse(wall_direction(shooter, piece.edge)))
        carried[line] = carried.get(line, 0.0) + float(piece.high - piece.low) * _edge_length(shooter, piece.edge)
    lines = sorted(carried, key=lambda line: -carried[line])[:_LINES]
    costs = [(_cost(shooter, transition(state, each)), each) for line in lines for each in (line, reverse(line))]
    cost, direction = min(costs)
    return direction, cost
