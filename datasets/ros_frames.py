"""What a bag's transforms and odometry say about the robot: the mounting of a laser, and the odometry at a stamp."""

import math
from typing import Any

from ial.datasets.odometry import Odometry
from ial.datasets.odometry_buffer import OdometryBuffer
from ial.datasets.scan import Mounting
from ial.datasets.tf_buffer import Transform, TransformBuffer, rotate
from ial.errors import RecordingError

BASE_FRAMES = ("base_link", "base_footprint", "base")
_MAX_TILT = math.radians(2.0)


def stamp_of(message: Any) -> int:
    """Return the header's stamp in nanoseconds."""
    return int(message.header.stamp.sec) * 10**9 + int(message.header.stamp.nanosec)


def frame_name(name: str) -> str:
    """Return a frame's name without the leading slash that the first tf put there."""
    return str(name).removeprefix("/")


def take_transforms(buffer: TransformBuffer, message: Any) -> None:
    """Add the transforms of one TFMessage to a buffer."""
    for sample in message.transforms:
        shift, turn = sample.transform.translation, sample.transform.rotation
        transform = Transform((shift.x, shift.y, shift.z), (turn.x, turn.y, turn.z, turn.w))
        buffer.add(frame_name(sample.header.frame_id), frame_name(sample.child_frame_id), stamp_of(sample), transform)


def odometry_of(message: Any) -> Odometry:
    """Return the pose of a nav_msgs/Odometry message, projected to the plane (the part of the rotation that turns about z)."""
    position, turn = message.pose.pose.position, message.pose.pose.orientation
    return Odometry(position.x, position.y, turn.z, turn.w)


def odometry_from_tf(buffer: TransformBuffer, name: str) -> tuple[OdometryBuffer, str]:
    """Return the odometry in the edge from the frame ``odom`` to the robot, and the name of the robot's frame.

    Raises
    ------
    RecordingError
        If tf has no such edge.
    """
    for base in BASE_FRAMES:
        odometry = buffer.odometry(base)
        if odometry is not None:
            return odometry, base
    edges = ", ".join(f"{parent} → {child}" for parent, child in buffer.edges[:20]) or "none"
    raise RecordingError(
        f"{name}: no odometry: there is no nav_msgs/Odometry topic, and tf has no transform odom → base_link (its transforms: {edges}); "
        "record /odom or /tf too"
    )


def mounting_of(buffer: TransformBuffer, base: str, laser: str, name: str) -> Mounting:
    """Return where a laser sits on the robot.

    Parameters
    ----------
    buffer
        The transforms of the recording.
    base, laser
        The frames of the robot and of the scan.
    name
        The recording's name, for messages.

    Raises
    ------
    RecordingError
        If no fixed transforms lead from base to laser, or if the laser is tilted by more than 2°.
    """
    transform = buffer.fixed(base, laser)
    if transform is None:
        raise RecordingError(
            f"{name}: where the laser sits on the robot is unknown: no fixed transforms lead from {base} to {laser}; "
            "say it with --laser-pose X Y YAW (metres and radians in base_link)"
        )
    x, y, _ = transform.translation
    if transform.quaternion[:2] == (0.0, 0.0):
        return Mounting(x, y, 2.0 * math.atan2(*transform.quaternion[2:]))
    if transform.quaternion[2:] == (0.0, 0.0):
        return Mounting(x, y, 2.0 * math.atan2(transform.quaternion[1], transform.quaternion[0]), upside_down=True)
    forward, axis = rotate(transform.quaternion, (1.0, 0.0, 0.0)), rotate(transform.quaternion, (0.0, 0.0, 1.0))
    tilt = math.atan2(math.hypot(axis[0], axis[1]), abs(axis[2]))
    if tilt > _MAX_TILT:
        raise RecordingError(
            f"{name}: the laser {laser} is tilted by {math.degrees(tilt):.2f}° against {base}; a planar lidar may be tilted by at most 2°. "
            "If that is a mistake in tf, give the right pose with --laser-pose X Y YAW"
        )
    return Mounting(x, y, math.atan2(forward[1], forward[0]), upside_down=axis[2] < 0.0)
