import math
from fractions import Fraction

import pytest

from ial.errors import ConfigError, ImpossibleError
from ial.maps.polygons.polygon import Polygon
from ial.odometer import Localization, OdometerBounds, OdometerModel, OdometerRobot, Session, localize
from tests.maps.polygons.random_polygons import random_polygon, rectilinear_polygon
from tests.odometer.followed_robot import FollowedRobot
from tests.odometer.worlds import L_SHAPE, S_SHAPE, SERPENTINE, SQUARE, WORLDS, regular, ring, robot


def followed(model: OdometerModel, driven: OdometerRobot, most: int = 100) -> Localization:
    """A localization in which the truth is looked for after each command."""
    watched = FollowedRobot(driven)
    counted = []

    def look(commands: int) -> None:
        counted.append(commands)
        assert watched.is_in(session.states["here"]), (driven, commands)

    session = Session({"here": model}, watched, most, look)
    result = session.run()
    assert counted == list(range(2, len(result.steps) + 1))
    return result


ORDERS = {"pentagon": 5, "S": 2, "square": 4}


@pytest.mark.slow
@pytest.mark.parametrize("name", WORLDS)
def test_the_truth_is_in_the_set_at_every_step_and_one_orbit_is_left(name: str) -> None:
    model = OdometerModel(WORLDS[name])
    for seed in range(7):
        result = followed(model, robot(WORLDS[name], 1000 + seed))
        assert len(result.hypotheses) == ORDERS.get(name, 1) == len(model.symmetries)
        assert result.status == ("symmetric" if name in ORDERS else "localized")


@pytest.mark.slow
def test_the_truth_is_kept_with_errors_as_large_as_allowed() -> None:
    bounds = OdometerBounds(0.01, 0.5)
    narrow = 0
    for seed in range(6):  # a thousand of them are a bench
        polygon = random_polygon(corners=9, seed=seed) if seed % 2 else L_SHAPE
        model = OdometerModel(polygon, bounds)
        result = followed(model, robot(polygon, seed, bounds), 30)
        assert result.status in ("localized", "ambiguous")
        if result.status == "localized":
            assert result.narrowest is not None
            assert result.narrowest.width_m <= result.width_m
            narrow += result.narrowest.width_m < 0.1 * model.walls.size
    assert narrow >= 3


def test_a_pentagon_leaves_exactly_five() -> None:
    result = localize(regular(5), OdometerRobot(regular(5), 0.2, 0.1, 17))
    assert result.status == "symmetric"
    assert len(result.hypotheses) == 5
    assert result.candidates is not None
    assert result.candidates > 5


def test_a_place_that_one_alone_has_tells_equal_rooms_apart() -> None:
    model = OdometerModel(SERPENTINE)
    reasons = {step.reason for seed in range(3) for step in followed(model, robot(SERPENTINE, 11 + 5 * seed)).steps}
    assert "by a place that only one has" in reasons


def test_directions_that_do_not_split_are_not_asked_for_again_and_again() -> None:
    columns = rectilinear_polygon(4, seed=5)  # from its corners, rays along walls are predicted that there are not
    result = localize(columns, OdometerRobot(columns, 19, 100, 90))
    assert result.status == "localized"
    assert len(result.steps) < 15


@pytest.mark.slow
def test_environments_that_differ_in_one_corner_are_told_apart() -> None:
    other = Polygon((*L_SHAPE.outer[:4], (Fraction(2), Fraction(9, 2)), L_SHAPE.outer[5]))
    for seed in range(8):
        for name, polygon in {"one": L_SHAPE, "other": other}.items():
            driven = robot(polygon, seed)
            result = localize({"one": L_SHAPE, "other": other}, driven)
            assert result.status == "localized"
            (left,) = result.hypotheses
            assert left.world == name
            assert math.hypot(left.x - driven.x, left.y - driven.y) < 1e-4


def test_environments_that_are_one_turned_and_moved_are_reported_as_inseparable() -> None:
    turned = Polygon(tuple((7 - y, x + 2) for x, y in L_SHAPE.outer))
    result = localize({"one": L_SHAPE, "turned": turned}, OdometerRobot(L_SHAPE, 1, 1, 25))
    assert result.status == "symmetric"
    assert sorted(each.world for each in result.hypotheses) == ["one", "turned"]


def test_half_a_turn_cannot_be_told() -> None:
    result = localize(S_SHAPE, OdometerRobot(S_SHAPE, 1, 1, 25))
    one, other = result.hypotheses
    assert (one.x + other.x, one.y + other.y) == pytest.approx((6.0, 5.0), abs=1e-5)


def test_a_robot_of_another_map_is_rejected_or_lost() -> None:
    assert localize(L_SHAPE, OdometerRobot(SERPENTINE, 0.5, 0.25, 3)).status == "rejected"


def test_a_robot_without_a_linear_odometer_cannot_be_localized() -> None:
    with pytest.raises(ImpossibleError, match=r"section VI, robot R3.*give it a linear odometer"):
        localize(SQUARE, OdometerRobot(SQUARE, 1, 1, 0), OdometerBounds(math.inf))


def test_what_cannot_be_asked() -> None:
    with pytest.raises(ConfigError, match="no environment to be in"):
        localize({}, OdometerRobot(SQUARE, 1, 1, 0))
    with pytest.raises(ConfigError, match="allow at least 4"):
        localize(SQUARE, OdometerRobot(SQUARE, 1, 1, 0), most_commands=3)
    assert ring((0, 0)) == ((Fraction(0), Fraction(0)),)
