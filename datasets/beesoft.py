"""Logs of L and O lines in centimetres, as the BeeSoft robots of Carnegie Mellon wrote them (Wean Hall).

``O x y θ stamp`` is a message of the odometry; ``L x y θ xl yl θl r₁ … rₙ stamp`` is a scan with the odometry pose of the robot and of its
laser at that time.
"""

import math
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from ial.datasets.carmen_line import MalformedLineError, flaser_increment
from ial.datasets.info import Topic
from ial.datasets.odometry import Odometry
from ial.datasets.odometry_path import OdometryPath
from ial.datasets.reader import Reader, Record
from ial.datasets.scan import Mounting
from ial.datasets.stamps import parse_stamp
from ial.datasets.text_log import lines
from ial.pose import Pose, wrap

_METRES = 0.01
_NO_RETURN_M = 81.83  # a SICK LMS with a range of 80 m reports its faults as readings from 8183 to 8191 cm


class BeesoftLog(Reader):
    """A log of L and O lines; the odometry of a scan is the robot pose in its own line.

    Parameters
    ----------
    path
        The log, plain or gzip.
    laser_pose
        Where the laser sits, ``T_base_laser``; without it, as the two poses of the first scan line say.
    """

    format = "log of L and O lines"

    def __init__(self, path: Path, laser_pose: Pose | None = None) -> None:
        super().__init__(str(path))
        self._path = path
        self._mounting = None if laser_pose is None else Mounting(laser_pose.x, laser_pose.y, laser_pose.theta)

    def _topics(self) -> list[Topic]:
        counts = Counter(line[:1].decode("ascii", "replace") for line in lines(self._path) if line.strip())
        return [Topic(keyword, "text", count) for keyword, count in sorted(counts.items())]

    def _records(self) -> Iterator[Record]:
        mounting = self._mounting
        messages: list[tuple[int, Odometry]] = []  # since the last scan that was used

        def take(since: int | None) -> OdometryPath:
            path = OdometryPath.of(messages)
            messages.clear()
            return path

        for line in lines(self._path):
            words = line.split()
            if words[:1] == [b"O"]:
                messages += self._message(words)
            if words[:1] != [b"L"]:
                continue
            try:
                robot, laser, ranges, stamp = _parse(words)
            except MalformedLineError as fault:
                yield Record(None, fault=str(fault) if line.endswith(b"\n") else f"{fault} (the log ends within it)")
                continue
            if mounting is None:
                offset = robot.inverse() @ laser
                mounting = Mounting(offset.x, offset.y, offset.theta)
            scan = {
                "ranges": ranges,
                "angle_min": -0.5 * math.pi,
                "angle_increment": flaser_increment(len(ranges)),
                "range_max": _NO_RETURN_M,
                "mounting": mounting,
            }
            yield Record(stamp, Odometry.of(robot), scan, messages=take)

    def _message(self, words: list[bytes]) -> list[tuple[int, Odometry]]:
        """Return the odometry of an O line; nothing where it cannot be read, which is counted."""
        try:
            if len(words) != 5:
                raise ValueError
            return [(parse_stamp(words[4].decode()), Odometry.of(_pose(words[1:4])))]
        except ValueError:
            self.repaired["O line that cannot be read: left out"] += 1
            return []


def _parse(words: list[bytes]) -> tuple[Pose, Pose, list[float], int]:
    """Return the robot's pose, the laser's pose, the ranges in metres, and the stamp."""
    try:
        robot, laser = _pose(words[1:4]), _pose(words[4:7])
        return robot, laser, [float(word) / 100.0 for word in words[7:-1]], parse_stamp(words[-1].decode())
    except ValueError:
        raise MalformedLineError("L line that cannot be read") from None


def _pose(words: list[bytes]) -> Pose:
    x, y, theta = (float(word) for word in words)
    if not all(map(math.isfinite, (x, y, theta))):
        raise ValueError
    return Pose(_METRES * x, _METRES * y, wrap(theta))
