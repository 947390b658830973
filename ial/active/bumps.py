"""`Bumps`: where a robot has touched something that the map does not show, and which ways lead there again."""

import math

import numpy as np
import numpy.typing as npt

from ial.pose import Pose

FloatArray = npt.NDArray[np.float64]

_ASIDE = 1.2  # radii beside a bump that are kept


class Bumps:
    """Bumps in the frame of the robot's start, as far as its odometry knows. What they rule out is preferred, and not proved.

    Parameters
    ----------
    radius_m
        The radius of the robot.
    """

    def __init__(self, radius_m: float) -> None:
        self._radius_m = radius_m
        self._points: list[tuple[float, float]] = []

    def __repr__(self) -> str:
        return f"<Bumps: {len(self._points)}>"

    def add(self, moved: Pose) -> None:
        """Take note of a bump straight ahead of where the robot stopped."""
        self._points.append((moved.x + self._radius_m * math.cos(moved.theta), moved.y + self._radius_m * math.sin(moved.theta)))

    def limits_m(self, moved: Pose, turns_rad: FloatArray) -> FloatArray:
        """Return how far it can go after some turns before it comes to a bump; infinite without one, negative where it stands at one.

        Parameters
        ----------
        moved
            Where the robot is, in the frame of its start.
        turns_rad
            By how much it turns first.
        """
        limits = np.full(len(turns_rad), math.inf)
        for x, y in self._points:
            way, angle = math.hypot(x - moved.x, y - moved.y), math.atan2(y - moved.y, x - moved.x) - moved.theta
            ahead, aside = way * np.cos(turns_rad - angle), np.abs(way * np.sin(turns_rad - angle))
            reach = _ASIDE * self._radius_m
            left = ahead - np.sqrt(np.maximum(reach**2 - aside**2, 0.0))
            limits = np.where((ahead > 0.0) & (aside < reach), np.minimum(limits, left), limits)
        return limits
