import random
from collections.abc import Iterator
from fractions import Fraction
from itertools import islice

import numpy as np
import pytest

from ial.bouncing.cells.headings import Headings
from ial.bouncing.cells.noisy_map import NoisyMap
from ial.bouncing.cells.noisy_model import NoisyModel
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.filters.goal import Goal, Room
from ial.bouncing.filters.robust_building import build_robust_filter
from ial.bouncing.filters.robust_filter import RobustFilter
from ial.bouncing.rays.real_robot import RealPose, RealRobot
from ial.errors import FilterError, MapError
from tests.bouncing.judged_runs import ARMS, WORLDS, holds

HALF = Fraction(1, 2)
RADIUS, ANGLE, STEP = Fraction(2, 5), Fraction(90), Fraction(2)
ERRORS = ExecutionBounds(Fraction(1), Fraction(1, 100))


def built(goal: Goal, bounds: ExecutionBounds = ERRORS, radius: Fraction = RADIUS, most: int = 4000) -> RobustFilter:
    return build_robust_filter({"arms": ARMS}, Headings.of_angle(ANGLE, 24, STEP / HALF), HALF, goal, bounds, radius, most)


def observed(bounds: ExecutionBounds, seed: int) -> Iterator[RealPose]:
    """What a disk robot does in 80 steps."""
    return islice(RealRobot(ARMS, ANGLE, STEP, RADIUS, bounds, seed).run(), 80)


@pytest.fixture(scope="module")
def square() -> RobustFilter:
    return built(Goal(width=Fraction(4)))


@pytest.mark.slow
def test_a_disk_with_errors_is_never_told_to_be_where_it_is_not(square: RobustFilter) -> None:
    localized, table = 0, square.table
    for seed in range(150):
        state = 0
        for pose in observed(ERRORS, seed):
            state = table.step(state, pose.observation)
            assert state != table.trap
            if table.is_localized(state):
                assert any(holds(square, place, pose) for place in square.where(state))
                localized += 1
    assert localized > 20


def test_a_way_that_is_too_long_is_rejected(square: RobustFilter) -> None:
    """Both corridors together are shorter than seven steps."""
    assert square.table.trap not in square.table.run([0, 0, 0, 0])
    assert square.table.run([0] * 7)[-1] == square.table.trap


def test_a_room_is_told_by_its_name() -> None:
    end = Goal((Room("start", Fraction(0), Fraction(0), Fraction(3), Fraction(1)), Room("rest", *map(Fraction, (3, 0, 10, 3)))))
    made = built(end)
    told = set()
    for state in range(len(made.table)):
        name = made.room(state)
        assert (name is None) == (not made.table.is_localized(state)) == (not made.where(state))
        assert all((place.x_m < 3) == (name == "start") for place in made.where(state))
        told.add(name)
    assert told == {None, "start", "rest"}
    assert made.room(made.table.trap) is None


@pytest.mark.slow
def test_fewer_states_tell_no_more_than_the_sets_they_stand_for(square: RobustFilter) -> None:
    few = built(Goal(width=Fraction(4)), most=300)
    assert len(few.table) <= 301 < len(square.table)
    assert few.growth > square.growth
    model = NoisyModel(NoisyMap(ARMS, HALF, few.setting.headings, ERRORS, RADIUS).graph)
    chooser, told = random.Random(1), 0
    for _ in range(300):
        states, held = [0, 0], model.universe()
        for _ in range(20):
            bump = int(chooser.random() < 0.4)
            held = model.step(held, None, bump)
            if model.empty(held):
                break
            states = [each.table.step(state, bump) for each, state in zip((few, square), states, strict=True)]
            for each, state in zip((few, square), states, strict=True):
                assert state != each.table.trap
                assert each.table.uncertainty[state] >= len(held)
                if each.table.is_localized(state):
                    assert np.isin(held, each.places.of_state(state)).all()
                    told += 1
    assert told > 50


def test_a_robot_in_one_of_several_environments() -> None:
    headings = Headings.of_angle(Fraction(90), 12, Fraction(4))
    worlds = {name: WORLDS[name] for name in ("L", "corridors")}
    made = build_robust_filter(worlds, headings, HALF, Goal(width=Fraction(8)), ExecutionBounds(), Fraction(1, 4), 3000)
    table = made.table
    assert table.possible(0) == [0, 1]
    assert {tuple(table.possible(state)) for state in range(len(table) - 1)} > {(0, 1)}
    for seed, (name, environment) in enumerate(worlds.items()):
        robot, state = RealRobot(environment, Fraction(90), Fraction(2), Fraction(1, 4), seed=seed), 0
        for pose in islice(robot.run(), 40):
            state = table.step(state, pose.observation)
            assert list(worlds).index(name) in table.possible(state)
    states = np.flatnonzero(table.colours[:-1] == 2).tolist()
    assert all(made.where(state) for state in states)
    assert not made.where(0)


def test_what_cannot_be_built_is_refused() -> None:
    with pytest.raises(FilterError, match="never localizes this robot; allow more states"):
        built(Goal(width=HALF), ExecutionBounds(Fraction(90), HALF), most=200)
    with pytest.raises(MapError, match="radius 6 m fits nowhere"):
        built(Goal(width=HALF), radius=Fraction(6))
