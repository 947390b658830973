"""`convert`: writes any recording as a ROS bag or as JSON lines, which read back as the very same steps."""

from pathlib import Path
from typing import IO, TYPE_CHECKING

from ial.datasets import ros_messages as ros
from ial.datasets.copied_messages import CopiedMessages
from ial.datasets.odometry import Odometry
from ial.datasets.recording import Reading, Recording
from ial.datasets.ros_messages import ERROR_TOPIC, ERROR_TYPE, LOOKED_UP_TOPIC, ODOMETRY_TYPE
from ial.datasets.scan import Mounting
from ial.datasets.scan_stream import odometry_line, scan_line
from ial.datasets.tf_buffer import ODOM_FRAME
from ial.errors import OutputError
from ial.whole_file import whole_files

if TYPE_CHECKING:
    from ial.datasets.bag_writer import BagWriter

BASE = "base_link"


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
    messages = CopiedMessages(recording.name)
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
    """Write a recording as JSON lines (`ial.datasets.scan_stream`), each scan after its odometry, and return the number of scans.

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
        messages = CopiedMessages(recording.name)
        for reading in recording.readings():
            target.writelines(f"{odometry_line(*message)}\n" for message in messages.of(reading))
            target.write(f"{scan_line(messages.scan(reading), reading.odometry if messages.looked_up(reading) else None)}\n")
            count += 1
        target.writelines(f"{odometry_line(*message)}\n" for message in messages.rest())
        return count
    with whole_files(target) as (lent,), lent.open("w", encoding="utf-8") as file:
        return convert_to_lines(recording, file)


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
