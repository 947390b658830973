from fractions import Fraction
from itertools import pairwise
from typing import get_args

import pytest

from ial.compass.chase import Chase
from ial.compass.point_phase import PointPhase
from ial.compass.primitive import Direction
from ial.compass.segment_phase import Order
from ial.compass.state import InformationState
from ial.compass.transition import Transition
from ial.compass.verifier import follow
from ial.compass.wall_distances import WallDistances
from ial.maps.polygons.exact.rational import rational
from ial.maps.polygons.exact.shooter import Shooter
from ial.maps.polygons.exact.shortest_path import ShortestPaths
from ial.maps.polygons.exact.visibility import Visibility
from ial.maps.polygons.polygon import Polygon
from tests.maps.polygons.known_polygons import SQUARE, Z_SHAPE, serpentine
from tests.maps.polygons.random_polygons import random_polygon


def phase(polygon: Polygon, order: Order) -> tuple[PointPhase, ShortestPaths]:
    shooter = Shooter(polygon)
    paths = ShortestPaths(Visibility(shooter))
    return PointPhase(Transition(shooter), order, paths, WallDistances(paths)), paths


def merged(polygon: Polygon, order: Order, parts: dict[int, str]) -> list[Direction]:
    """Merge points at parts of edges, and follow each of them."""
    planned, _ = phase(polygon, order)
    shooter = planned.transition.shooter
    state = InformationState.of(shooter, [], [shooter.on_edge(edge, rational(Fraction(part))) for edge, part in parts.items()])
    steps = list(planned.run(state))
    directions = [direction for direction, _ in steps]
    ends = {follow(polygon, (Fraction(str(each.x)), Fraction(str(each.y))), directions)[-1] for each in state.points}
    assert ends == {tuple(Fraction(str(each)) for each in steps[-1][1].single or ())}
    return directions


@pytest.mark.parametrize("order", get_args(Order))
@pytest.mark.parametrize("polygon", [SQUARE, Z_SHAPE, serpentine(4), random_polygon(20, 5)])
def test_points_anywhere_become_one(polygon: Polygon, order: Order) -> None:
    count = len(polygon.outer)
    merged(polygon, order, {edge: ["1/3", "0", "4/7"][edge % 3] for edge in range(0, count, 1 + count // 6)})


def test_two_points_on_a_wall_are_merged_along_it() -> None:
    planned, _ = phase(SQUARE, "paper")
    shooter = planned.transition.shooter
    state = InformationState.of(shooter, [], [shooter.on_edge(0, rational(part) / 5) for part in (1, 2)])
    ((direction, _),) = planned.run(state)
    assert direction in ((1, 0), (-1, 0))


def test_one_point_is_merged_already() -> None:
    planned, _ = phase(SQUARE, "greedy")
    assert list(planned.run(InformationState.of(planned.transition.shooter, [], [planned.transition.shooter.corner(2)]))) == []


@pytest.mark.parametrize("order", get_args(Order))
def test_two_points_at_the_ends_of_a_bitangent_do_not_go_to_and_fro(order: Order) -> None:
    """Where the line over both inner corners of the Z ends, each point sees the other end of the bitangent; figure 3.6 of the thesis."""
    planned, paths = phase(Z_SHAPE, order)
    transition, shooter = planned.transition, planned.transition.shooter
    ((one, other),) = paths.visibility.bitangents()
    ahead = tuple(a - b for a, b in zip(shooter.corners[other], shooter.corners[one], strict=True))
    ends = [shooter.shoot(shooter.corners[one], (sign * ahead[0], sign * ahead[1])) for sign in (1, -1)]
    shifted = transition.points(ends, [(1, 0), (-1, 0), (0, 1), (0, -1)])
    tried = 0
    for points in {pair for pair in shifted if not paths.visibility.sees(pair[0].place, pair[1].place)}:
        steps = list(planned.run(InformationState.of(shooter, [], points)))
        assert steps[-1][1].single is not None
        directions = [direction for direction, _ in steps]
        assert not any((-x, -y) == after for (x, y), after in pairwise(directions[:-1]))
        tried += 1
    assert tried > 0


def test_a_chase_tilts_where_the_straight_way_leads_to_and_fro() -> None:
    """From both ends of the bitangent's line the straight way is along it; the search must leave the line."""
    planned, paths = phase(Z_SHAPE, "paper")
    shooter = planned.transition.shooter
    state = InformationState.of(shooter, [], [shooter.corner(0), shooter.corner(4)])
    found = Chase(planned.transition, paths, False).search(state, [(0, 1)])
    assert found is not None
    points = state.points
    for direction in found:
        (points,) = planned.transition.points(points, [direction])
    assert points[0].place == points[1].place
