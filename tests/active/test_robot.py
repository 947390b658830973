import pytest

from ial.active.robot import Drive
from ial.active.simulated_robot import SimulatedRobot
from ial.datasets.scan import LaserScan
from ial.datasets.walk import random_walk
from ial.maps.grids.alike_plans import alike_plan
from ial.pose import Pose
from tests.active.own_robot import Message, OwnRobot, localized
from tests.active.scenes import MOTION, belief, robot, room


class Simulated:
    """A base that is simulated; its clock begins with its odometry."""

    def __init__(self, driving: SimulatedRobot) -> None:
        self.driving, self.collisions = driving, 0

    def go(self, turn_rad: float, distance_m: float) -> list[Message]:
        self.driving.drive(Drive(turn_rad, distance_m))
        x, y, z, w, *_ = self.driving._odometry.numbers
        return [(round(1e9 * (self.driving._now_s - 1.0)), x, y, z, w)]

    def scan(self) -> LaserScan:
        return self.driving.look()

    def bumped(self) -> bool:
        before, self.collisions = self.collisions, self.driving.collisions
        return self.collisions > before


def test_the_motion_of_a_robot_of_ones_own_holds_what_it_did() -> None:
    driving = robot(room(), Pose(1.5, 1.0, 0.3), seed=2, adversarial=True)
    own = OwnRobot(Simulated(driving), MOTION)
    bumps = []
    for number in range(12):
        before = driving.pose
        driven = own.drive(Drive(0.3 * (number % 4), 0.6))
        assert driven.motion.contains(before.inverse() @ driving.pose)
        bumps.append(driven.collided)
    assert sum(bumps) == driving.collisions > 0
    assert len(driven.reading.ranges) == 91


@pytest.mark.slow
def test_a_robot_of_ones_own_is_localized() -> None:
    grid = alike_plan("rooms")
    driving = robot(grid, random_walk(grid, 1, 1, clearance_m=0.5)[0], seed=1)
    known = belief(grid)
    assert localized(Simulated(driving), known) == "localized"
    assert known.estimate is not None
    assert known.estimate.poses.contains(grid.pose_to_grid(driving.pose))
    assert len(driving.path) > 1
    assert driving.collisions == 0
