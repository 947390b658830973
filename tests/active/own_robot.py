"""A robot of one's own behind the protocol of `ial.active`, as the pages can show it."""

from typing import Protocol

from ial.active import Belief, Drive, Driven, TwoStagePlanner, explore
from ial.datasets import LaserScan, Motion, MotionBounds, Odometry
from ial.datasets.odometry_path import OdometryPath

Message = tuple[int, float, float, float, float]  # nanoseconds, x and y in metres, z and w of the quaternion of the heading


class Base(Protocol):
    """What comes with the robot."""

    def go(self, turn_rad: float, distance_m: float) -> list[Message]: ...
    def scan(self) -> LaserScan: ...
    def bumped(self) -> bool: ...


class OwnRobot:
    def __init__(self, base: Base, bounds: MotionBounds) -> None:
        self.base, self.bounds = base, bounds
        self.last: Message = (0, 0.0, 0.0, 0.0, 1.0)

    def look(self) -> LaserScan:
        return self.base.scan()

    def drive(self, command: Drive) -> Driven[Motion, LaserScan]:
        messages = [self.last, *self.base.go(command.turn_rad, command.distance_m)]  # every one of the way
        self.last = messages[-1]
        path = OdometryPath.of((stamp, Odometry(x, y, z, w)) for stamp, x, y, z, w in messages)
        return Driven(self.bounds.along(path), self.look(), self.base.bumped())


def localized(base: Base, belief: Belief) -> str:
    robot = OwnRobot(base, belief.localizer.config.bounds.motion)
    *_, last = explore(belief, robot, TwoStagePlanner(belief), most_drives=40)
    return last.estimate.status
