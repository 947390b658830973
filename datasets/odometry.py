"""`Odometry`: where the wheels say the robot is, in the one form that every reader produces."""

import math
from dataclasses import dataclass
from functools import cached_property

from ial.pose import Pose


@dataclass(frozen=True)
class Odometry:
    """The odometry at one moment: ``T_odom_base`` as position and quaternion.

    The quaternion is kept as it was read, of any length, so that writing and reading it again changes no bit. These four numbers *are* what
    was recorded: bounds are about the exact motion between the exact poses that they say, and what a reader makes of decimals, of angles
    (`of`), or of the frames of a corrected log belongs to the recording.

    Parameters
    ----------
    x, y
        Position in the odometry frame, metres.
    z, w
        The quaternion (0, 0, z, w) of the heading.
    error_m, error_rad
        How far each coordinate and the heading may be from what the robot recorded, because the moment fell between two messages.
    """

    x: float
    y: float
    z: float = 0.0
    w: float = 1.0
    error_m: float = 0.0
    error_rad: float = 0.0

    @classmethod
    def of(cls, pose: Pose, error_m: float = 0.0, error_rad: float = 0.0) -> "Odometry":
        """Return the odometry of a pose whose heading is an angle, as the quaternion of doubles next to it."""
        return cls(pose.x, pose.y, *pose.quaternion(), error_m, error_rad)

    @cached_property
    def pose(self) -> Pose:
        """``T_odom_base``, its heading rounded to an angle: for pictures, never for a bound."""
        return Pose.from_quaternion(self.x, self.y, self.z, self.w)

    @property
    def numbers(self) -> tuple[float, float, float, float, float, float]:
        """All of it: x, y, z, w, error_m, error_rad."""
        return self.x, self.y, self.z, self.w, self.error_m, self.error_rad

    @property
    def exact(self) -> bool:
        """Whether it is what the robot recorded, not something between two messages."""
        return self.error_m == 0.0 == self.error_rad

    @property
    def valid(self) -> bool:
        """Whether all numbers are finite and the quaternion is one."""
        return all(map(math.isfinite, (self.x, self.y, self.z, self.w))) and (self.z, self.w) != (0.0, 0.0)


def quaternion_heading(theta: float) -> float:
    """Return the heading, at most some units in the last place away, that stays the same when it is written as a quaternion and read back.

    Writing and reading leads from each double to another; where that ends in a cycle, the smallest of the cycle is taken.
    """
    seen: list[float] = []
    while theta not in seen:
        seen.append(theta)
        theta = Pose.from_quaternion(0.0, 0.0, *Pose(0.0, 0.0, theta).quaternion()).theta
    return min(seen[seen.index(theta) :])
