"""`Motion`: an interval of SE(2), and `MotionBounds`, which turn odometry into one."""

import math
from dataclasses import dataclass, field, fields

import numpy as np
import numpy.typing as npt

from ial.contractors.intervals.angle import contains_angle, wrap_angle
from ial.contractors.intervals.arithmetic import add, sub
from ial.contractors.intervals.interval import Interval
from ial.contractors.intervals.rotation import rotate
from ial.contractors.intervals.trigonometric import cos, hypot, sin
from ial.contractors.kernels import kernel
from ial.contractors.rounding import check_rounding
from ial.datasets.odometry import Odometry
from ial.errors import ConfigError
from ial.pose import Pose


@kernel
def _rotate(x, y, heading, rotated):  # type: ignore[no-untyped-def]
    """Turn the point (x, y) by a heading; all are (lower, upper) pairs in arrays, the result goes to `rotated[0:2]`."""
    turned = rotate(*cos(heading[0], heading[1]), *sin(heading[0], heading[1]), x[0], x[1], y[0], y[1])
    rotated[0, 0], rotated[0, 1], rotated[1, 0], rotated[1, 1] = turned


@kernel
def _compose(first, second, composed):  # type: ignore[no-untyped-def]
    """Write first ⊕ second, rows (dx, dy, dtheta) of (lower, upper): ``d = d1 + R(θ1) d2, θ = θ1 + θ2``."""
    _rotate(second[0], second[1], first[2], composed)
    composed[0, 0], composed[0, 1] = add(first[0, 0], first[0, 1], composed[0, 0], composed[0, 1])
    composed[1, 0], composed[1, 1] = add(first[1, 0], first[1, 1], composed[1, 0], composed[1, 1])
    composed[2, 0], composed[2, 1] = add(first[2, 0], first[2, 1], second[2, 0], second[2, 1])


@kernel
def _difference(previous, now, difference):  # type: ignore[no-untyped-def]
    """Write ``previous⁻¹ ⊕ now`` of two interval poses, rows (x, y, theta) of (lower, upper)."""
    position = np.empty((2, 2))
    for axis in range(2):
        position[axis, 0], position[axis, 1] = sub(now[axis, 0], now[axis, 1], previous[axis, 0], previous[axis, 1])
    back = np.array([-previous[2, 1], -previous[2, 0]])
    _rotate(position[0], position[1], back, difference)
    difference[2, 0], difference[2, 1] = sub(now[2, 0], now[2, 1], previous[2, 0], previous[2, 1])


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
        _difference(_pose_box(previous), _pose_box(now), difference)
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
        _compose(self._rows(), later._rows(), composed)
        return Motion(composed[:, 0], composed[:, 1])

    def contains(self, delta: Pose) -> bool:
        """Return whether a motion lies in the box, its angle taken modulo 2π."""
        at = (delta.x, delta.y)
        if not all(low <= value <= high for low, value, high in zip(self.lower[:2], at, self.upper[:2], strict=True)):
            return False
        return bool(contains_angle(self.lower[2], self.upper[2], delta.theta))

    def _rows(self) -> npt.NDArray[np.float64]:
        return np.stack([self.lower, self.upper], axis=1)


def _pose_box(odometry: Odometry) -> npt.NDArray[np.float64]:
    """Return rows (x, y, theta) of (lower, upper): the pose plus and minus its error, rounded outward."""
    pose = odometry.pose
    rows = np.empty((3, 2))
    for row, value, error in zip(rows, (pose.x, pose.y, pose.theta), (odometry.error_m,) * 2 + (odometry.error_rad,), strict=True):
        row[:] = add(value, value, -error, error)
    return rows


@dataclass(frozen=True)
class ErrorBound:
    """A bound that grows with the motion: ``base + per_metre · |translation| + per_radian · |rotation|``.

    Parameters
    ----------
    base
        Metres for a translation, radians for a rotation.
    per_metre
        Added for each metre travelled.
    per_radian
        Added for each radian turned.

    Raises
    ------
    ConfigError
        If a number is negative, infinite or NaN.
    """

    base: float
    per_metre: float = 0.0
    per_radian: float = 0.0

    def __post_init__(self) -> None:
        for part in fields(self):
            value = getattr(self, part.name)
            if not (math.isfinite(value) and value >= 0.0):
                raise ConfigError(f"motion bound {part.name} is {value}; give a finite number that is not negative")

    def at(self, translation_m: float, rotation_rad: float) -> float:
        """Return the bound for a motion, rounded up."""
        # An unknown motion is infinite, so what was travelled is an interval that ends there.
        travelled = self.per_metre * Interval(0.0, translation_m)
        turned = self.per_radian * Interval(0.0, rotation_rad)
        return (self.base + (travelled + turned)).upper


@dataclass(frozen=True)
class MotionBounds:
    """How far one recorded odometry step may be from the true motion.

    The defaults hold for 98 to 99.6 % of the recorded steps of three robots whose corrected trajectories are known (Intel, Freiburg 079,
    ACES), one of them with poor odometry.

    Parameters
    ----------
    translation
        Bound of dx, and of dy, metres.
    rotation
        Bound of dtheta, radians.
    sideways
        Bound of dy alone, metres, for a robot whose wheels do not let it drive sideways; that of `translation` by default, as for an
        omnidirectional drive. It must cover what a turn within a step does to dy.
    """

    translation: ErrorBound = field(default_factory=lambda: ErrorBound(0.12, 0.12, 0.12))
    rotation: ErrorBound = field(default_factory=lambda: ErrorBound(0.08, 0.15, 0.25))
    sideways: ErrorBound | None = None

    def enclose(self, delta: Motion | Pose) -> Motion:
        """Return the box of all true motions, given one recorded odometry step.

        Parameters
        ----------
        delta
            The step from odometry: a pose in the frame of the earlier one, or a box around it (`Motion.between`).
        """
        check_rounding()
        recorded = Motion.around(delta) if isinstance(delta, Pose) else delta
        dx, dy, turn = np.maximum(np.abs(recorded.lower), np.abs(recorded.upper)).tolist()
        distance = hypot(0.0, dx, 0.0, dy)[1]
        shift, twist = self.translation.at(distance, turn), self.rotation.at(distance, turn)
        aside = shift if self.sideways is None else self.sideways.at(distance, turn)
        bounds = zip(recorded.lower.tolist(), recorded.upper.tolist(), (shift, aside, twist), strict=True)
        enclosed = np.array([add(lower, upper, -half, half) for lower, upper, half in bounds])
        return Motion(enclosed[:, 0], enclosed[:, 1])
