"""`Pose`: a position and a heading in the plane, which is also the transform between two frames."""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Pose:
    """An element of SE(2), computed in plain double precision: for data and pictures, never for a bound.

    A transform is named target-then-source: ``T_map_laser = T_map_base @ T_base_laser``.

    Parameters
    ----------
    x, y
        Position in metres.
    theta
        Heading in radians, counter-clockwise from the x axis (REP-103).
    """

    x: float = 0.0
    y: float = 0.0
    theta: float = 0.0

    def __matmul__(self, other: "Pose") -> "Pose":
        c, s = math.cos(self.theta), math.sin(self.theta)
        return Pose(self.x + c * other.x - s * other.y, self.y + s * other.x + c * other.y, wrap(self.theta + other.theta))

    def inverse(self) -> "Pose":
        """Return the transform in the other direction."""
        c, s = math.cos(self.theta), math.sin(self.theta)
        return Pose(-c * self.x - s * self.y, s * self.x - c * self.y, wrap(-self.theta))

    @classmethod
    def from_quaternion(cls, x: float, y: float, z: float, w: float) -> "Pose":
        """Return the pose whose rotation is the unit quaternion (0, 0, z, w)."""
        return cls(x, y, wrap(2.0 * math.atan2(z, w)))

    def quaternion(self) -> tuple[float, float]:
        """Return (z, w) of the unit quaternion (0, 0, z, w) of the rotation."""
        return math.sin(0.5 * self.theta), math.cos(0.5 * self.theta)


def wrap(angle: float) -> float:
    """Return the angle plus a multiple of 2π, in [-π, π]; an angle already there is returned unchanged."""
    return angle if -math.pi <= angle <= math.pi else math.remainder(angle, 2.0 * math.pi)
