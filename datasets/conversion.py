"""`convert`: writes any recording as a ROS bag or as JSON lines, which read back as the very same steps."""

import math
from collections import deque
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import IO, TYPE_CHECKING

from ial.datasets import ros_messages as ros
from ial.datasets.odometry import Odometry
from ial.datasets.odometry_path import OdometryPath
from ial.datasets.recording import Reading, Recording
from ial.datasets.ros_messages import ERROR_TOPIC, ERROR_TYPE, LOOKED_UP_TOPIC, ODOMETRY_TYPE
from ial.datasets.scan import LaserScan, Mounting
from ial.datasets.scan_stream import odometry_line, scan_line
from ial.datasets.tf_buffer import ODOM_FRAME
from ial.errors import OutputError
from ial.whole_file import whole_files

if TYPE_CHECKING:
    from ial.datasets.bag_writer import BagWriter

BASE = "base_link"
_REMEMBERED = 2**12  # stamps, to be compared with those of a sweep that goes back


def convert(recording: Recording, path: str | Path) -> int:
    """Write a recording as ``.mcap`` (ROS 2) or ``.bag`` (ROS 1) and return the number of scans.

    Topics: ``/scan``, for all lidars; ``/odom`` and ``/tf`` (odom → base_link), every message of the odometry up to the last scan, with
    that of each scan at its stamp; ``/tf_static`` with the mounting of each lidar; ``/odom_at_scan`` and ``/odom_error``, the odometry at
    first and last beams where it is no message but was looked up between two. Scans that are skipped when the recording is read are not
    written.

    Parameters
    ----------
    recording
        What to write.
    path
        The file, which appears when it is complete.

    Raises
    ------
    RecordingError
        If the recording cannot be read.
    OutputError
        If the file cannot be written, or if the mounting of a laser changes within the recording.
    """
    from ial.datasets.bag_writer import BagWriter  # rosbags is slow to import

    mountings: dict[str, Mounting] = {}
    count = 0
    messages = _Messages(str(path))
    with BagWriter(path) as bag:
        for reading in recording.readings():
            frame, mounting = reading.scan.frame_id, reading.scan.mounting
            if frame not in mountings:
                _write_mounting(bag, reading)
            if mountings.setdefault(frame, mounting) != mounting:
                raise OutputError(f"{path}: the mounting of the laser {frame} changes at scan {reading.index}, which one bag cannot say")
            for stamp, message in messages.of(reading):
                _write_message(bag, stamp, message)
            scan = messages.scan(reading)
            if messages.looked_up(reading):
                _write_looked_up(bag, scan.stamp_ns, reading.odometry)
            bag.write("/scan", "sensor_msgs/msg/LaserScan", scan.stamp_ns, ros.scan_message(bag, scan))
            if scan.sweep is not None:
                _write_looked_up(bag, scan.end_ns, scan.sweep.last)
            count += 1
        for stamp, message in messages.rest():
            _write_message(bag, stamp, message)
    return count


def convert_to_lines(recording: Recording, target: Path | IO[str]) -> int:
    """Write a recording as JSON lines (`ial.datasets.scan_stream`), each scan behind its odometry, and return the number of scans.

    Parameters
    ----------
    recording
        What to write.
    target
        The file, which appears when it is complete; or an open one, to which lines go as the recording is read.

    Raises
    ------
    RecordingError
        If the recording cannot be read.
    OutputError
        If the file cannot be written.
    """
    if not isinstance(target, Path):
        count = 0
        messages = _Messages(recording.name)
        for reading in recording.readings():
            target.writelines(f"{odometry_line(*message)}\n" for message in messages.of(reading))
            target.write(f"{scan_line(messages.scan(reading), reading.odometry if messages.looked_up(reading) else None)}\n")
            count += 1
        target.writelines(f"{odometry_line(*message)}\n" for message in messages.rest())
        return count
    with whole_files(target) as (lent,), lent.open("w", encoding="utf-8") as file:
        return convert_to_lines(recording, file)


class _Messages:
    """The messages of a recording in the order of their stamps, each once: those of a scan's sweep come again before the next scans."""

    def __init__(self, name: str) -> None:
        self._name = name
        self._last: int | None = None
        self._sweeps: dict[int, Odometry] = {}
        self._swept: list[OdometryPath] = []
        self._written: deque[int] = deque(maxlen=_REMEMBERED)
        self._together: list[Reading] = []  # the scans of several lidars that have one stamp

    def of(self, reading: Reading) -> Iterator[tuple[int, Odometry]]:
        """Yield those before a scan, and that at its stamp.

        Raises
        ------
        OutputError
            If no copy could read as the same: their stamps do not increase, or some were lost.
        """
        together = self._joins(reading)
        self._together = [*self._together, reading] if together else [reading]
        if together:
            self._take_sweep(reading)
            return
        for stamp, message in (*reading.messages, (reading.stamp_ns, reading.odometry)):
            if self._last is not None and stamp <= self._last:
                raise OutputError(f"{self._name}: scan {reading.index} has more odometry messages before it than nanoseconds")
            if not math.isfinite(message.error_m):
                raise OutputError(
                    f"{self._name}: before scan {reading.index} too many odometry messages came without a usable scan to keep all"
                )
            self._last = stamp
            if stamp < reading.stamp_ns or not self.looked_up(reading):
                self._check(reading, stamp)
                self._written.append(stamp)
                yield stamp, message
        self._take_sweep(reading)

    def scan(self, reading: Reading) -> LaserScan:
        """Return the scan of the reading at hand as it is to be written: at the stamp of the scans that it came together with."""
        scan, stamp = reading.scan, self._together[0].stamp_ns
        if scan.sweep is not None and scan.sweep.stamps_ns[0] != stamp:
            raise OutputError(f"{self._name}: the sweep of scan {reading.index} does not begin at its stamp, which no copy can say")
        return scan if scan.stamp_ns == stamp else replace(scan, stamp_ns=stamp)

    def looked_up(self, reading: Reading) -> bool:
        """Return whether the odometry of the reading at hand is no message of the stamp at which it is to be written."""
        return reading.looked_up or self._together[0].raised_ns != 0

    def _joins(self, reading: Reading) -> bool:
        """Return whether a scan has the stamp of the last ones, which are of other lidars; a reader moves it by one nanosecond."""
        if not self._together or reading.scan.frame_id in {each.scan.frame_id for each in self._together}:
            return False
        last = self._together[-1]
        return reading.recorded_ns == last.recorded_ns and reading.stamp_ns == last.stamp_ns + 1 and not len(reading.messages)

    def _check(self, reading: Reading, stamp: int) -> None:
        """Refuse a message that would come into the sweep of a scan before, which has none at that stamp."""
        for sweep in self._swept:
            if sweep.stamps_ns[0] < stamp < sweep.stamps_ns[-1] and stamp not in sweep.stamps_ns:
                raise OutputError(self._mended(reading))

    def _mended(self, reading: Reading) -> str:
        return f"{self._name}: stamps before scan {reading.index} were mended, and its copy would have other odometry during a scan"

    def _take_sweep(self, reading: Reading) -> None:
        """Take note of which messages there are during a scan; refuse a sweep back over others than were written."""
        if reading.scan.sweep is not None:
            first, *during, last = reading.scan.sweep.stamps_ns.tolist()
            if last < first and self._written:
                known = [stamp for stamp in reversed(during) if stamp >= self._written[0]]
                if known != [stamp for stamp in self._written if last < stamp < first]:
                    raise OutputError(self._mended(reading))
            self._swept.append(reading.scan.sweep)
        self._swept = [sweep for sweep in self._swept if sweep.stamps_ns[-1] > reading.stamp_ns]
        sweep = () if reading.scan.sweep is None else list(reading.scan.sweep)[1:-1]
        self._sweeps = {stamp: message for stamp, message in (*self._sweeps.items(), *sweep) if stamp > reading.stamp_ns}

    def rest(self) -> Iterator[tuple[int, Odometry]]:
        """Yield those during the last sweeps, which no scan follows."""
        yield from sorted(self._sweeps.items(), key=lambda message: message[0])


def _write_mounting(bag: "BagWriter", first: Reading) -> None:
    transform = ros.mounting_transform(bag, first.stamp_ns, BASE, first.scan.frame_id, first.scan.mounting)
    bag.write("/tf_static", "tf2_msgs/msg/TFMessage", first.stamp_ns, ros.transforms_message(bag, [transform]), latched=True)


def _write_message(bag: "BagWriter", stamp: int, odometry: Odometry) -> None:
    turn = ros.rotation(bag, 0.0, 0.0, odometry.z, odometry.w)
    transform = ros.stamped_transform(bag, stamp, ODOM_FRAME, BASE, odometry.x, odometry.y, turn)
    bag.write("/tf", "tf2_msgs/msg/TFMessage", stamp, ros.transforms_message(bag, [transform]))
    _write_odometry(bag, "/odom", stamp, odometry)


def _write_looked_up(bag: "BagWriter", stamp: int, odometry: Odometry) -> None:
    _write_odometry(bag, LOOKED_UP_TOPIC, stamp, odometry)


def _write_odometry(bag: "BagWriter", topic: str, stamp: int, odometry: Odometry) -> None:
    bag.write(topic, ODOMETRY_TYPE, stamp, ros.odometry_message(bag, stamp, ODOM_FRAME, BASE, odometry))
    if not odometry.exact:
        error = ros.vector(bag, odometry.error_m, 0.0, odometry.error_rad)
        stamped = bag.message(ERROR_TYPE, header=bag.header(stamp, ODOM_FRAME), vector=error)
        bag.write(ERROR_TOPIC, ERROR_TYPE, stamp, stamped)
