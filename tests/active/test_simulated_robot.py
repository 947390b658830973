import math

import pytest

from ial.active.robot import Drive
from ial.errors import ConfigError
from ial.pose import Pose
from tests.active.scenes import RADIUS_M, distance_to_walls, robot, room

GRID = room()


@pytest.mark.parametrize("adversarial", [False, True])
def test_what_its_odometry_says_holds_what_it_did(adversarial: bool) -> None:
    driving = robot(GRID, Pose(1.0, 1.0, 0.0), 3, adversarial)
    for number in range(40):
        before = driving.pose
        driven = driving.drive(Drive(0.1 * (number % 7), 0.4))
        assert driven.motion.contains(before.inverse() @ driving.pose)
        assert distance_to_walls(GRID, driving.pose.x, driving.pose.y) >= RADIUS_M - 1e-9
    assert driving.collisions > 0
    assert len(driving.path) == 41


def test_it_stops_where_it_touches_something_and_says_so() -> None:
    driving = robot(GRID, Pose(1.0, 1.0, 0.0))
    driven = driving.drive(Drive(math.pi, 3.0))
    assert driven.collided
    assert RADIUS_M <= distance_to_walls(GRID, driving.pose.x, driving.pose.y) < RADIUS_M + 0.05
    assert not driving.drive(Drive(math.pi, 0.5)).collided


def test_it_misses_its_way_by_no_more_than_it_may() -> None:
    for seed in range(20):
        driving = robot(GRID, Pose(1.0, 1.0, 0.2), seed, adversarial=seed % 2 == 0)
        driving.drive(Drive(0.4, 0.8))
        told = driving.errors.motion.enclose(Pose(0.8 * math.cos(0.4), 0.8 * math.sin(0.4), 0.4), 2.1)
        assert told.contains(Pose(1.0, 1.0, 0.2).inverse() @ driving.pose)


@pytest.mark.parametrize("place", [(0.1, 1.0), (9.0, 1.0), (3.2, 1.7), (-1.0, -1.0)])
def test_it_cannot_start_in_a_wall(place: tuple[float, float]) -> None:
    with pytest.raises(ConfigError, match="cannot start at"):
        robot(GRID, Pose(*place, 0.0))
