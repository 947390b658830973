"""`convert`: writes any recording as a ROS bag that reads back as the very same steps."""

import math
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ial.datasets.recording import Reading, Recording
from ial.datasets.scan import Mounting
from ial.datasets.tf_buffer import ODOM_FRAME
from ial.errors import OutputError

if TYPE_CHECKING:
    from ial.datasets.bag_writer import BagWriter

BASE = "base_link"


def convert(recording: Recording, path: str | Path) -> int:
    """Write a recording as ``.mcap`` (ROS 2) or ``.bag`` (ROS 1) and return the number of scans.

    Topics: ``/scan``; ``/odom``, one message at each scan's stamp; ``/tf_static`` with the mounting; ``/tf`` with odom → base_link; and,
    where odometry was interpolated, ``/odom_error``. Scans that are skipped when the recording is read are not written.

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
        If the file cannot be written, or if the laser's mounting changes within the recording.
    """
    from ial.datasets.bag_writer import BagWriter  # rosbags is slow to import

    readings = recording.readings()
    first = next(readings)
    count = 0
    with BagWriter(path) as bag:
        _write_mounting(bag, first)
        for reading in chain([first], readings):
            if reading.scan.mounting != first.scan.mounting or reading.scan.frame_id != first.scan.frame_id:
                raise OutputError(f"{path}: the laser's frame or mounting changes at scan {reading.index}, which one bag cannot say")
            _write_odometry(bag, reading)
            _write_scan(bag, reading)
            count += 1
    return count


def _quaternion(bag: "BagWriter", x: float, y: float, z: float, w: float) -> Any:
    return bag.message("geometry_msgs/msg/Quaternion", x=x, y=y, z=z, w=w)


def _transform(bag: "BagWriter", stamp_ns: int, parent: str, child: str, x: float, y: float, turn: Any) -> Any:
    """Return a TFMessage with one transform."""
    translation = bag.message("geometry_msgs/msg/Vector3", x=x, y=y, z=0.0)
    transform = bag.message("geometry_msgs/msg/Transform", translation=translation, rotation=turn)
    header = bag.header(stamp_ns, parent)
    stamped = bag.message("geometry_msgs/msg/TransformStamped", header=header, child_frame_id=child, transform=transform)
    return bag.message("tf2_msgs/msg/TFMessage", transforms=[stamped])


def _write_mounting(bag: "BagWriter", first: Reading) -> None:
    mounting: Mounting = first.scan.mounting
    sine, cosine = mounting.pose.quaternion()
    turn = _quaternion(bag, cosine, sine, 0.0, 0.0) if mounting.upside_down else _quaternion(bag, 0.0, 0.0, sine, cosine)
    message = _transform(bag, first.stamp_ns, BASE, first.scan.frame_id, mounting.x, mounting.y, turn)
    bag.write("/tf_static", "tf2_msgs/msg/TFMessage", first.stamp_ns, message, latched=True)


def _write_odometry(bag: "BagWriter", reading: Reading) -> None:
    odometry, stamp = reading.odometry, reading.stamp_ns
    turn = _quaternion(bag, 0.0, 0.0, odometry.z, odometry.w)
    bag.write("/tf", "tf2_msgs/msg/TFMessage", stamp, _transform(bag, stamp, ODOM_FRAME, BASE, odometry.x, odometry.y, turn))
    position = bag.message("geometry_msgs/msg/Point", x=odometry.x, y=odometry.y, z=0.0)
    pose = bag.message("geometry_msgs/msg/Pose", position=position, orientation=turn)
    zero = bag.message("geometry_msgs/msg/Vector3", x=0.0, y=0.0, z=0.0)
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
        error = bag.message("geometry_msgs/msg/Vector3", x=odometry.error_m, y=0.0, z=odometry.error_rad)
        stamped = bag.message("geometry_msgs/msg/Vector3Stamped", header=bag.header(stamp, ODOM_FRAME), vector=error)
        bag.write("/odom_error", "geometry_msgs/msg/Vector3Stamped", stamp, stamped)


def _write_scan(bag: "BagWriter", reading: Reading) -> None:
    scan = reading.scan
    angle_max = float(np.float32(scan.angle_min + (len(scan) - 1) * scan.angle_increment))
    message = bag.message(
        "sensor_msgs/msg/LaserScan",
        header=bag.header(reading.stamp_ns, scan.frame_id),
        angle_min=scan.angle_min,
        angle_max=angle_max if math.isfinite(angle_max) else 0.0,
        angle_increment=scan.angle_increment,
        time_increment=scan.time_increment,
        scan_time=0.0,
        range_min=scan.range_min,
        range_max=scan.range_max,
        ranges=scan.ranges,
        intensities=np.empty(0, dtype=np.float32),
    )
    bag.write("/scan", "sensor_msgs/msg/LaserScan", reading.stamp_ns, message)
