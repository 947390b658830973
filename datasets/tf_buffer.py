"""`TransformBuffer`: the transforms of a recording, looked up without ROS.

Transforms are target-then-source: the edge from a parent frame to a child frame is ``T_parent_child``.
"""

import math
from collections import deque
from dataclasses import dataclass

from ial.datasets.odometry import Odometry
from ial.datasets.odometry_buffer import OdometryBuffer

ODOM_FRAME = "odom"

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]


def _multiply(first: Quaternion, second: Quaternion) -> Quaternion:
    """Return the Hamilton product of two quaternions (x, y, z, w)."""
    ax, ay, az, aw = first
    bx, by, bz, bw = second
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def _conjugate(turn: Quaternion) -> Quaternion:
    return -turn[0], -turn[1], -turn[2], turn[3]


def rotate(turn: Quaternion, vector: Vector) -> Vector:
    """Return a vector turned by a quaternion of any length but zero."""
    x, y, z, _ = _multiply(_multiply(turn, (*vector, 0.0)), _conjugate(turn))
    square = math.fsum(part * part for part in turn)
    return x / square, y / square, z / square


@dataclass(frozen=True)
class Transform:
    """A transform in space.

    Parameters
    ----------
    translation
        (x, y, z) in metres.
    quaternion
        (x, y, z, w).
    """

    translation: Vector
    quaternion: Quaternion

    @property
    def valid(self) -> bool:
        """Whether all numbers are finite and the quaternion is not zero."""
        return all(map(math.isfinite, (*self.translation, *self.quaternion))) and any(self.quaternion)

    def __matmul__(self, other: "Transform") -> "Transform":
        x, y, z = rotate(self.quaternion, other.translation)
        a, b, c = self.translation
        return Transform((a + x, b + y, c + z), _multiply(self.quaternion, other.quaternion))

    def inverse(self) -> "Transform":
        """Return the transform in the other direction."""
        back = _conjugate(self.quaternion)
        x, y, z = rotate(back, self.translation)
        return Transform((-x, -y, -z), back)


class TransformBuffer:
    """The edges of the tree of frames.

    An edge is *fixed* if all its samples are equal, whether they came on ``/tf_static`` or ``/tf``. Only edges that leave the frame
    ``odom`` are kept sample by sample, so that a robot with many joints does not fill the memory.
    """

    def __init__(self) -> None:
        self._first: dict[tuple[str, str], Transform] = {}
        self._moving: set[tuple[str, str]] = set()
        self._odometry: dict[str, OdometryBuffer] = {}

    def add(self, parent: str, child: str, stamp_ns: int, transform: Transform) -> None:
        """Take a sample of the edge ``T_parent_child``; one that is not finite is left out."""
        if not transform.valid:
            return
        if self._first.setdefault((parent, child), transform) != transform:
            self._moving.add((parent, child))
        if parent == ODOM_FRAME:
            buffer = self._odometry.setdefault(child, OdometryBuffer())
            odometry = Odometry(*transform.translation[:2], *transform.quaternion[2:])
            if odometry.valid:
                buffer.add(stamp_ns, odometry)

    @property
    def edges(self) -> list[tuple[str, str]]:
        """The edges (parent, child) that have samples."""
        return sorted(self._first)

    @property
    def frames(self) -> set[str]:
        """The names of all frames."""
        return {frame for edge in self._first for frame in edge}

    def odometry(self, base: str) -> OdometryBuffer | None:
        """Return ``T_odom_base``, projected to the plane; None if there is no such edge."""
        return self._odometry.get(base)

    def _path(self, target: str, source: str) -> list[tuple[str, str]] | None:
        """Return the steps (from, to) that lead from one frame to another, fixed edges only; None if there is no such path."""
        neighbours: dict[str, list[str]] = {}
        for parent, child in self.edges:
            if (parent, child) not in self._moving:
                neighbours.setdefault(parent, []).append(child)
                neighbours.setdefault(child, []).append(parent)
        came_from = {target: target}
        queue = deque([target])
        while queue and source not in came_from:
            frame = queue.popleft()
            for following in neighbours.get(frame, []):
                if following not in came_from:
                    came_from[following] = frame
                    queue.append(following)
        if source not in came_from:
            return None
        steps = []
        frame = source
        while frame != target:
            steps.append((came_from[frame], frame))
            frame = came_from[frame]
        return steps[::-1]

    def fixed(self, target: str, source: str) -> Transform | None:
        """Return ``T_target_source`` along fixed edges, or None if no such path leads there."""
        if target == source:
            return Transform((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))
        steps = self._path(target, source)
        if steps is None:
            return None
        edges = [self._first[step] if step in self._first else self._first[step[::-1]].inverse() for step in steps]
        product = edges[0]
        for edge in edges[1:]:
            product = product @ edge
        return product
