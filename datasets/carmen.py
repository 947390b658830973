"""CARMEN logs: FLASER, ROBOTLASER1, ODOM and PARAM lines, plain or compressed with gzip.

The odometry of a scan is the last ODOM line before it in file order; the stamps of ODOM lines repeat and jump and are not used: the time
from scan to scan is shared equally among the lines between. In a log
that a mapper (GMapping's gfs) has corrected, each scan is followed by an ODOM line that repeats the scan's corrected pose, most with stamps
0: from there on the odometry runs in another frame. Such a line re-bases the frame, so that readings carry one continuous odometry.
"""

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ial.datasets.carmen_line import LaserLine, MalformedLineError, parse_flaser, parse_odom, parse_robotlaser
from ial.datasets.info import Topic
from ial.datasets.odometry import Odometry
from ial.datasets.odometry_path import OdometryPath
from ial.datasets.reader import Reader, Record
from ial.datasets.scan import Mounting
from ial.datasets.text_log import lines
from ial.errors import RecordingError
from ial.pose import Pose

_PARSERS = {b"FLASER": parse_flaser, b"ROBOTLASER1": parse_robotlaser}
_SICK_CODES = (81.83, 81.91)  # a SICK LMS with a range of 80 m reports its faults as readings from 81.83 to 81.91 m
_NEVER_NS = 2**63 - 1
_NO_RETURN_COUNT = 3
_NO_RETURN_SHARE = 1e-3


@dataclass
class _Survey:
    """What must be known of a log before its first scan can be read."""

    keywords: Counter[str] = field(default_factory=Counter)
    laser_max: float = 0.0
    readings: int = 0
    largest: float = -math.inf
    largest_count: int = 0
    scans: int = 0
    repeated: int = 0  # scan lines directly followed by an ODOM line of the same pose
    unstamped: int = 0  # those among them whose stamps are 0

    def count(self, ranges: list[float]) -> None:
        """Take note of one FLASER line's readings."""
        values = np.array(ranges)
        values = values[np.isfinite(values)]
        self.readings += len(values)
        largest = float(values.max(initial=-math.inf))
        if largest > self.largest:
            self.largest, self.largest_count = largest, 0
        if len(values) and largest == self.largest:
            self.largest_count += int((values == largest).sum())

    def follow(self, scan: Pose, odometry: tuple[Pose, bool]) -> None:
        """Take note of an ODOM line that directly follows a scan line."""
        pose, unstamped = odometry
        self.repeated += pose == scan
        self.unstamped += pose == scan and unstamped

    @property
    def corrected(self) -> bool:
        """Whether every scan (but perhaps the last, cut off) is followed by its corrected pose."""
        return self.unstamped > 0 and self.repeated >= self.scans - 1

    @property
    def range_max(self) -> float:
        """The number that stands for no return in FLASER lines; infinite if there seems to be none.

        It is the parameter ``robot_front_laser_max`` if that is positive, else the largest reading of the log if it repeats.
        """
        if self.laser_max > 0.0:
            return self.laser_max
        if self.largest_count < max(_NO_RETURN_COUNT, _NO_RETURN_SHARE * self.readings) or self.largest <= 0.0:
            return math.inf
        low, high = _SICK_CODES
        return low if low <= self.largest <= high else self.largest


class _OdometryChain:
    """The odometry of a log as one continuous pose, however often its frame is re-based."""

    def __init__(self) -> None:
        self._frame: Pose | None = None  # T_odom_file; None is the identity, and exact
        self._recorded: Pose | None = None  # the last ODOM line
        self._lines: list[Odometry] = []  # since the last scan that was used

    def record(self, pose: Pose | None) -> None:
        """Take an ODOM line; None is one that could not be read."""
        self._recorded = pose
        here = self.odometry()
        if here is not None:
            self._lines.append(here)

    def take(self, since: int | None) -> OdometryPath:
        """Return the messages since the last scan that was used, but for the last, which is that of the scan at hand; forget them.

        All have the stamp of that scan, which says that they have none of their own. Before the first scan they have one that no scan has.
        """
        messages, self._lines = self._lines, []
        if since is None:
            return OdometryPath.of((_NEVER_NS, message) for message in messages)
        return OdometryPath.of((since, message) for message in messages[:-1])

    def odometry(self) -> Odometry | None:
        """Return the continuous pose as the odometry of a scan."""
        here = self.pose()
        return None if here is None else Odometry.of(here)

    def rebase(self, corrected: Pose) -> None:
        """From here on the log's odometry starts from `corrected` where it was at its last line."""
        here = self.pose()
        if here is not None:
            self._frame = here @ corrected.inverse()
        self._recorded = corrected

    def pose(self) -> Pose | None:
        """Return the continuous pose, or None before the first ODOM line."""
        if self._frame is None or self._recorded is None:
            return self._recorded
        return self._frame @ self._recorded


class CarmenLog(Reader):
    """A CARMEN log.

    Parameters
    ----------
    path
        The log, plain or gzip.
    scan_topics
        ``FLASER`` or ``ROBOTLASER1``; needed only if the log holds both, which are then the same lidar twice.
    laser_pose
        Where the laser sits, ``T_base_laser``; without it, as the first scan line's two poses say.
    """

    format = "CARMEN log"

    def __init__(self, path: Path, scan_topics: Sequence[str] = (), laser_pose: Pose | None = None) -> None:
        super().__init__(str(path))
        self._path = path
        self._scan_topics = scan_topics
        self._mounting = None if laser_pose is None else Mounting(laser_pose.x, laser_pose.y, laser_pose.theta)
        self._surveyed: _Survey | None = None

    def _survey(self) -> _Survey:
        """Read the log once for its parameters, its kinds of lines and its no-return code."""
        if self._surveyed is None:
            survey = _Survey()
            scan: Pose | None = None  # of the line before, if that held one
            for line in lines(self._path):
                words = line.split()
                if not words or words[0].startswith(b"#"):
                    continue
                survey.keywords[words[0].decode("ascii", "replace")] += 1
                try:
                    scan = self._look(survey, words, scan)
                except MalformedLineError:
                    scan = None
            self._surveyed = survey
        return self._surveyed

    def _look(self, survey: _Survey, words: list[bytes], before: Pose | None) -> Pose | None:
        """Take note of one line; return the robot's pose if it is a scan."""
        if words[0] in _PARSERS:
            laser = _PARSERS[words[0]](words)
            survey.scans += 1
            if laser.range_max is None:
                survey.count(laser.ranges)
            return laser.robot
        if words[0] == b"ODOM" and before is not None:
            survey.follow(before, parse_odom(words))
        elif words[:2] == [b"PARAM", b"robot_front_laser_max"]:
            survey.laser_max = _positive(words[2:3])
        return None

    def _keyword(self) -> bytes:
        """Return the kind of line that holds the scans."""
        present = [keyword for keyword in _PARSERS if self._survey().keywords[keyword.decode()]]
        if len(self._scan_topics) > 1:
            raise RecordingError(f"{self.name}: a CARMEN log is read as that of one lidar; give --scan-topic once")
        for named in self._scan_topics:
            if named.encode() not in present:
                names = ", ".join(keyword.decode() for keyword in present) or "none"
                raise RecordingError(f"{self.name}: no {named} lines; the kinds of scan lines in it are: {names}")
            return named.encode()
        if len(present) > 1:
            raise RecordingError(
                f"{self.name}: has scans in FLASER and in ROBOTLASER1 lines; choose with --scan-topic FLASER or --scan-topic ROBOTLASER1"
            )
        if not present:
            kinds = ", ".join(sorted(self._survey().keywords)[:10]) or "nothing"
            raise RecordingError(f"{self.name}: no FLASER or ROBOTLASER1 lines, so no scans; its lines are: {kinds}")
        return present[0]

    def _topics(self) -> list[Topic]:
        return [Topic(keyword, "CARMEN", count) for keyword, count in sorted(self._survey().keywords.items())]

    def _records(self) -> Iterator[Record]:
        keyword = self._keyword()
        chain = _OdometryChain()
        mounting = self._mounting
        after_scan = False
        for line in lines(self._path):
            words = line.split()
            if not words:
                continue
            if words[0] == b"ODOM":
                pose = self._odom(words)
                if pose is not None and after_scan and self._survey().corrected:
                    chain.rebase(pose)
                else:
                    chain.record(pose)
            elif words[0] == keyword:
                try:
                    laser = _PARSERS[keyword](words)
                except MalformedLineError as fault:
                    yield Record(None, fault=str(fault) if line.endswith(b"\n") else f"{fault} (the log ends within it)")
                else:
                    mounting = mounting or laser.mounting()
                    yield self._record(laser, chain, mounting)
            after_scan = words[0] == keyword

    def _odom(self, words: list[bytes]) -> Pose | None:
        try:
            return parse_odom(words)[0]
        except MalformedLineError as fault:
            self.repaired[f"{fault}: left out"] += 1
            return None

    def _record(self, laser: LaserLine, chain: _OdometryChain, mounting: Mounting) -> Record:
        scan = {
            "ranges": laser.ranges,
            "angle_min": laser.angle_min,
            "angle_increment": laser.angle_increment,
            "range_max": self._survey().range_max if laser.range_max is None else laser.range_max,
            "mounting": mounting,
        }
        return Record(laser.stamp_ns, chain.odometry(), scan, messages=chain.take)


def _positive(words: list[bytes]) -> float:
    """Return the number in a parameter's value, or 0 if it is none."""
    try:
        value = float(words[0])
    except (IndexError, ValueError):
        return 0.0
    return value if 0.0 < value < math.inf else 0.0
