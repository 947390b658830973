"""`convert`: writes any recording as a ROS bag or as JSON lines, which read back as the very same steps."""

from pathlib import Path
from typing import IO, TYPE_CHECKING

import numpy as np

from ial.datasets import ros_messages as ros
from ial.datasets.odometry import Odometry
from ial.datasets.recording import Reading, Recording
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

    Topics: ``/scan``, for all lidars; ``/odom``, one message at each scan's stamp, and one at its last beam where that has a time of its
    own; ``/tf_static`` with the mounting of each lidar; ``/tf`` with odom → base_link; and, where odometry was interpolated,
    ``/odom_error``. Scans that are skipped when the recording is read are not written.

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
    with BagWriter(path) as bag:
        for reading in recording.readings():
            frame, mounting = reading.scan.frame_id, reading.scan.mounting
            if frame not in mountings:
                _write_mounting(bag, reading)
            if mountings.setdefault(frame, mounting) != mounting:
                raise OutputError(f"{path}: the mounting of the laser {frame} changes at scan {reading.index}, which one bag cannot say")
            _write_odometry(bag, reading.odometry, reading.stamp_ns)
            _write_scan(bag, reading)
            if reading.end is not None:
                _write_odometry(bag, reading.end, reading.scan.end_ns)
            count += 1
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
        for reading in recording.readings():
            target.write(f"{odometry_line(reading)}\n{scan_line(reading.scan, reading.end)}\n")
            count += 1
        return count
    with whole_files(target) as (lent,), lent.open("w", encoding="utf-8") as file:
        return convert_to_lines(recording, file)


def _write_mounting(bag: "BagWriter", first: Reading) -> None:
    transform = ros.mounting_transform(bag, first.stamp_ns, BASE, first.scan.frame_id, first.scan.mounting)
    bag.write("/tf_static", "tf2_msgs/msg/TFMessage", first.stamp_ns, ros.transforms_message(bag, [transform]), latched=True)


def _write_odometry(bag: "BagWriter", odometry: Odometry, stamp: int) -> None:
    turn = ros.rotation(bag, 0.0, 0.0, odometry.z, odometry.w)
    transform = ros.stamped_transform(bag, stamp, ODOM_FRAME, BASE, odometry.x, odometry.y, turn)
    bag.write("/tf", "tf2_msgs/msg/TFMessage", stamp, ros.transforms_message(bag, [transform]))
    pose = bag.message("geometry_msgs/msg/Pose", position=ros.point(bag, odometry.x, odometry.y), orientation=turn)
    zero = ros.vector(bag, 0.0, 0.0)
    twist = bag.message("geometry_msgs/msg/Twist", linear=zero, angular=zero)
    message = bag.message(
        "nav_msgs/msg/Odometry",
        header=bag.header(stamp, ODOM_FRAME),
        child_frame_id=BASE,
        pose=bag.message("geometry_msgs/msg/PoseWithCovariance", pose=pose, covariance=np.zeros(36)),
        twist=bag.message("geometry_msgs/msg/TwistWithCovariance", twist=twist, covariance=np.zeros(36)),
    )
    bag.write("/odom", "nav_msgs/msg/Odometry", stamp, message)
    if odometry.error_m or odometry.error_rad:
        error = ros.vector(bag, odometry.error_m, 0.0, odometry.error_rad)
        stamped = bag.message("geometry_msgs/msg/Vector3Stamped", header=bag.header(stamp, ODOM_FRAME), vector=error)
        bag.write("/odom_error", "geometry_msgs/msg/Vector3Stamped", stamp, stamped)


def _write_scan(bag: "BagWriter", reading: Reading) -> None:
    bag.write("/scan", "sensor_msgs/msg/LaserScan", reading.stamp_ns, ros.scan_message(bag, reading.scan))
