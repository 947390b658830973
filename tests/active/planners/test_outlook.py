import numpy as np
import pytest

from ial.active.belief import Belief, Groups
from ial.active.planners.outlook import Outlook
from ial.active.virtual_sensors import VirtualSensors
from ial.contractors.boxes import Boxes
from ial.pose import Pose
from tests.active.closed_plans import cells_plan
from tests.active.scenes import belief, robot

GRID = cells_plan()
FIRST, SECOND, THIRD = Pose(1.2, 3.4, 0.3), Pose(7.0, 3.4, 0.3), Pose(12.8, 3.4, 0.3)
POINTS = [(2.2, 3.4), (2.6, 1.4), (1.2, 1.0)]  # in the first room
OUTLOOK = Outlook(VirtualSensors(GRID), 0.2)


@pytest.fixture(scope="module")
def known() -> Belief:
    made = belief(GRID)
    made.update(None, robot(GRID, FIRST).look())
    return made


def groups(poses: list[Pose], component: list[int]) -> Groups:
    at = np.array([(each.x, each.y, each.theta) for each in poses])
    return Groups(at, Boxes.around(at, [0.01] * 3), np.array(component))


def test_places_that_look_the_same_are_told_apart_from_nowhere(known: Belief) -> None:
    assert OUTLOOK.worth(known, groups([FIRST, SECOND], [0, 1]), FIRST, POINTS).tolist() == [0.0, 0.0, 0.0]


def test_a_pillar_more_is_seen(known: Belief) -> None:
    two = OUTLOOK.worth(known, groups([FIRST, THIRD], [0, 1]), FIRST, POINTS)
    assert two[1] == two[2] == 1.0
    three = OUTLOOK.worth(known, groups([FIRST, SECOND, THIRD], [0, 1, 2]), FIRST, POINTS)
    assert three.tolist() == (2.0 * two).tolist()
    assert OUTLOOK.worth(known, groups([FIRST, THIRD], [0, 1]), FIRST, []).tolist() == []


def test_points_are_seen_from_one_of_the_poses(known: Belief) -> None:
    both = groups([FIRST, THIRD], [0, 1])
    there = [(x + THIRD.x - FIRST.x, y) for x, y in POINTS]
    assert OUTLOOK.worth(known, both, THIRD, there).tolist() == OUTLOOK.worth(known, both, FIRST, POINTS).tolist()


def test_pairs_of_one_part_count_little_as_long_as_there_is_another(known: Belief) -> None:
    alone = OUTLOOK.worth(known, groups([FIRST, THIRD], [0, 0]), FIRST, POINTS[1:2])[0]
    within = OUTLOOK.worth(known, groups([FIRST, SECOND, THIRD], [1, 0, 1]), FIRST, POINTS[1:2])[0]
    assert alone == 1.0
    assert 1.0 < within < 1.1, "that of the second and the third, and little for that of the first and the third"
