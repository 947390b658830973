"""`Motion`: an interval of SE(2), and `MotionBounds`, which turn odometry into one."""

import dataclasses
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import numpy.typing as npt

from ial.contractors.intervals.angle import contains_angle, wrap_angle
from ial.contractors.intervals.arithmetic import add
from ial.contractors.rounding import check_rounding
from ial.datasets import motion_boxes
from ial.datasets.odometry import Odometry
from ial.datasets.odometry_path import OdometryPath
from ial.keys.key import key
from ial.keys.kind import Maybe, Number
from ial.keys.record import Part, Record
from ial.pose import Pose


@dataclass(frozen=True, eq=False)
class Motion:
    """All motions within a box: the base pose moves by (dx, dy, dtheta), given in the frame of the earlier base pose.

    Parameters
    ----------
    lower, upper
        Bounds of (dx, dy, dtheta) in metres, metres, radians, float64 of shape (3,). The angle's lower bound lies in [-π, π] (rounded
        outward) and its upper bound may exceed π; a full circle is exactly [-π, π], rounded outward.
    """

    lower: npt.NDArray[np.float64]
    upper: npt.NDArray[np.float64]

    def __post_init__(self) -> None:
        lower, upper = np.array(self.lower, dtype=np.float64), np.array(self.upper, dtype=np.float64)
        if lower.shape != (3,) or upper.shape != (3,) or not (lower <= upper).all():
            raise ValueError(f"motion from {lower} to {upper}; give three ordered bounds each")
        lower[2], upper[2] = wrap_angle(lower[2], upper[2])
        for name, bound in (("lower", lower), ("upper", upper)):
            bound.setflags(write=False)
            object.__setattr__(self, name, bound)

    def __repr__(self) -> str:
        x, y, theta = (f"[{low}, {high}]" for low, high in zip(self.lower.tolist(), self.upper.tolist(), strict=True))
        return f"<Motion: x {x} m, y {y} m, θ {theta} rad>"

    @classmethod
    def identity(cls) -> "Motion":
        """Return the motion of a robot that stands still."""
        return cls(np.zeros(3), np.zeros(3))

    @classmethod
    def unknown(cls) -> "Motion":
        """Return all motions: the entire plane and the full circle."""
        return cls(np.full(3, -np.inf), np.full(3, np.inf))

    @classmethod
    def between(cls, previous: Odometry, now: Odometry) -> "Motion":
        """Return a box around ``T_odom_previous⁻¹ @ T_odom_now``, for every pair of poses within the two readings' error bounds."""
        check_rounding()
        difference = np.empty((3, 2))
        motion_boxes.difference(np.array(previous.numbers), np.array(now.numbers), difference)
        return cls(difference[:, 0], difference[:, 1])

    @classmethod
    def around(cls, delta: Pose) -> "Motion":
        """Return the box that is one motion."""
        values = np.array([delta.x, delta.y, delta.theta])
        return cls(values, values)

    def compose(self, later: "Motion") -> "Motion":
        """Return a box around this motion followed by a later one: ``d = d1 + R(θ1) d2, θ = θ1 + θ2``."""
        check_rounding()
        composed = np.empty((3, 2))
        motion_boxes.compose(self._rows(), later._rows(), composed)
        return Motion(composed[:, 0], composed[:, 1])

    def contains(self, delta: Pose) -> bool:
        """Return whether a motion lies in the box, its angle taken modulo 2π."""
        at = (delta.x, delta.y)
        if not all(low <= value <= high for low, value, high in zip(self.lower[:2], at, self.upper[:2], strict=True)):
            return False
        return bool(contains_angle(self.lower[2], self.upper[2], delta.theta))

    def _rows(self) -> npt.NDArray[np.float64]:
        return np.stack([self.lower, self.upper], axis=1)


_BOUND = Number(least=0.0)
_BASE_IS_GONE = (
    "has become two: per_scan, added once from each scan to the next, and per_message, added for each odometry message between them; "
    "give the old value as per_scan if it was measured from scan to scan, and as per_message if it is of one message"
)


@dataclass(frozen=True)
class ErrorBound(Record):
    """How far a recorded motion may be from the true one, for each message of the odometry and for each scan.

    From one message to the next the bound is ``per_message + per_metre · |translation| + per_radian · |rotation| + per_second · seconds``;
    `per_scan` is added once from scan to scan. All in metres for a translation, and in radians for a rotation.
    """

    gone = {"base": _BASE_IS_GONE}

    per_message: float = field(default=0.0, metadata=key(_BOUND, "added for each odometry message: what is rounded, or jitters", "{}"))
    per_metre: float = field(default=0.0, metadata=key(_BOUND, "added for each metre travelled", "{}/m"))
    per_radian: float = field(default=0.0, metadata=key(_BOUND, "added for each radian turned", "{}/rad"))
    per_second: float = field(
        default=0.0,
        metadata=key(_BOUND, "added for each second: what happens though the wheels say nothing, and where messages are missing", "{}/s"),
    )
    per_scan: float = field(
        default=0.0,
        metadata=key(_BOUND, "added once from scan to scan: what does not accumulate, such as a stamp that is late", "{}"),
    )


@dataclass(frozen=True)
class MotionBounds(Record):
    """How far the recorded odometry may be from the true motion.

    The defaults hold for 98.5 to 100 % of the recorded steps of three robots whose corrected trajectories are known (Intel, Freiburg 079,
    ACES), one of them with poor odometry.
    """

    translation: ErrorBound = field(
        default_factory=lambda: ErrorBound(0.0, 0.05, 0.05, 0.01, 0.15), metadata=key(Part(ErrorBound), "bound of dx, and of dy", "m")
    )
    rotation: ErrorBound = field(
        default_factory=lambda: ErrorBound(0.0, 0.05, 0.25, 0.01, 0.1), metadata=key(Part(ErrorBound), "bound of the turn dθ", "rad")
    )
    sideways: ErrorBound | None = field(
        default=None,
        metadata=key(
            Maybe(Part(ErrorBound)),
            "bound of dy alone, for a robot whose wheels do not let it drive sideways; null takes that of `translation`, as for an"
            " omnidirectional drive; of its keys, those that are left out are 0. It must cover what a turn between two messages does to dy",
            "m",
        ),
    )

    @cached_property
    def parts(self) -> npt.NDArray[np.float64]:
        """The five parts of the bounds of dx, dy and dtheta, float64 of shape (3, 5)."""
        rows = (self.translation, self.translation if self.sideways is None else self.sideways, self.rotation)
        parts = np.array([dataclasses.astuple(row) for row in rows])
        parts.setflags(write=False)
        return parts

    def along(self, path: OdometryPath) -> Motion:
        """Return the box of all true motions from the first odometry of a path to its last.

        The pieces from each message to the next are widened by their bounds and composed; the whole is widened by `per_scan`.

        Parameters
        ----------
        path
            At least two odometry readings: those of two scans, and every message between them.

        Raises
        ------
        ValueError
            If there are fewer.
        """
        check_rounding()
        if len(path) < 2:
            raise ValueError(f"a path of {len(path)} odometry messages has no motion; give those of two scans, and all between them")
        moved = np.empty((3, 2))
        motion_boxes.along(path.stamps_ns, path.numbers, self.parts, moved)
        return Motion(moved[:, 0], moved[:, 1])

    def enclose(self, delta: Motion | Pose, seconds: float = 0.0) -> Motion:
        """Return the box of all true motions from one scan to the next, where one message lies between.

        Parameters
        ----------
        delta
            The motion from odometry: a pose in the frame of the earlier one, or a box around it (`Motion.between`).
        seconds
            How long it took.
        """
        check_rounding()
        recorded = Motion.around(delta) if isinstance(delta, Pose) else delta
        box = np.stack([recorded.lower, recorded.upper], axis=1)
        motion_boxes.widen(box, self.parts, seconds)
        once = self.parts[:, motion_boxes.PER_SCAN]
        enclosed = np.array([add(low, high, -half, half) for (low, high), half in zip(box, once, strict=True)])
        return Motion(enclosed[:, 0], enclosed[:, 1])
