from fractions import Fraction
from itertools import islice

import numpy as np
import pytest

from ial.bouncing.cells.cell_robot import CellRobot
from ial.errors import ConfigError
from tests.bouncing.worlds import cell_map, drawn, random_mask, twin_next


@pytest.mark.parametrize("seed", range(6))
def test_it_steps_as_the_definition_says(seed: int) -> None:
    made = cell_map(random_mask(seed), 45, 8)
    robot = CellRobot(made, seed)
    row, column, heading = (int(each) for each in made.configurations(robot.vertex))
    for pose in islice(robot.run(), 60):
        row, column, heading, bump = twin_next(made, row, column, heading)
        assert pose.observation == bump
        assert (pose.x_m, pose.y_m) == made.centre(row, column)
        assert pose.turn == Fraction(heading, 8)


def test_every_configuration_can_be_its_start() -> None:
    made = cell_map(drawn(".. .."))
    assert {CellRobot(made, seed).vertex for seed in range(200)} == set(range(len(made.graph)))


def test_it_starts_in_the_cell_that_holds_the_place() -> None:
    made = cell_map(np.array([[True, False], [True, True]]))
    robot = CellRobot(made, start=(Fraction(3, 2), Fraction(19, 10), Fraction(3, 4)))
    assert robot.vertex == made.vertex(1, 1, 3)
    assert repr(robot) == "<CellRobot in row 1, column 1, heading 270°>"
    assert CellRobot(made, start=(Fraction(0), Fraction(0), Fraction(-1, 4))).vertex == made.vertex(0, 0, 3)


def test_a_start_that_cannot_be_is_refused() -> None:
    made = cell_map(np.array([[True, False], [True, True]]))
    for x in (Fraction(3, 2), Fraction(5)):
        with pytest.raises(ConfigError, match="give a place in a free cell"):
            CellRobot(made, start=(x, Fraction(1, 2), Fraction(0)))
    with pytest.raises(ConfigError, match="multiples of 90°"):
        CellRobot(made, start=(Fraction(0), Fraction(0), Fraction(1, 8)))
