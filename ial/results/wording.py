"""A pose and its bounds in words, for people; digits are rounded so that what is said stays true."""

import math

from ial.lidar.estimate import Hypothesis
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
    turns = 2.0 * math.pi * round((0.5 * sum(hypothesis.theta) - pose.theta) / (2.0 * math.pi))
    low, high = (math.degrees(bound - turns) for bound in hypothesis.theta)
    parts = (
        f"x {_within(pose.x, *hypothesis.x, 2)} m",
        f"y {_within(pose.y, *hypothesis.y, 2)} m",
        f"θ {_within(math.degrees(pose.theta), low, high, 1)}°",
    )
    return ", ".join(parts)


def _within(value: float, lower: float, upper: float, digits: int) -> str:
    """Return "value ± error", both rounded, so that the bounds lie within, but for a millionth of the last digit."""
    shown = round(value, digits)
    scale = 10.0**digits
    error = math.ceil(max(upper - shown, shown - lower) * scale - 1e-6) / scale
    return f"{shown:.{digits}f} ± {error:.{digits}f}".replace("-", "−")
