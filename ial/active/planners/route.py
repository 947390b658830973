"""`Route`: the way to a place in the frame of a robot's start, safe wherever the robot is."""

import math
from dataclasses import dataclass, field

import numpy as np

from ial.active.belief import Belief, Groups
from ial.active.common_space import CommonSpace, in_robot_frame
from ial.active.planners.hops import Hops
from ial.active.robot import Drive
from ial.active.virtual_sensors import directions
from ial.pose import Pose

Place = tuple[float, float]

_MOST_PARTS = 500  # of a set, by which common space is judged
_DIRECTIONS = 36
_GAINED_M = 0.05


@dataclass(frozen=True)
class Route:
    """How a robot gets to a place.

    Parameters
    ----------
    spacing_m
        Between places of which ways are made.
    near_m
        A place is taken for another one so near, and reached at half of that.
    hops
        How the robot gets on.
    """

    spacing_m: float = 0.25
    near_m: float = 0.6
    hops: Hops = field(default_factory=Hops)

    def space(self, belief: Belief, groups: Groups) -> CommonSpace:
        """Return where the robot can drive, as seen from the first group."""
        parts = belief.groups(self.spacing_m, _MOST_PARTS)
        return CommonSpace(groups.poses[0], parts, belief.field, belief.distances, self.spacing_m)

    def in_map(self, belief: Belief, space: CommonSpace, place: Place) -> Pose:
        """Return where a place of the frame of the start is in the grid's frame, if the robot is where the space is seen from."""
        return space.here @ belief.moved.inverse() @ Pose(*place, 0.0)

    def in_start(self, belief: Belief, space: CommonSpace, x: float, y: float) -> Place:
        """Return where a point of the grid's frame is in the frame of the start, if the robot is where the space is seen from."""
        at = belief.moved @ space.here.inverse() @ Pose(x, y, 0.0)
        return at.x, at.y

    def cost_m(self, belief: Belief, space: CommonSpace, place: Place) -> float:
        """Return what the way to a place costs; infinite if there is none."""
        at = self.in_map(belief, space, place)
        number = space.nearest(at.x, at.y, self.near_m)
        return math.inf if number is None else space.cost_m(number)

    def towards(self, belief: Belief, space: CommonSpace, place: Place) -> Drive | None:
        """Return the next drive to a place; None if it was reached, or there is no safe way."""
        at = self.in_map(belief, space, place)
        number = space.nearest(at.x, at.y, self.near_m)
        if number is None or math.hypot(at.x - space.here.x, at.y - space.here.y) < self.near_m / 2.0:
            return None
        points = space.path(number)
        drive = self.hops.along(belief, in_robot_frame(space.here, points)) if points else None
        return drive or self._around(belief, space, number)

    def _around(self, belief: Belief, space: CommonSpace, number: int) -> Drive | None:
        """Return a drive in any direction after which the way to a place costs less: the way itself is too near to something here."""
        turns = directions(_DIRECTIONS)
        ways = belief.safe_ways(turns, self.hops.hop_m)
        left = space.costs_from(number)
        ends = space.here.x + ways * np.cos(space.here.theta + turns), space.here.y + ways * np.sin(space.here.theta + turns)
        after = np.where(ways > 0.0, left[space.places(*ends)], math.inf)
        best = int(np.argmin(after))
        if not after[best] < left[space.places(space.here.x, space.here.y)] - _GAINED_M:
            return None
        return self.hops.straight(belief, math.remainder(float(turns[best]), 2.0 * math.pi), float(ways[best]))
