import numpy as np

from ial.odometer import Command, OdometerRobot
from ial.odometer.hypotheses import Hypothesis
from ial.odometer.overlay import way_apart
from tests.odometer.worlds import L_SHAPE, SQUARE, WORLDS, robot


def at(x: float, y: float, heading: float) -> Hypothesis:
    return Hypothesis("", x, y, heading, 0.0, 0.0, np.array([[x, y, heading]]))


def test_robots_that_follow_the_way_read_different_distances() -> None:
    different = 0
    for seed, (name, polygon) in enumerate(WORLDS.items()):
        one, other = robot(polygon, seed), robot(polygon, seed + 50)
        way = way_apart(polygon, at(one.x, one.y, one.heading_rad), polygon, at(other.x, other.y, other.heading_rad))
        assert way, name
        readings = [[driven.execute(command) for command in way] for driven in (one, other)]
        different += readings[0] != readings[1]
    assert different == len(WORLDS)


def test_there_is_none_if_both_are_one() -> None:
    assert way_apart(SQUARE, at(1, 1, 0.0), SQUARE, at(1, 1, 0.0)) == []
    assert way_apart(SQUARE, at(1, 1, 0.0), SQUARE, at(2, 1, 0.5 * np.pi)) == []


def test_a_way_stays_in_the_environment() -> None:
    driven = OdometerRobot(L_SHAPE, 1, 3, 0)
    for command in way_apart(L_SHAPE, at(1, 3, 0.0), L_SHAPE, at(4, 1, 0.0)):
        assert isinstance(command, Command)
        driven.execute(command)
