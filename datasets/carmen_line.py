"""The lines of a CARMEN log, taken apart.

Source: the message formats that the logger writes at the head of each log.
"""

import math
from dataclasses import dataclass

from ial.datasets.scan import Mounting
from ial.datasets.stamps import parse_stamp
from ial.pose import Pose, wrap


class MalformedLineError(ValueError):
    """A line that does not have the form its keyword promises; the text says of which kind."""


@dataclass(frozen=True)
class LaserLine:
    """One scan line.

    Parameters
    ----------
    ranges
        Metres, in the order of the line.
    angle_min, angle_increment
        Bearing of the first beam and step, radians.
    range_max
        The sensor's limit, metres; None where the line does not say.
    laser, robot
        The two poses in the line. In a corrected log they are corrected too.
    stamp_ns
        When the message was sent.
    """

    ranges: list[float]
    angle_min: float
    angle_increment: float
    range_max: float | None
    laser: Pose
    robot: Pose
    stamp_ns: int

    def mounting(self) -> Mounting:
        """Return where the laser sits on the robot."""
        if self.laser == self.robot:
            return Mounting()
        offset = self.robot.inverse() @ self.laser
        return Mounting(offset.x, offset.y, offset.theta)


def flaser_increment(beams: int) -> float:
    """Return the step of a FLASER line in radians: 180 beams leave out the last of the half circle, 181 hold both ends."""
    return math.pi / max(beams - beams % 2, 1)


def parse_flaser(words: list[bytes]) -> LaserLine:
    """Parse ``FLASER n r₁ … rₙ laser(x y θ) robot(x y θ) ipc_stamp host logger_stamp``; beams run over 180° from −90°.

    Raises
    ------
    MalformedLineError
        If words are missing or are not numbers.
    """
    try:
        beams = int(words[1])
        if len(words) != beams + 11 or beams < 0:
            raise ValueError
        ranges = [float(word) for word in words[2 : beams + 2]]
        laser, robot = _pose(words[beams + 2 : beams + 5]), _pose(words[beams + 5 : beams + 8])
        stamp = parse_stamp(words[beams + 8].decode())
    except (ValueError, IndexError):
        raise MalformedLineError("FLASER line that cannot be read") from None
    return LaserLine(ranges, -0.5 * math.pi, flaser_increment(beams), None, laser, robot, stamp)


def parse_robotlaser(words: list[bytes]) -> LaserLine:
    """Parse ``ROBOTLASER1 type start fov step max accuracy mode n r₁ … rₙ m e₁ … eₘ laser robot tv rv safety(3) stamp host stamp``.

    Raises
    ------
    MalformedLineError
        If words are missing or are not numbers.
    """
    try:
        start, _, step, range_max = (float(word) for word in words[2:6])
        beams = int(words[8])
        remissions = int(words[beams + 9]) if beams >= 0 else -1
        at = beams + remissions + 10
        if remissions < 0 or len(words) != at + 14:
            raise ValueError
        ranges = [float(word) for word in words[9 : beams + 9]]
        laser, robot = _pose(words[at : at + 3]), _pose(words[at + 3 : at + 6])
        stamp = parse_stamp(words[at + 11].decode())
    except (ValueError, IndexError):
        raise MalformedLineError("ROBOTLASER1 line that cannot be read") from None
    return LaserLine(ranges, start, step, range_max, laser, robot, stamp)


def parse_odom(words: list[bytes]) -> tuple[Pose, bool]:
    """Parse ``ODOM x y θ tv rv accel ipc_stamp host logger_stamp``; return the pose and whether both stamps are zero.

    Raises
    ------
    MalformedLineError
        If words are missing or are not numbers.
    """
    try:
        if len(words) != 10:
            raise ValueError
        return _pose(words[1:4]), float(words[7]) == 0.0 == float(words[9])
    except ValueError:
        raise MalformedLineError("ODOM line that cannot be read") from None


def _pose(words: list[bytes]) -> Pose:
    x, y, theta = (float(word) for word in words)
    if not all(map(math.isfinite, (x, y, theta))):
        raise ValueError
    return Pose(x, y, wrap(theta))
