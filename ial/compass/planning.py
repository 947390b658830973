"""`localizing_sequence`: the plan of a robot that has a compass and a contact sensor."""

from collections.abc import Callable

from ial.compass.point_phase import PointPhase
from ial.compass.primitive import Direction
from ial.compass.segment_phase import Order, SegmentPhase
from ial.compass.sequence import Sequence
from ial.compass.state import InformationState
from ial.compass.transition import Transition
from ial.compass.wall_distances import WallDistances
from ial.errors import SequenceError
from ial.maps.polygons.exact.rational import fraction
from ial.maps.polygons.exact.shooter import Shooter
from ial.maps.polygons.exact.shortest_path import ShortestPaths
from ial.maps.polygons.exact.visibility import Visibility
from ial.maps.polygons.polygon import Polygon


def localizing_sequence(
    polygon: Polygon, order: Order = "greedy", progress: Callable[[int, tuple[int, int]], None] | None = None
) -> Sequence:
    """Plan motions after which a robot is in one place, wherever in the polygon it starts.

    O'Kane, Localization with limited sensing (2005), algorithm 3.2, and O'Kane and LaValle (2007), section III: first along walls, until
    finitely many points are left, then these are brought together. Every information state is computed exactly, and each motion is found by
    some search; so the sequence is certified, and not the way in which it was found.

    Parameters
    ----------
    polygon
        The environment. The theorem that there is a sequence is about polygons without holes; with holes one is looked for all the same.
    order
        Which walls and points come first.
    progress
        Called after each motion with the number of motions so far and the sizes of the information state.

    Raises
    ------
    SequenceError
        If none is found. That is no proof that there is none.
    MapError
        If a wall has a direction of more than 64 bits.
    """
    shooter = Shooter(polygon)
    transition = Transition(shooter)
    paths = ShortestPaths(Visibility(shooter))
    distances = WallDistances(paths)
    state = InformationState.boundary(shooter)
    directions: list[Direction] = []
    sizes = [state.sizes]
    for phase in (SegmentPhase(transition, order, distances), PointPhase(transition, order, paths, distances)):
        for direction, after in phase.run(state):
            state = after
            directions.append(direction)
            sizes.append(state.sizes)
            if progress is not None:
                progress(len(directions), state.sizes)
    if state.single is None:
        raise SequenceError("none found: more than one place is left; this is no proof that there is no sequence")
    x, y = state.single
    return Sequence(polygon, tuple(directions), tuple(sizes), (fraction(x), fraction(y)))
