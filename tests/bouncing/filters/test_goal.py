from fractions import Fraction

import numpy as np
import pytest

from ial.bouncing.cells.headings import Headings
from ial.bouncing.filters.goal import Goal, Room
from ial.bouncing.filters.setting import Setting
from ial.errors import ConfigError

HALF = Fraction(1, 2)
SETTING = Setting(
    ("upstairs", "downstairs"), ((Fraction(0), Fraction(0)), (Fraction(10), Fraction(1, 4))), HALF, Headings.of_angle(Fraction(90))
)
ENVIRONMENT, ROW, COLUMN = (each.ravel() for each in np.meshgrid([0, 1], range(6), range(8), indexing="ij"))


def room(name: str, x0: float, y0: float, x1: float, y1: float, environment: str = "") -> Room:
    return Room(name, Fraction(x0), Fraction(y0), Fraction(x1), Fraction(y1), environment)


def places(environment: int, rows: list[int], columns: list[int]) -> np.ndarray:
    return np.flatnonzero((environment == ENVIRONMENT) & np.isin(ROW, rows) & np.isin(COLUMN, columns))


def test_a_robot_is_localized_in_a_room_that_holds_all_its_cells() -> None:
    goal = Goal((room("kitchen", 0, 0, 2, 1.5), room("bath", 2, 0, 4, 3, "upstairs"), room("cellar", 10, 0.25, 11.9, 3, "downstairs")))
    judge = goal.judge(SETTING, ENVIRONMENT, ROW, COLUMN)
    assert goal.colours == 3
    assert judge(places(0, [0, 1, 2], [0, 1, 2, 3])) == 2, "the border belongs to the room"
    assert judge(places(0, [0, 3], [0])) == 1, "one cell is above"
    assert judge(places(0, [5], [4, 7])) == 3
    assert judge(places(0, [0], [3, 4])) == 1, "in two rooms"
    assert judge(places(1, [5], [4])) == 1, "a room of the other environment"
    assert judge(places(1, [0, 4], [0, 2])) == 4
    assert judge(places(1, [0], [3])) == 1, "a cell that sticks out by 0.1 m"
    assert Goal.of_record(goal.record()) == goal


def test_a_robot_is_localized_in_a_square() -> None:
    goal = Goal(width=Fraction(9, 8))
    judge = goal.judge(SETTING, ENVIRONMENT, ROW, COLUMN)
    assert goal.colours == 1
    assert judge(places(0, [2, 3], [6, 7])) == 2
    assert judge(places(0, [2, 4], [6])) == 1, "three cells are 1.5 m"
    assert judge(places(0, [2], [5, 6, 7])) == 1
    assert judge(np.concatenate([places(0, [2], [5]), places(1, [2], [5])])) == 1, "in two environments"
    assert Goal.of_record(goal.record()) == goal


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Goal(), "either of the two"),
        (lambda: Goal((room("a", 0, 0, 1, 1),), Fraction(1)), "either of the two"),
        (lambda: Goal(width=Fraction(0)), "within 0 m"),
        (lambda: Goal((room("a", 0, 0, 1, 1), room("a", 1, 0, 2, 1))), "the same name"),
        (lambda: room("", 0, 0, 1, 1), "no name or no area"),
        (lambda: room("a", 0, 0, 1, 0), "no name or no area"),
        (lambda: Goal((room("a", 0.1, 0, 0.9, 1),)).judge(SETTING, ENVIRONMENT, ROW, COLUMN), "holds no cell"),
        (lambda: Goal((room("a", 0, 0, 1, 1, "attic"),)).judge(SETTING, ENVIRONMENT, ROW, COLUMN), "give one of upstairs, downstairs"),
    ],
)
def test_what_cannot_be_meant_is_refused(make: object, message: str) -> None:
    with pytest.raises(ConfigError, match=message):
        make()  # type: ignore[operator]
