"""`Outlook`: which pairs of possible places a robot would tell apart from where it could go."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ial.active.belief import Belief, Groups
from ial.active.common_space import in_robot_frame, moved_along
from ial.active.telling_apart import SENSORS, FloatArray, told_apart
from ial.active.virtual_sensors import VirtualSensors, directions
from ial.pose import Pose

MOST_GROUPS = 24
_SAME_PART = 0.01  # what a pair of one connected part is worth
_TOGETHER = 256  # views whose readings are held at a time


def seen_part(belief: Belief) -> float:
    """Return which part of all directions a lidar sees at once."""
    if belief.scan is None:
        raise AssertionError("a planner is asked after the first scan")
    return min(1.0, abs(belief.scan.angle_increment) * len(belief.scan.ranges) / (2.0 * math.pi))


@dataclass(frozen=True)
class Outlook:
    """What is seen from other places.

    Parameters
    ----------
    sensors
        Of the map.
    same_m
        Readings that differ by at most this (m) are taken as equal.
    """

    sensors: VirtualSensors
    same_m: float

    def worth(self, belief: Belief, groups: Groups, here: Pose, points: Sequence[tuple[float, float]]) -> FloatArray:
        """Return how many pairs of groups would be told apart from each of some points.

        Pairs of the same connected part of the set count little: the robot is localized when one part is left.

        Parameters
        ----------
        belief
            What is known.
        groups
            What is to be told apart.
        here
            One of the possible poses.
        points
            In the grid's frame in metres, if the robot is in that one.
        """
        value = np.where(groups.component[:, None] == groups.component, 1.0 if groups.parts == 1 else _SAME_PART, 1.0)
        ahead, aside = np.array(in_robot_frame(here, points)).reshape(-1, 2).T
        bad = belief.bad_part * seen_part(belief)  # of all directions: there are more beams in each, if they do not look all around
        found = []
        for begin in range(0, len(ahead), _TOGETHER):
            part = slice(begin, begin + _TOGETHER)
            moved = moved_along(groups.poses, ahead[part], aside[part])
            readings = self.sensors.readings(moved, directions(SENSORS), belief.range_m)
            tells = np.full(readings.shape, True) if belief.uses_no_return else readings < belief.range_m
            found.append(told_apart(readings, tells, value, self.same_m, bad))
        return np.concatenate(found) if found else np.zeros(0)
