"""`LaserScan`: one scan of a planar lidar, with what is known about the rounding of its numbers."""

import math
from dataclasses import dataclass, field
from enum import IntEnum
from typing import Any

import numpy as np
import numpy.typing as npt

from ial.contractors.expressions.functions import add, mul
from ial.contractors.expressions.operation import IntervalArrays
from ial.contractors.intervals.trigonometric import LARGEST_ANGLE
from ial.datasets.odometry import quaternion_heading
from ial.datasets.odometry_path import OdometryPath
from ial.errors import RecordingError
from ial.pose import Pose

LARGEST_BEARING = 0.5 * LARGEST_ANGLE
"""Radians beyond which no bearing lies: with the headings of the laser and the robot added, sines are known up to twice that."""


class BeamClass(IntEnum):
    """What a beam says, by REP-117."""

    HIT = 0
    """The distance of an obstacle."""
    NO_RETURN = 1
    """Nothing within range: +inf, or a number at or above ``range_max``, which is how drivers older than REP-117 report it."""
    TOO_NEAR = 2
    """An obstacle nearer than the sensor can measure: -inf, or a number below ``range_min`` or not above zero."""
    INVALID = 3
    """NaN: no measurement was made."""


@dataclass(frozen=True)
class Mounting:
    """Where the lidar sits on the robot: ``T_base_laser``.

    Parameters
    ----------
    x, y
        Position of the laser in base_link, metres.
    yaw
        Direction of the bearing zero in base_link, radians; moved by some units in the last place to where a quaternion can hold it.
    upside_down
        The lidar hangs head down (a roll of π about its x axis): a bearing β then points to −β.
    """

    x: float = 0.0
    y: float = 0.0
    yaw: float = 0.0
    upside_down: bool = False

    def __post_init__(self) -> None:
        if not all(map(math.isfinite, (self.x, self.y, self.yaw))):
            raise RecordingError(
                f"the laser's pose on the robot is ({self.x}, {self.y}, {self.yaw}); give finite numbers with --laser-pose"
            )
        object.__setattr__(self, "yaw", quaternion_heading(self.yaw))

    @property
    def pose(self) -> Pose:
        """The transform ``T_base_laser`` of points whose bearings have been reversed where `upside_down` says so."""
        return Pose(self.x, self.y, self.yaw)


@dataclass(frozen=True, eq=False)
class LaserScan:
    """One scan: the numbers of ``sensor_msgs/LaserScan`` in its own precision, and the mounting.

    All lengths and angles are rounded to float32, so that every file format yields the same bits.

    Parameters
    ----------
    stamp_ns
        Time of the first beam, nanoseconds.
    ranges
        Distances in metres, float32 of shape (n,); NaN and infinities as REP-117 defines them.
    angle_min
        Bearing of the first beam in the laser's frame, radians.
    angle_increment
        Step from beam to beam, radians; negative for a lidar that turns clockwise.
    range_min, range_max
        The sensor's limits, metres; `range_max` may be infinite.
    time_increment
        Time from beam to beam, seconds; may be negative.
    mounting
        Where the lidar sits on the robot.
    frame_id
        Name of the laser's frame.
    sweep
        The odometry at the first beam, at every message during the scan, and at the last beam; None if it is not known. The beams' times
        are evenly spread over it.

    Raises
    ------
    RecordingError
        If there are no beams, if two beams share one bearing (zero increment), or if the angles, the limits or the sweep make no sense.
        The text holds no numbers: readers count skipped scans by it.
    """

    stamp_ns: int
    ranges: npt.NDArray[np.float32]
    angle_min: float
    angle_increment: float
    range_min: float = 0.0
    range_max: float = np.inf
    time_increment: float = 0.0
    mounting: Mounting = field(default_factory=Mounting)
    frame_id: str = "laser"
    sweep: OdometryPath | None = None

    def __post_init__(self) -> None:
        with np.errstate(over="ignore"):
            ranges = np.array(self.ranges, dtype=np.float32)
            for name in ("angle_min", "angle_increment", "range_min", "range_max", "time_increment"):
                object.__setattr__(self, name, float(np.float32(getattr(self, name))))
        ranges.setflags(write=False)
        object.__setattr__(self, "ranges", ranges)
        self._validate()

    def __repr__(self) -> str:
        return (
            f"<LaserScan at {self.stamp_ns} ns: {len(self)} beams from {self.angle_min:.4g} by {self.angle_increment:.4g} rad, "
            f"ranges {self.range_min:g} to {self.range_max:g} m>"
        )

    def _validate(self) -> None:
        if self.ranges.ndim != 1 or not len(self.ranges):
            raise RecordingError("scan without beams")
        if not np.isfinite([self.angle_min, self.angle_increment, self.time_increment]).all():
            raise RecordingError("scan whose angles or times are not finite")
        if not max(abs(self.angle_min), abs(self.angle_min + (len(self.ranges) - 1) * self.angle_increment)) <= LARGEST_BEARING:
            raise RecordingError("scan whose bearings are thousands of turns")
        if self.angle_increment == 0.0 and len(self.ranges) > 1:
            raise RecordingError("scan with an angle increment of zero")
        if not self.range_max > max(self.range_min, 0.0):  # also true of NaN
            raise RecordingError("scan whose range_max does not exceed its range_min")
        if self.sweep is not None and len(self.sweep) < 2:
            raise RecordingError("scan whose sweep is not known at its first and last beam")
        if self.sweep is not None and not np.isfinite(self.sweep.numbers).all():
            raise RecordingError("scan with a sweep that is no motion: not finite")

    def __len__(self) -> int:
        return len(self.ranges)

    @property
    def end_ns(self) -> int:
        """Time of the last beam, nanoseconds."""
        return last_beam_ns(self.stamp_ns, self.time_increment, len(self.ranges))

    def classes(self) -> npt.NDArray[np.uint8]:
        """Return the `BeamClass` of each beam, uint8 of shape (n,).

        Source: REP-117, which tests the closed interval [range_min, range_max] first. One deviation: a reading at `range_max` or above
        counts as no return.
        """
        ranges = self.ranges
        classes = np.full(len(ranges), BeamClass.HIT, dtype=np.uint8)
        classes[ranges >= self.range_max] = BeamClass.NO_RETURN
        classes[ranges == np.inf] = BeamClass.NO_RETURN
        classes[(ranges < self.range_min) | (ranges <= 0.0)] = BeamClass.TOO_NEAR
        classes[np.isnan(ranges)] = BeamClass.INVALID
        return classes

    def bearings(self) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """Return bounds of each beam's bearing in the frame of `mounting`, (lower, upper), radians, float64 of shape (n,) each.

        They enclose ``angle_min + i · angle_increment`` for every real angle and increment that round to the given float32 numbers; the
        sensor's own bearing error comes on top. For a lidar that hangs upside down the sign is reversed.
        """
        index = np.arange(len(self.ranges), dtype=np.float64)
        first, increment = _read_as(self.angle_min), _read_as(self.angle_increment)
        lower, upper = add.bounds(first, mul.bounds((index, index), increment))
        return (-upper, -lower) if self.mounting.upside_down else (lower, upper)

    def range_slack(self) -> npt.NDArray[np.float64]:
        """Return how far a real number that rounds to each float32 range may lie from it, metres, float64 of shape (n,); NaN stays."""
        with np.errstate(invalid="ignore"):
            return np.abs(np.spacing(self.ranges)).astype(np.float64) * 0.5  # exact


UNTIMED: dict[str, Any] = {"time_increment": 0.0, "sweep": None}  # of a scan whose beams' times are not known


def last_beam_ns(stamp_ns: int, time_increment: float, beams: int) -> int:
    """Return the time of a scan's last beam, nanoseconds; that of its first where the time between beams is no number."""
    step = float(np.float32(time_increment))
    return stamp_ns + round(1e9 * step * (beams - 1)) if math.isfinite(step) else stamp_ns


def _read_as(value: float) -> IntervalArrays:
    """Return bounds of the real numbers that round to a float32."""
    half_step = 0.5 * abs(float(np.spacing(np.float32(value))))
    return add.bounds((np.array(value), np.array(value)), (np.array(-half_step), np.array(half_step)))
