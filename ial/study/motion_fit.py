"""`fitted`: bounds of motion that recorded odometry keeps."""

import dataclasses
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from ial.datasets.motion import ErrorBound, MotionBounds
from ial.datasets.odometry_path import OdometryPath
from ial.pose import Pose

_DIGITS = 2
_LARGEST = 2.0**12  # odometry that needs more than so many times its bounds has none
_HALVINGS = 12


@dataclass(frozen=True, eq=False)
class RecordedStep:
    """The odometry from one processed scan to the next, and what the robot truly did.

    Parameters
    ----------
    paths
        As `Step.recorded`.
    true
        The motion of a reference, in the frame of the earlier pose.
    """

    paths: tuple[OdometryPath, ...]
    true: Pose

    @property
    def messages(self) -> int:
        """How many pieces of odometry it is made of."""
        return sum(len(path) - 1 for path in self.paths)

    def held(self, bounds: MotionBounds) -> tuple[bool, bool]:
        """Return whether bounds keep the true shift, and whether they keep the true turn."""
        moved, *rest = (bounds.along(path) for path in self.paths)
        for later in rest:
            moved = moved.compose(later)
        x, y, theta = moved.lower.tolist()
        return moved.contains(Pose(self.true.x, self.true.y, theta)), moved.contains(Pose(x, y, self.true.theta))


def fitted(bounds: MotionBounds, steps: Sequence[RecordedStep], share: float) -> MotionBounds:
    """Return bounds of which every part is multiplied by one factor: the smallest with which a share of the steps keeps them.

    First the rotation, which does not depend on the translation; then the translation, with that rotation. Parts are rounded
    up to two digits. What is composed does not grow evenly with its parts, so factors are tried.

    Parameters
    ----------
    bounds
        Where to start from.
    steps
        Recorded steps; at least one.
    share
        Of the steps, that the shift keeps, and that the turn keeps.
    """

    def enough(tried: MotionBounds, which: int) -> bool:
        return sum(step.held(tried)[which] for step in steps) >= share * len(steps)

    def turning(factor: float) -> MotionBounds:
        return dataclasses.replace(bounds, rotation=_scaled(bounds.rotation, factor))

    turned = turning(_smallest(lambda factor: enough(turning(factor), 1)))

    def shifting(factor: float) -> MotionBounds:
        sideways = None if bounds.sideways is None else _scaled(bounds.sideways, factor)
        return dataclasses.replace(turned, translation=_scaled(bounds.translation, factor), sideways=sideways)

    return shifting(_smallest(lambda factor: enough(shifting(factor), 0)))


def _smallest(enough: Callable[[float], bool]) -> float:
    """Return a factor that is enough, at most a thousandth above the smallest; the largest that is tried where none is."""
    low, high = 0.0, 1.0
    while high < _LARGEST and not enough(high):
        low, high = high, 2.0 * high
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if enough(middle) else (middle, high)
    return high


def _scaled(bound: ErrorBound, factor: float) -> ErrorBound:
    """Return a bound times a factor, rounded up to two digits."""
    parts = (factor * value for value in dataclasses.astuple(bound))
    return ErrorBound(*(math.ceil(value * 10**_DIGITS - 1e-9) / 10**_DIGITS for value in parts))
