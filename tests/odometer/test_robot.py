import math
from fractions import Fraction

import pytest

from ial.errors import ConfigError
from ial.odometer import Command, OdometerBounds, OdometerRobot
from tests.odometer.worlds import HALL, L_SHAPE, SQUARE


def drives(driven: OdometerRobot, *turns: float) -> list[float]:
    return [driven.execute(Command(Fraction(turn))) for turn in turns]


def test_a_robot_drives_to_the_wall() -> None:
    driven = OdometerRobot(SQUARE, 1, 1, 0)
    assert drives(driven, 0, 180, 90) == [2.0, 3.0, 1.0]
    assert (driven.x, driven.y, driven.heading_deg) == (0.0, 0.0, 270.0)
    assert drives(driven, 0, -90, 180) == [0.0, 0.0, 3.0]


def test_a_robot_slides_along_a_wall_and_leaves_a_reflex_corner() -> None:
    driven = OdometerRobot(L_SHAPE, 2, 4, 270)  # down the wall x = 2, past the corner (2, 2)
    assert drives(driven, 0) == [4.0]
    driven = OdometerRobot(L_SHAPE, 0, 4, -45)  # towards the reflex corner, which it only touches
    assert drives(driven, 0) == [pytest.approx(math.sqrt(32.0))]
    driven = OdometerRobot(L_SHAPE, 2, 2, 45)
    assert drives(driven, 0) == [0.0]


def test_it_stops_where_it_is_told_to() -> None:
    driven = OdometerRobot(SQUARE, 1, 1, 0)
    assert driven.execute(Command(Fraction(90), 0.5)) == 0.5
    assert (driven.x, driven.y) == (1.0, 1.5)
    assert driven.execute(Command(Fraction(0), 5.0)) == 1.5


def test_errors_stay_within_bounds_and_are_used() -> None:
    bounds = OdometerBounds(0.01, 0.5)
    parts = []
    for seed in range(60):
        driven = OdometerRobot(SQUARE, 0, 1, 0, bounds, seed)
        reading = driven.execute(Command(Fraction(0)))
        parts.append(reading / math.hypot(driven.x, driven.y - 1.0) - 1.0)
        assert abs((driven.heading_deg + 180) % 360 - 180) <= 0.5
    assert -0.01 <= min(parts) < -0.0099
    assert 0.0099 < max(parts) <= 0.01


@pytest.mark.parametrize(("x", "y"), [(3, 3), (10, 1), (6.2, 2.5)])
def test_a_start_in_an_obstacle_is_refused(x: float, y: float) -> None:
    with pytest.raises(ConfigError, match="lies outside of the environment; give a point"):
        OdometerRobot(HALL, x, y, 0)


def test_a_start_that_is_not_finite_is_refused() -> None:
    with pytest.raises(ConfigError, match="not finite"):
        OdometerRobot(HALL, math.nan, 1, 0)
