"""Small recordings, made on the spot."""

import math
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

from ial.datasets.bag_writer import BagWriter
from ial.datasets.odometry import Odometry
from ial.datasets.odometry_path import OdometryPath
from ial.datasets.recording import Reading, Recording
from ial.datasets.scan import LaserScan, Mounting
from ial.pose import Pose

SECOND = 10**9

Canonical = tuple[object, ...]


def canonical(reading: Reading) -> Canonical:
    """Return all bits of a reading that a localizer sees, but not its index."""
    scan, odometry = reading.scan, reading.odometry
    numbers = (scan.angle_min, scan.angle_increment, scan.range_min, scan.range_max, scan.time_increment, *vars(scan.mounting).values())
    pose = (odometry.x, odometry.y, odometry.pose, odometry.error_m, odometry.error_rad)
    sweep = None if scan.sweep is None else bits(scan.sweep)
    return (reading.stamp_ns, scan.ranges.tobytes(), numbers, pose, scan.frame_id, sweep, bits(reading.messages))


def bits(path: OdometryPath) -> Canonical:
    """Return all bits of a path of odometry."""
    return (path.stamps_ns.tobytes(), path.numbers.tobytes())


@pytest.fixture
def canonical_steps() -> Callable[[Recording], list[Canonical]]:
    """Return a function that lists the canonical steps of a recording."""
    return lambda recording: [canonical(reading) for reading in recording.readings()]


def synthetic_readings(count: int = 12, mounting: Mounting | None = None) -> Iterator[Reading]:
    """Yield scans with every kind of beam, at poses all around the circle; messages come between them and during them."""
    random = np.random.default_rng(5)

    def somewhere(*errors: float) -> Odometry:
        return Odometry.of(Pose(*random.uniform(-40.0, 40.0, 2).tolist(), float(random.uniform(-math.pi, math.pi))), *errors)

    messages = OdometryPath.of()
    for index in range(count):
        ranges = random.uniform(0.0, 12.0, 40).astype(np.float32)
        ranges[:6] = [math.nan, math.inf, -math.inf, 0.0, 12.0, 0.01]
        stamp = index * SECOND // 3
        at = somewhere(*([0.01, 0.02] if index % 3 == 1 else []))  # some are interpolated
        during = [(stamp + ms * 10**6, somewhere()) for ms in (1, 3)]
        end = stamp + round(39 * SECOND * float(np.float32(1e-4)))
        sweep = None if index == count - 1 else OdometryPath.of([(stamp, at), *during, (end, somewhere(0.001, 0.002))])
        limits, place = (-2.0, 0.1, 0.05, 10.0, 1e-4), mounting or Mounting(0.2, -0.1, 0.3)
        yield Reading(index, stamp, at, LaserScan(stamp, ranges, *limits, mounting=place, sweep=sweep), messages)
        later = [(stamp + ms * 10**6, somewhere()) for ms in (50, 120, 300)]
        messages = OdometryPath.of([*during, *later])


class Bag:
    """Writes messages of a robot into a bag, one kind at a time."""

    def __init__(self, path: Path) -> None:
        self.writer = BagWriter(path)
        self.path = path
        self._written = 0

    def _write(self, topic: str, kind: str, message: object, latched: bool = False) -> None:
        """Write a message a microsecond after the one before, whatever its header says: the order of a bag is the order of receiving."""
        self._written += 1
        self.writer.write(topic, kind, SECOND + 1000 * self._written, message, latched)

    def scan(self, stamp: float, topic: str = "/scan", frame: str = "laser", **changes: object) -> None:
        """Write a scan of three beams."""
        fields: dict[str, object] = {
            "angle_min": -0.5,
            "angle_max": 0.5,
            "angle_increment": 0.5,
            "time_increment": 0.0,
            "scan_time": 0.0,
            "range_min": 0.1,
            "range_max": 10.0,
            "ranges": np.array([1.0, 2.0, 3.0], dtype=np.float32),
            "intensities": np.empty(0, dtype=np.float32),
            **changes,
        }
        at = round(stamp * SECOND)
        kind = "sensor_msgs/msg/LaserScan"
        self._write(topic, kind, self.writer.message(kind, header=self.writer.header(at, frame), **fields))

    def odometry(self, stamp: float, x: float = 0.0, y: float = 0.0, theta: float = 0.0, topic: str = "/odom") -> None:
        """Write an odometry message."""
        at, make = round(stamp * SECOND), self.writer.message
        position = make("geometry_msgs/msg/Point", x=x, y=y, z=0.0)
        turn = make("geometry_msgs/msg/Quaternion", x=0.0, y=0.0, z=math.sin(theta / 2), w=math.cos(theta / 2))
        zero = make("geometry_msgs/msg/Vector3", x=0.0, y=0.0, z=0.0)
        message = make(
            "nav_msgs/msg/Odometry",
            header=self.writer.header(at, "odom"),
            child_frame_id="base_link",
            pose=make(
                "geometry_msgs/msg/PoseWithCovariance",
                pose=make("geometry_msgs/msg/Pose", position=position, orientation=turn),
                covariance=np.zeros(36),
            ),
            twist=make(
                "geometry_msgs/msg/TwistWithCovariance",
                twist=make("geometry_msgs/msg/Twist", linear=zero, angular=zero),
                covariance=np.zeros(36),
            ),
        )
        self._write(topic, "nav_msgs/msg/Odometry", message)

    def transform(
        self,
        stamp: float,
        parent: str,
        child: str,
        translation: tuple[float, float, float] = (0.0, 0.0, 0.0),
        quaternion: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 1.0),
        topic: str = "/tf",
    ) -> None:
        """Write a transform."""
        at, make = round(stamp * SECOND), self.writer.message
        shift = make("geometry_msgs/msg/Vector3", **dict(zip("xyz", translation, strict=True)))
        turn = make("geometry_msgs/msg/Quaternion", **dict(zip("xyzw", quaternion, strict=True)))
        transform = make("geometry_msgs/msg/Transform", translation=shift, rotation=turn)
        header = self.writer.header(at, parent)
        stamped = make("geometry_msgs/msg/TransformStamped", header=header, child_frame_id=child, transform=transform)
        self._write(topic, "tf2_msgs/msg/TFMessage", make("tf2_msgs/msg/TFMessage", transforms=[stamped]))

    def mounting(self, child: str = "laser", **changes: object) -> None:
        """Write where a laser sits."""
        self.transform(0.0, "base_link", child, topic="/tf_static", **changes)  # type: ignore[arg-type]

    def __enter__(self) -> "Bag":
        self.writer.__enter__()
        return self

    def __exit__(self, *fault: object) -> None:
        self.writer.__exit__(*fault)  # type: ignore[arg-type]


@pytest.fixture(params=["mcap", "bag"])
def bag(request: pytest.FixtureRequest, tmp_path: Path) -> Bag:
    """A bag to write to, once of each kind."""
    return Bag(tmp_path / f"test.{request.param}")


@pytest.fixture
def readings() -> Callable[..., Iterator[Reading]]:
    """Return the function that makes synthetic scans."""
    return synthetic_readings
