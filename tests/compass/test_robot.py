from fractions import Fraction

import pytest

from ial.compass.planning import localizing_sequence
from ial.compass.robot import CompassRobot
from ial.compass.verifier import follow
from ial.errors import ConfigError, MapError
from tests.maps.polygons.known_polygons import HOLED, SPIKES


def test_it_drives_as_the_verifier_follows() -> None:
    sequence = localizing_sequence(SPIKES)
    for start in [(Fraction(5), Fraction(1)), SPIKES.outer[4], (Fraction(0), Fraction(0))]:
        robot = CompassRobot(SPIKES, start)
        places = [robot.place, *(robot.drive(*direction) for direction in sequence.directions)]
        assert places == follow(SPIKES, start, sequence.directions)
        assert robot.place == sequence.end
    assert repr(robot).startswith("<CompassRobot at (")


@pytest.mark.parametrize("start", [(-1, 3), (Fraction(5, 2), 3), (6, 5)])
def test_a_start_outside_or_in_a_hole_is_refused(start: tuple[int, int]) -> None:
    with pytest.raises(MapError, match="lies outside of the environment; give a place inside or on a wall"):
        CompassRobot(HOLED, start)


@pytest.mark.parametrize("start", [(2, 3), (0, 0), (Fraction(9, 2), 0), (1, 1)])
def test_a_start_inside_or_on_a_wall_is_fine(start: tuple[int, int]) -> None:
    assert CompassRobot(HOLED, start).place == start


def test_floats_are_refused() -> None:
    with pytest.raises(ConfigError, match="give whole numbers or fractions"):
        CompassRobot(HOLED, (1, 1)).drive(0.6, 0.8)
