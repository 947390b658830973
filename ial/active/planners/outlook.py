"""`Outlook`: which pairs of possible places a robot would tell apart from where it could go."""

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
        found = []
        for begin in range(0, len(ahead), _TOGETHER):
            part = slice(begin, begin + _TOGETHER)
            moved = moved_along(groups.poses, ahead[part], aside[part])
            readings = self.sensors.readings(moved, directions(SENSORS), belief.range_m)
            found.append(told_apart(readings, value, self.same_m, belief.bad_part))
        return np.concatenate(found) if found else np.zeros(0)
