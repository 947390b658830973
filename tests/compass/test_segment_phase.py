from typing import get_args

import pytest

from ial.compass.segment_phase import Order, SegmentPhase, wall_direction
from ial.compass.state import InformationState
from ial.compass.transition import Transition
from ial.compass.wall_distances import WallDistances
from ial.maps.polygons.exact.shooter import Shooter
from ial.maps.polygons.exact.shortest_path import ShortestPaths
from ial.maps.polygons.exact.visibility import Visibility
from ial.maps.polygons.polygon import Polygon
from tests.maps.polygons.known_polygons import SPIKES, comb
from tests.maps.polygons.random_polygons import random_polygon


def phase(polygon: Polygon, order: Order) -> SegmentPhase:
    shooter = Shooter(polygon)
    return SegmentPhase(Transition(shooter), order, WallDistances(ShortestPaths(Visibility(shooter))))


@pytest.mark.parametrize("order", get_args(Order))
@pytest.mark.parametrize("polygon", [SPIKES, comb(4, irregular=True), random_polygon(20, 3)])
def test_it_ends_with_points_only_and_every_motion_is_along_a_wall(polygon: Polygon, order: Order) -> None:
    planned = phase(polygon, order)
    shooter = planned.transition.shooter
    state = InformationState.boundary(shooter)
    lines = {sign for edge in range(len(shooter)) for x, y in [wall_direction(shooter, edge)] for sign in ((x, y), (-x, -y))}
    for direction, after in planned.run(state):
        assert direction in lines
        assert after == planned.transition(state, direction)
        state = after
    assert not state.pieces
    assert state.points


def test_in_the_papers_order_no_piece_comes_back_to_the_left() -> None:
    planned = phase(random_polygon(20, 4), "paper")
    shooter = planned.transition.shooter
    swept = min(x for x, _ in shooter.corners)
    for (x, _), state in planned.run(InformationState.boundary(shooter)):
        assert x >= 0
        left = [min(shooter.on_edge(each.edge, part).x for part in (each.low, each.high)) for each in state.pieces]
        assert min(left, default=swept) >= swept
        swept = min(left, default=swept)


def test_nothing_is_to_do_without_pieces() -> None:
    planned = phase(SPIKES, "greedy")
    shooter = planned.transition.shooter
    assert list(planned.run(InformationState.of(shooter, [], [shooter.corner(0)]))) == []
