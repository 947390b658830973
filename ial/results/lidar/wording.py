"""A pose and its bounds in words, for people; digits are rounded so that what is said stays true."""

import math
from decimal import ROUND_CEILING, Decimal

from ial.contractors.intervals.interval import Interval
from ial.contractors.intervals.trigonometric import PI_LOWER, PI_UPPER
from ial.lidar.hypothesis import Hypothesis
from ial.pose import Pose


def pose_text(pose: Pose, hypothesis: Hypothesis) -> str:
    """Return a pose as "x … ± … m, y … ± … m, θ … ± …°", where the hypothesis lies within what is said.

    Parameters
    ----------
    pose
        A pose in the hypothesis, such as its centre.
    hypothesis
        The bounds.
    """
    pi = Interval(PI_LOWER, PI_UPPER)
    turns = round((0.5 * sum(hypothesis.theta) - pose.theta) / (2.0 * math.pi))
    heading = (Interval(*hypothesis.theta) - 2.0 * turns * pi) * 180.0 / pi
    parts = (
        f"x {_within(pose.x, *hypothesis.x, 2)} m",
        f"y {_within(pose.y, *hypothesis.y, 2)} m",
        f"θ {_within(math.degrees(pose.theta), heading.lower, heading.upper, 1)}°",
    )
    return ", ".join(parts)


def _within(value: float, lower: float, upper: float, digits: int) -> str:
    """Return "value ± error", both rounded, so that the bounds lie within."""
    last = Decimal(1).scaleb(-digits)
    shown = Decimal(value).quantize(last)
    error = max(Decimal(upper) - shown, shown - Decimal(lower)).quantize(last, ROUND_CEILING)
    return f"{shown} ± {error}".replace("-", "−")
