"""`Reader`: the part that all readers share, which is the rules of the canonical step."""

from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

from ial.datasets.info import RecordingInfo, Topic
from ial.datasets.odometry import Odometry
from ial.datasets.odometry_path import OdometryPath
from ial.datasets.recording import RAISED_BY_NS, STAMP_RAISED, Reading
from ial.datasets.scan import UNTIMED, LaserScan
from ial.datasets.survey import survey
from ial.errors import RecordingError


@dataclass(frozen=True)
class Record:
    """One scan as it stands in a file.

    Parameters
    ----------
    stamp_ns
        Its stamp; None where it could not be read.
    odometry
        Its odometry; None where there is none.
    scan
        The arguments of `LaserScan`, without the stamp.
    fault
        Why it cannot be used, if it cannot.
    repaired
        What was mended in it, if anything.
    messages
        Gives the odometry messages since a scan, by the stamp that this has in the file, or since the beginning if there is None; without
        those at the two scans. It is asked at most once, and only of a scan that is used.
    looked_up
        Whether `odometry` is no message of that time, but was looked up between two.
    """

    stamp_ns: int | None
    odometry: Odometry | None = None
    scan: dict[str, Any] = field(default_factory=dict)
    fault: str = ""
    repaired: str = ""
    messages: Callable[[int | None], OdometryPath] = lambda since: OdometryPath.of()
    looked_up: bool = False


class Reader(ABC):
    """A recording in a file: a subclass yields its records, this class makes them canonical readings.

    A stamp that does not increase from scan to scan that can be used becomes its predecessor's plus 1 ms and is counted, and the times of
    its beams are not known; but the scan of another lidar at the same stamp follows after 1 ns. A scan that cannot be used is counted by
    its reason, and the odometry messages before it belong to the next scan that can.

    Parameters
    ----------
    name
        What to call the recording in messages, usually its path.
    """

    format = ""

    def __init__(self, name: str) -> None:
        self.name = name
        self.skipped: Counter[str] = Counter()
        self.repaired: Counter[str] = Counter()

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.name}>"

    @abstractmethod
    def _records(self) -> Iterator[Record]:
        """Yield the scans in the order of the file."""

    def _topics(self) -> list[Topic]:
        """Return the streams in the file."""
        return []

    def _frames(self) -> dict[str, str]:
        """Return the names of the frames in use, by role."""
        return {}

    def readings(self) -> Iterator[Reading]:
        """Yield the scans in the order of recording.

        Raises
        ------
        RecordingError
            If the recording cannot be read to its end, or yields no scan at all.
        """
        self.skipped.clear()
        self.repaired.clear()
        used: Reading | None = None
        since: int | None = None  # the stamp in the file of the last scan that was used
        lidars: set[str] = set()  # whose scans of that stamp were used
        for index, record in enumerate(self._records()):
            stamp, lidar, timed, raised = record.stamp_ns, record.scan.get("frame_id", ""), {}, 0
            if stamp is not None and used is not None and stamp <= used.stamp_ns:
                together = stamp == since and lidar not in lidars
                raised = used.stamp_ns + (1 if together else RAISED_BY_NS) - stamp
                timed = UNTIMED if raised >= RAISED_BY_NS else {}
                stamp += raised
            scan = self._scan(record, stamp, timed)
            if isinstance(scan, str):
                self.skipped[scan] += 1
            elif record.odometry is not None:
                if timed:
                    self.repaired[STAMP_RAISED] += 1
                if record.repaired:
                    self.repaired[record.repaired] += 1
                given = record.messages(since)
                messages = given.within(None if used is None else used.stamp_ns, scan.stamp_ns)
                lidars = {lidar, *(lidars if record.stamp_ns == since else ())}
                since = record.stamp_ns
                used = Reading(index, scan.stamp_ns, record.odometry, scan, messages, raised, messages is given, record.looked_up)
                yield used
        if used is None:
            self._refuse()

    def _scan(self, record: Record, stamp: int | None, timed: dict[str, Any]) -> LaserScan | str:
        """Return the scan, or the reason why it is skipped."""
        if record.fault or stamp is None:
            return record.fault or "scan without a readable stamp"
        if record.odometry is None:
            return "no odometry"
        try:
            return LaserScan(stamp_ns=stamp, **{**record.scan, **timed})
        except RecordingError as error:
            return str(error)

    def _refuse(self) -> None:
        if not self.skipped:
            raise RecordingError(f"{self.name}: there is no scan in it; check with `ial info` that this is the right file and topic")
        reasons = ", ".join(f"{count} × {reason}" for reason, count in self.skipped.items())
        advice = "; record the odometry too (an Odometry topic or tf odom → base_link; ODOM lines in a CARMEN log)"
        hint = advice if "no odometry" in self.skipped else ""
        raise RecordingError(f"{self.name}: no scan can be used: {reasons}{hint}")

    def info(self) -> RecordingInfo:
        """Read the recording and say what it holds and what is missing."""
        try:
            topics, frames = self._topics(), self._frames()
        except RecordingError as error:
            return RecordingInfo(self.name, self.format, missing=[str(error)])
        return survey(self, self.format, topics, frames)
