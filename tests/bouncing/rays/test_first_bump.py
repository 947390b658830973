import random
from fractions import Fraction

import numpy as np
import pytest

from ial.bouncing.rays.first_bump import FirstBumps
from ial.bouncing.rays.legs import Legs
from ial.bouncing.rays.piece_map import PieceMap
from ial.bouncing.rays.piece_model import PieceModel
from ial.bouncing.rays.real_robot import RealRobot
from ial.bouncing.start import ANYWHERE, Start
from ial.errors import ConfigError
from tests.bouncing.disk_truth import NONE, SOME, TEN_WORLDS, pieces_of

ANGLE, STEP = Fraction(100), Fraction(1, 4)


def some_start(robot: RealRobot, chooser: random.Random) -> Start:
    """A region and headings with the start of a robot somewhere on or inside of their borders."""
    x, y, turn = robot.pose
    left, below, right, above = (Fraction(chooser.choice([0, 0, 30, 100]), 100) for _ in range(4))
    behind, before = (Fraction(chooser.choice([0, 10, 40])) for _ in range(2))
    return Start((x - left, y - below, x + right, y + above), ((360 * turn - behind, 360 * turn + before),))


@pytest.mark.slow
@pytest.mark.parametrize("world", ["hall", "pillars", "polygon 4", "polygon 7"])
def test_a_robot_of_which_something_is_known_is_never_lost_and_known_earlier(world: str) -> None:
    chooser, shares = random.Random(1), []
    for radius, bounds in ((Fraction(0), NONE), (Fraction(0), SOME), (Fraction(3, 10), SOME)):
        made = PieceMap.of(TEN_WORLDS[world], ANGLE, STEP, bounds, Fraction(1, 2), 36, radius)
        legs = Legs(made.walls, ANGLE, STEP, bounds)
        for seed in range(10):
            robot = RealRobot(TEN_WORLDS[world], ANGLE, STEP, radius, bounds, seed)
            model = PieceModel(made, FirstBumps.of(made, legs, some_start(robot, chooser)))
            states = model.universe()
            for leg in range(6):
                for pose in robot.leg():
                    states = model.step(states, None, pose.observation)
                assert pieces_of(made, *robot.pose) & set(states.pieces.tolist())
                if not leg:
                    shares.append(len(states) / len(made))
    assert np.median(shares) < 0.02


def test_of_a_start_anywhere_no_more_is_known_than_its_first_leg() -> None:
    """What the first leg tells, the model without a start leaves out."""
    made = PieceMap.of(TEN_WORLDS["hall"], ANGLE, STEP, NONE, Fraction(1, 2), 36)
    first = FirstBumps.of(made, Legs(made.walls, ANGLE, STEP, NONE), ANYWHERE)
    assert 0.5 * len(made) < len(first) < 0.7 * len(made), "it has come from the free side of the wall, and turned by 100°"
    assert (first.least == 0).all()
    with_it, without = PieceModel(made, first), PieceModel(made)
    short, long = (with_it.leg(with_it.universe(), steps) for steps in (3, 30))
    assert len(long) < len(short) == len(first)
    assert len(without.leg(without.universe(), 30)) == len(made)


def test_a_start_where_no_robot_can_be_is_refused() -> None:
    made = PieceMap.of(TEN_WORLDS["hall"], ANGLE, STEP, NONE, Fraction(1, 2), 36)
    legs = Legs(made.walls, ANGLE, STEP, NONE)
    with pytest.raises(ConfigError, match="can have started nowhere"):
        FirstBumps.of(made, legs, Start((Fraction(50), Fraction(50), Fraction(51), Fraction(51))))


def test_steps_without_a_bump_end_a_start_that_cannot_last_so_long() -> None:
    made = PieceMap.of(TEN_WORLDS["hall"], ANGLE, STEP, NONE, Fraction(1, 2), 36)
    near = Start((Fraction(1), Fraction(1), Fraction(1), Fraction(1)), ((Fraction(180), Fraction(180)),))
    model = PieceModel(made, FirstBumps.of(made, Legs(made.walls, ANGLE, STEP, NONE), near))
    states = model.universe()
    for _ in range(5):
        states = model.step(states, None, 0)
    assert model.empty(states), "the wall is 1 m away: 4 steps"
