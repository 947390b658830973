"""Transitions against the verifier's, which cuts pieces at every level and rays at every wall."""

import random

import pytest

from ial.compass.primitive import primitive, reverse
from ial.compass.state import InformationState
from ial.compass.transition import Transition
from ial.compass.verifier import image, whole_walls
from ial.maps.polygons.exact.rational import rational
from ial.maps.polygons.exact.shooter import Shooter
from ial.maps.polygons.polygon import Polygon
from tests.compass.twin import places_of
from tests.maps.polygons.known_polygons import HOLED, L_SHAPE, SPIKES, SQUARE, STRAIGHT_CORNERS, TOUCHING, Z_SHAPE, comb, serpentine
from tests.maps.polygons.random_polygons import random_polygon, rectilinear_polygon

POLYGONS = [SQUARE, L_SHAPE, SPIKES, STRAIGHT_CORNERS, Z_SHAPE, HOLED, TOUCHING, comb(3), serpentine(3)]
POLYGONS += [random_polygon(9, 1, 20), random_polygon(16, 2, 50), random_polygon(24, 3), rectilinear_polygon(4, 1)]


@pytest.mark.parametrize("polygon", POLYGONS)
def test_every_place_that_can_be_reached_and_no_other(polygon: Polygon) -> None:
    chooser = random.Random(3)
    shooter = Shooter(polygon)
    transition = Transition(shooter)
    walls, _ = whole_walls(polygon)
    shrunk = 0
    for _ in range(3):
        state = InformationState.boundary(shooter)
        for _ in range(5):
            along = primitive(*chooser.choice(shooter.edges))
            one, other = (chooser.choice(shooter.corners) for _ in range(2))
            any_way = (chooser.randrange(1, 99), chooser.randrange(-99, 99))
            through = any_way if one == other else primitive(other[0] - one[0], other[1] - one[1])
            direction = chooser.choice([along, reverse(along), any_way, through])
            after = transition(state, direction)
            assert places_of(polygon, after) == image(walls, places_of(polygon, state), direction)
            shrunk += sum(after.sizes) < sum(state.sizes)
            state = after
    assert shrunk > 0


def test_corners_that_are_passed_are_places_of_their_own() -> None:
    """The critical points: straight up from below the inner corner of the L."""
    shooter = Shooter(L_SHAPE)
    state = Transition(shooter)(InformationState.boundary(shooter), (0, 1))
    assert (2, 2) not in {point.place for point in state.points}  # the closed ray passes it, along the wall
    assert {point.place for point in state.points} == {(0, 4), (2, 4), (4, 2)}
    tilted = Transition(shooter)(InformationState.boundary(shooter), (1, 9))
    assert (4, 2) in {point.place for point in tilted.points}


def test_points_of_several_directions_at_once() -> None:
    shooter = Shooter(SPIKES)
    transition = Transition(shooter)
    points = [shooter.on_edge(edge, rational(edge % 3) / 3) for edge in range(len(shooter))]
    directions = [(1, 0), (-3, 7), (0, -1)]
    images = transition.points(points, directions)
    assert images == [tuple(shooter.shoot(point.place, direction) for point in points) for direction in directions]
    assert transition.points([], directions) == [(), (), ()]


def test_strips_are_kept_for_directions_that_come_again() -> None:
    transition = Transition(Shooter(SQUARE))
    assert transition.strips((1, 2)) is transition.strips((1, 2))
