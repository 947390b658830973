"""ROS messages of what a recording and a result hold, by type."""

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from ial.datasets.odometry import Odometry
from ial.datasets.scan import LaserScan, Mounting
from ial.maps.grids.grid_message import grid_to_message_fields
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose

if TYPE_CHECKING:
    from ial.datasets.bag_writer import BagWriter  # rosbags is slow to import

ODOMETRY_TYPE = "nav_msgs/msg/Odometry"
LOOKED_UP_TOPIC = "/odom_at_scan"  # written by `convert`: the odometry at a first or last beam, where that is no message
ERROR_TYPE = "geometry_msgs/msg/Vector3Stamped"
ERROR_TOPIC = "/odom_error"  # written by `convert`: how far an interpolated odometry may be off, metres in x and radians in z


def vector(bag: "BagWriter", x: float, y: float, z: float = 0.0) -> Any:
    """Return a geometry_msgs/Vector3."""
    return bag.message("geometry_msgs/msg/Vector3", x=x, y=y, z=z)


def point(bag: "BagWriter", x: float, y: float) -> Any:
    """Return a geometry_msgs/Point on the floor."""
    return bag.message("geometry_msgs/msg/Point", x=x, y=y, z=0.0)


def rotation(bag: "BagWriter", x: float, y: float, z: float, w: float) -> Any:
    """Return a geometry_msgs/Quaternion."""
    return bag.message("geometry_msgs/msg/Quaternion", x=x, y=y, z=z, w=w)


def pose_message(bag: "BagWriter", pose: Pose) -> Any:
    """Return a geometry_msgs/Pose."""
    z, w = pose.quaternion()
    return bag.message("geometry_msgs/msg/Pose", position=point(bag, pose.x, pose.y), orientation=rotation(bag, 0.0, 0.0, z, w))


def stamped_pose(bag: "BagWriter", stamp_ns: int, frame: str, pose: Pose) -> Any:
    """Return a geometry_msgs/PoseStamped."""
    return bag.message("geometry_msgs/msg/PoseStamped", header=bag.header(stamp_ns, frame), pose=pose_message(bag, pose))


def path_message(bag: "BagWriter", stamp_ns: int, frame: str, poses: Iterable[Any]) -> Any:
    """Return a nav_msgs/Path of stamped poses."""
    return bag.message("nav_msgs/msg/Path", header=bag.header(stamp_ns, frame), poses=list(poses))


def transform(bag: "BagWriter", stamp_ns: int, parent: str, child: str, pose: Pose) -> Any:
    """Return a geometry_msgs/TransformStamped, ``T_parent_child``."""
    z, w = pose.quaternion()
    return stamped_transform(bag, stamp_ns, parent, child, pose.x, pose.y, rotation(bag, 0.0, 0.0, z, w))


def mounting_transform(bag: "BagWriter", stamp_ns: int, base: str, laser: str, mounting: Mounting) -> Any:
    """Return a geometry_msgs/TransformStamped of where the lidar sits; one that hangs upside down is rolled by π."""
    z, w = mounting.pose.quaternion()
    turn = rotation(bag, w, z, 0.0, 0.0) if mounting.upside_down else rotation(bag, 0.0, 0.0, z, w)
    return stamped_transform(bag, stamp_ns, base, laser, mounting.x, mounting.y, turn)


def stamped_transform(bag: "BagWriter", stamp_ns: int, parent: str, child: str, x: float, y: float, turn: Any) -> Any:
    """Return a geometry_msgs/TransformStamped of a shift and a geometry_msgs/Quaternion."""
    content = bag.message("geometry_msgs/msg/Transform", translation=vector(bag, x, y), rotation=turn)
    header = bag.header(stamp_ns, parent)
    return bag.message("geometry_msgs/msg/TransformStamped", header=header, child_frame_id=child, transform=content)


def transforms_message(bag: "BagWriter", transforms: Iterable[Any]) -> Any:
    """Return a tf2_msgs/TFMessage."""
    return bag.message("tf2_msgs/msg/TFMessage", transforms=list(transforms))


def odometry_message(bag: "BagWriter", stamp_ns: int, frame: str, child: str, odometry: Odometry) -> Any:
    """Return a nav_msgs/Odometry; it does not say how sure it is, nor how fast the robot moves."""
    position, turn = point(bag, odometry.x, odometry.y), rotation(bag, 0.0, 0.0, odometry.z, odometry.w)
    pose = bag.message("geometry_msgs/msg/Pose", position=position, orientation=turn)
    zero = vector(bag, 0.0, 0.0)
    twist = bag.message("geometry_msgs/msg/Twist", linear=zero, angular=zero)
    return bag.message(
        ODOMETRY_TYPE,
        header=bag.header(stamp_ns, frame),
        child_frame_id=child,
        pose=bag.message("geometry_msgs/msg/PoseWithCovariance", pose=pose, covariance=np.zeros(36)),
        twist=bag.message("geometry_msgs/msg/TwistWithCovariance", twist=twist, covariance=np.zeros(36)),
    )


def scan_message(bag: "BagWriter", scan: LaserScan) -> Any:
    """Return a sensor_msgs/LaserScan."""
    last = float(np.float32(scan.angle_min + (len(scan) - 1) * scan.angle_increment))
    return bag.message(
        "sensor_msgs/msg/LaserScan",
        header=bag.header(scan.stamp_ns, scan.frame_id),
        angle_min=scan.angle_min,
        angle_max=last if math.isfinite(last) else 0.0,
        angle_increment=scan.angle_increment,
        time_increment=scan.time_increment,
        scan_time=0.0,
        range_min=scan.range_min,
        range_max=scan.range_max,
        ranges=scan.ranges,
        intensities=np.empty(0, dtype=np.float32),
    )


def map_message(bag: "BagWriter", stamp_ns: int, frame: str, grid: OccupancyGrid) -> Any:
    """Return a nav_msgs/OccupancyGrid; the message rounds the resolution to float32."""
    fields = grid_to_message_fields(grid)
    header = bag.header(stamp_ns, frame)
    info = bag.message(
        "nav_msgs/msg/MapMetaData",
        map_load_time=header.stamp,
        resolution=fields.resolution,
        width=fields.width,
        height=fields.height,
        origin=pose_message(bag, grid.origin),
    )
    return bag.message("nav_msgs/msg/OccupancyGrid", header=header, info=info, data=fields.data)
