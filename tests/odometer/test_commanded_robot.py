import math
from fractions import Fraction
from itertools import islice

import pytest

from ial.active.robot import Drive
from ial.errors import ConfigError
from ial.odometer import Command, CommandedRobot, OdometerRobot
from ial.odometer.opening_moves import OpeningMoves
from ial.odometer.splitting import turns_deg
from ial.odometer.wall_table import WallTable
from tests.odometer.worlds import SQUARE, WORLDS


def test_its_motion_is_the_command_and_its_reading_how_far_it_came() -> None:
    driving = CommandedRobot(OdometerRobot(SQUARE, 1, 1, 0))
    assert driving.look() == 2.0
    driven = driving.drive(Drive(math.pi, math.inf))
    assert (driven.motion, driven.reading, driven.collided) == (Command(Fraction(180)), 3.0, False)
    driven = driving.drive(Drive(0.5 * math.pi, 0.5))
    assert (driven.motion, driven.reading) == (Command(Fraction(90), 0.5), 0.5)


def test_turns_in_radians_are_exact_degrees_again() -> None:
    for walls in map(WallTable, WORLDS.values()):
        moves = OpeningMoves([walls])
        for command in [*islice(moves.back(), 500), *moves.across(), *map(Command, turns_deg())]:
            assert Command.of(command.drive) == command
    assert Command.of(Command(Fraction(7), 2.5).drive) == Command(Fraction(7), 2.5)


def test_any_other_turn_is_as_near_as_doubles_are() -> None:
    assert float(Command.of(Drive(1.0, 1.0)).turn_deg) == pytest.approx(math.degrees(1.0), abs=1e-9)
    with pytest.raises(ConfigError, match="a turn by nan rad"):
        Command.of(Drive(math.nan, 1.0))
    with pytest.raises(ConfigError, match="no way ahead"):
        Command.of(Drive(1.0, 0.0))
