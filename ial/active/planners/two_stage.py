"""`TwoStagePlanner`: the direction in which possible places differ most, and frontiers where none does (Goyal et al.).

It departs from the paper, which plans a whole path by virtual moves before the robot drives: here the robot drives at once, and each scan
on the way makes the set smaller. Moves are those that are safe for every possible pose. A direction is followed until not one beam but
enough of a scan differs, since some beams may be bad.
"""

import dataclasses
import math
from dataclasses import dataclass, field

import numpy as np

from ial.active.belief import Belief, Groups
from ial.active.common_space import CommonSpace
from ial.active.decision import Decision
from ial.active.direction_choice import DirectionChoice, Weights
from ial.active.explored_area import ExploredArea
from ial.active.planners.goal_choice import GoalChoice
from ial.active.planners.known_frontiers import KnownFrontiers
from ial.active.planners.look_around import LookAround
from ial.active.planners.outlook import MOST_GROUPS, Outlook
from ial.active.planners.route import Route
from ial.active.virtual_sensors import VirtualSensors, directions
from ial.pose import Pose

_FURTHER_M = np.array([0.0, 0.5, 1.0, 1.5, 2.0])  # than where the first beam differs
_SURE_M = 2.0  # of its way that stage 1 needs to be safe, if it is longer


@dataclass(frozen=True)
class Options:
    """What can be chosen.

    Parameters
    ----------
    weights
        How differences are weighed.
    directions
        How many directions are compared.
    guaranteed
        Whether readings are bounds over a group of poses, and not those of one of them.
    least_cells
        Frontiers of fewer cells are of no interest.
    route
        How the robot gets to a frontier.
    """

    weights: Weights = field(default_factory=Weights)
    directions: int = 36
    guaranteed: bool = False
    least_cells: int = 4
    route: Route = field(default_factory=Route)


@dataclass
class _Leg:
    """A direction that is being followed: its heading in the frame of the start, and how far still."""

    heading: float
    left_m: float


class TwoStagePlanner:
    """Chooses directions, then frontiers and views. It belongs to one run.

    Parameters
    ----------
    belief
        What is known, and will be.
    options
        What can be chosen.
    """

    def __init__(self, belief: Belief, options: Options | None = None) -> None:
        self.options = Options() if options is None else options
        self._route = self.options.route
        self._sensors = VirtualSensors(belief.grid)
        self._outlook = Outlook(self._sensors, self.options.weights.same_m)
        self._area = ExploredArea(belief.grid)
        self._goals = GoalChoice(self._outlook, KnownFrontiers(self._area, self.options.least_cells, self._route), self._route)
        self._around = LookAround(self._outlook)
        self._leg: _Leg | None = None
        self._tried_here = False
        self._decisions = 0

    def __repr__(self) -> str:
        return f"<TwoStagePlanner after {self._decisions} decisions>"

    def choose(self, belief: Belief) -> Decision:
        """Return the next decision."""
        self._decisions += 1
        if belief.view is not None:
            self._area.add(belief.view)
        groups = belief.groups(most=MOST_GROUPS)
        if self._decisions == 1:
            self._around.begin(belief)
        self._goals.stand(belief, groups, done=self._around.has_seen_all(belief))
        return dataclasses.replace(self._along_leg(belief) or self._chosen(belief, groups), open=self._goals.open)

    def _chosen(self, belief: Belief, groups: Groups) -> Decision:
        space: CommonSpace | None = None
        if self._goals.has_goal:
            space = self._route.space(belief, groups)
            further = self._goals.further(belief, groups, space, self._decisions)
            if further is not None:
                return further
            self._around.begin(belief)
            self._tried_here = False
        if self._around.begun:
            space = self._route.space(belief, groups) if space is None else space
            turn = self._around.further(belief, groups, space)
            if turn is not None:
                return turn
        if not self._tried_here and len(groups) > 1:
            self._tried_here = True
            decision = self.by_direction(belief, groups)
            if decision is not None:
                return decision
        self._tried_here = False
        space = self._route.space(belief, groups) if space is None else space
        chosen = self._goals.choose(belief, groups, space, self._decisions)
        if chosen.drive is None and self._around.unsafe:
            chosen = dataclasses.replace(chosen, reason=f"{chosen.reason}; in other directions it cannot look here: no turn is safe")
        return chosen

    def _along_leg(self, belief: Belief) -> Decision | None:
        """Return the next part of the way in a direction; None if it is done, or cannot be gone on with."""
        if self._leg is None:
            return None
        turn = math.remainder(self._leg.heading - belief.moved.theta, 2.0 * math.pi)
        drive = self._route.hops.straight(belief, turn, self._leg.left_m)
        if drive is not None:
            self._leg.left_m -= drive.distance_m
        if drive is None or self._leg.left_m <= 0.0:
            self._leg = None
            self._around.begin(belief)
        return None if drive is None else Decision(drive, "direction", "further in the same direction", goes_on=True)

    def by_direction(self, belief: Belief, groups: Groups) -> Decision | None:
        """Return the decision of stage 1; None if no direction is the best, or the best one leads nowhere."""
        turns = directions(self.options.directions)
        if self.options.guaranteed:
            lower, upper = self._sensors.bounds(groups.hulls, turns)
        else:
            lower = upper = self._sensors.readings(groups.poses, turns)
        choice = DirectionChoice.of(lower, upper, self._sensors.diameter_m, self.options.weights)
        best = int(choice.best[0])
        first = max(0.0, float(lower[:, best].min()) - belief.range_m)
        if len(choice.best) > 1 or not choice.differing[best] or not first:
            return None
        turn = math.remainder(float(turns[best]), 2.0 * math.pi)
        way = self._told_from(belief, groups, turn, first)
        if way is None or belief.safe_ways([turn], min(way, _SURE_M))[0] < min(way, _SURE_M):
            return None
        drive = self._route.hops.straight(belief, turn, way)
        if drive is None:
            return None
        if drive.distance_m < way:
            self._leg = _Leg(belief.moved.theta + turn, way - drive.distance_m)
        else:
            self._around.begin(belief)
        reason = f"{choice.differing[best]} of {len(groups)} groups read differently at {math.degrees(turn):.0f}°, {way:.2f} m on"
        return Decision(drive, "direction", reason)

    def _told_from(self, belief: Belief, groups: Groups, turn: float, first: float) -> float | None:
        """Return from where on a direction enough of a scan differs (m); None if it does nowhere."""
        here, ways = Pose(*groups.poses[0].tolist()), first + _FURTHER_M
        points = [(at.x, at.y) for at in (here @ Pose(0.0, 0.0, turn) @ Pose(float(each), 0.0, 0.0) for each in ways)]
        told = self._outlook.worth(belief, groups, here, points) >= 1.0
        return float(ways[np.argmax(told)]) if told.any() else None
