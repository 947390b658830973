"""Robots whose compass errs as much as it may, carried out exactly."""

import math
import random
from fractions import Fraction

import pytest

from ial.compass.bounded_model import BoundedCompassModel
from ial.compass.bounded_state import BoundedState
from ial.compass.primitive import Direction, primitive
from ial.errors import ConfigError
from ial.maps.polygons.exact.rational import fraction
from ial.maps.polygons.exact.shooter import BoundaryPoint, Shooter
from ial.maps.polygons.polygon import Polygon
from ial.membership import SetMembershipFilter
from tests.maps.polygons.known_polygons import HOLED, L_SHAPE, SPIKES, SQUARE, TOUCHING, comb
from tests.maps.polygons.random_polygons import random_polygon

CORNERED: list[Direction] = [(1, 1), (33, -1), (-1, 33)]  # into the upper right corner of the square, never at a small angle into a wall


def erring(direction: Direction, error_deg: float, part: Fraction) -> Direction:
    """Return a direction turned by a part, from −1 to 1, of nearly the bound: by a rational point of the circle."""
    tangent = part * Fraction(math.tan(math.radians(error_deg) / 2)) * (1 - Fraction(1, 10**9))
    x, y, c, s = *direction, 1 - tangent**2, 2 * tangent
    return primitive(x * c - y * s, x * s + y * c)


def holds(shooter: Shooter, state: BoundedState, point: BoundaryPoint) -> bool:
    if point.corner:
        return state.holds(point.edge, 0.0) or state.holds(shooter.before[point.edge], 1.0)
    return state.holds(point.edge, fraction(shooter.part(point, point.edge)))


@pytest.mark.slow
@pytest.mark.parametrize("error_deg", [0.01, 1.0, 5.0])
@pytest.mark.parametrize("polygon", [SQUARE, L_SHAPE, SPIKES, HOLED, TOUCHING, comb(3), random_polygon(12, 1, 100)])
def test_the_truth_is_always_inside(polygon: Polygon, error_deg: float) -> None:
    chooser = random.Random(4)
    shooter = Shooter(polygon)
    robot = SetMembershipFilter(BoundedCompassModel(polygon, error_deg))
    truths = [shooter.on_edge(chooser.randrange(len(shooter)), Fraction(chooser.randrange(8), 8)) for _ in range(25)]  # type: ignore[arg-type]
    smallest = 1.0
    for step in range(6):
        wall = primitive(*chooser.choice(shooter.edges))
        direction = [wall, (-wall[0], -wall[1]), (chooser.randrange(-9, 10), chooser.choice((-5, 4)))][step % 3]
        assert robot.update(direction, None) is None
        parts = [Fraction(chooser.choice((-8, 8, 0, chooser.randrange(-8, 9))), 8) for _ in truths]
        truths = [shooter.shoot(truth.place, erring(direction, error_deg, part)) for truth, part in zip(truths, parts, strict=True)]
        assert all(holds(shooter, robot.states, truth) for truth in truths)
        smallest = min(smallest, sum(high - low for _, low, high in robot.states.spans) / len(shooter))
    assert smallest < 0.8  # it says something


def test_a_robot_is_localized_as_well_as_its_compass_allows() -> None:
    model = BoundedCompassModel(SQUARE, 0.5)
    state = model.universe()
    for direction in CORNERED:
        state = model.predict(state, direction)
    angle = math.atan2(1, 33) + math.radians(0.5)
    assert 4 * math.tan(angle) <= model.diameter_m(state) <= 4 * math.tan(angle) + 0.03
    assert model.is_localized(state, 0.2)
    assert not model.is_localized(state, 0.15)


def test_a_motion_along_a_wall_collapses_nothing() -> None:
    model = BoundedCompassModel(SQUARE, 0.5)
    after = model.predict(BoundedState.of([(0, 0.0, 1.0)]), (1, 0))
    assert after.holds(0, 0.5)
    assert after.holds(1, 0.0)
    assert not after.holds(2, 0.5)


def test_sets_as_every_model_has_them() -> None:
    model = BoundedCompassModel(L_SHAPE, 1.0)
    everything = model.universe()
    after = model.step(everything, (1, 2), None)
    assert after == model.predict(everything, (1, 2))
    assert model.unite(everything, after) == everything
    assert model.empty(BoundedState(()))
    assert not model.empty(after)
    assert repr(model) == "BoundedCompassModel(<Polygon: 6 corners, 0 holes>, 1)"


@pytest.mark.parametrize("error_deg", [0.0, -1.0, 10.5, float("nan")])
def test_bounds_out_of_range_are_refused(error_deg: float) -> None:
    with pytest.raises(ConfigError, match="give a bound above 0 and of at most 10°"):
        BoundedCompassModel(SQUARE, error_deg)


def test_floats_are_refused() -> None:
    with pytest.raises(ConfigError, match="give whole numbers or fractions"):
        BoundedCompassModel(SQUARE, 1.0).predict(BoundedState(()), (0.5, 1))  # type: ignore[arg-type]
