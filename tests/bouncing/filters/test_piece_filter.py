from collections import Counter
from fractions import Fraction

import numpy as np
import pytest

from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.filters.goal import Goal, Room
from ial.bouncing.filters.piece_filter import PieceFilter
from ial.bouncing.rays.piece_map import PieceMap
from ial.bouncing.rays.piece_model import PieceModel, PieceSet
from ial.bouncing.rays.real_robot import RealRobot
from tests.bouncing import disk_truth
from tests.bouncing.judged_runs import WORLDS
from tests.bouncing.rays.test_real_robot import ROOM

ANGLE, STEP = Fraction(100), Fraction(1, 4)
SOME = ExecutionBounds(Fraction(2), Fraction(1, 50), 1)
ROOMS = Goal((Room("left", *map(Fraction, (-1, -1, 5, 8))), Room("right", *map(Fraction, (5, -1, 10, 5)), "hall")))


def on(made: PieceMap, *parts: int) -> PieceSet:
    """A robot that left from some parts of walls, in two headings."""
    pieces = np.array([heading * int(made.parts.sum()) + part for heading in (3, 20) for part in parts], dtype=np.int32)
    return PieceSet(pieces, np.zeros(len(pieces), dtype=np.int32))


def test_a_robot_is_localized_where_all_its_pieces_are() -> None:
    made = PieceMap.of(ROOM, ANGLE, STEP, SOME, Fraction(1), 36)  # parts: 4 below, 3 at the right, 4 above, 3 at the left
    rooms = Goal((Room("below", *map(Fraction, (-1, -1, 5, 1))), Room("elsewhere", *map(Fraction, (-1, -1, 5, 4)), "attic")))
    told = PieceFilter(made, "room", ANGLE, STEP, SOME, rooms)
    assert told.room(on(made, 0, 3)) == "below"
    assert told.is_localized(on(made, 0, 3))
    assert told.room(on(made, 0, 4)) is None, "the lowest part at the right reaches to 1.001 m"
    assert not told.is_localized(on(made, 0, 8))
    assert told.box(on(made, 1, 2)) == pytest.approx((0.999, 0.0, 3.001, 0.001))
    near = PieceFilter(made, "room", ANGLE, STEP, SOME, Goal(width=Fraction(21, 10)))
    assert near.is_localized(on(made, 1, 2))
    assert near.room(on(made, 1, 2)) is None
    assert not near.is_localized(on(made, 1, 3))
    nothing = PieceSet(np.empty(0, dtype=np.int32), np.empty(0, dtype=np.int32))
    for states in (PieceModel(made).universe(), nothing):
        assert (told.box(states), told.room(states), told.is_localized(states)) == (None, None, False)


@pytest.mark.slow
def test_a_robot_with_errors_is_never_told_to_be_in_another_room() -> None:
    made = PieceMap.of(WORLDS["hall"], ANGLE, STEP, SOME, Fraction(1, 4), 72)
    told, model = PieceFilter(made, "hall", ANGLE, STEP, SOME, ROOMS), PieceModel(made)
    localized = {"left": 0, "right": 0}
    for seed in range(40):
        robot, states = RealRobot(WORLDS["hall"], ANGLE, STEP, bounds=SOME, seed=seed), model.universe()
        for _ in range(20):
            states = model.leg(states, len(list(robot.leg())) - 1)
            x0, y0, x1, y1 = told.box(states) or (0.0, 0.0, 0.0, 0.0)
            x, y, _ = robot.pose
            assert x0 <= x <= x1
            assert y0 <= y <= y1
            name = told.room(states)
            if name is not None:
                assert (x <= 5) if name == "left" else (x >= 5)
                localized[name] += 1
    assert min(localized.values()) > 50


@pytest.mark.slow
@pytest.mark.parametrize(("world", "radius"), [("hall", Fraction(1, 2)), ("pillars", Fraction(2, 5)), ("polygon 7", Fraction(1, 5))])
def test_a_disk_with_errors_is_localized_and_never_told_to_be_elsewhere(world: str, radius: Fraction) -> None:
    made = disk_truth.filter_of(world, radius)
    outcomes = Counter(disk_truth.judge(made, seed) for seed in range(25))
    assert set(outcomes) <= {"localized", "not localized"}
    assert outcomes["localized"] >= 10
