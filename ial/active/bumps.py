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

    def shortened(self, moved: Pose, turns_rad: FloatArray, ways_m: FloatArray) -> FloatArray:
        """Return ways that end before they lead to a bump; −1 for those that begin at one.

        Parameters
        ----------
        moved
            Where the robot is, in the frame of its start.
        turns_rad, ways_m
            How far it would go after some turns.
        """
        for x, y in self._points:
            way, angle = math.hypot(x - moved.x, y - moved.y), math.atan2(y - moved.y, x - moved.x) - moved.theta
            ahead, aside = way * np.cos(turns_rad - angle), np.abs(way * np.sin(turns_rad - angle))
            reach = _ASIDE * self._radius_m
            left = ahead - np.sqrt(np.maximum(reach**2 - aside**2, 0.0))
            meets = (ahead > 0.0) & (aside < reach) & (left < ways_m)
            ways_m = np.where(meets, np.where(left > 0.0, left, -1.0), ways_m)
        return ways_m
