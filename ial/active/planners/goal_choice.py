"""`GoalChoice`: to which frontier or view a robot drives, where no direction is the best (Goyal et al., stage 2).

Frontiers that were seen last are preferred, so the search goes into depth, and back where nothing is left. It departs from the paper in
that a goal is judged by what it tells apart for what the way costs, and that any view is a goal, not only one at a frontier.
"""

import math
from collections.abc import Iterable

import numpy as np

from ial.active.belief import Belief, Groups
from ial.active.common_space import CommonSpace
from ial.active.decision import Decision
from ial.active.planners.goal import Goal
from ial.active.planners.known_frontiers import KnownFrontiers
from ial.active.planners.outlook import Outlook
from ial.active.planners.route import Place, Route
from ial.active.virtual_sensors import directions

_ROUNDS = 2  # so often places are tried again that could not be reached
_VIEW_EVERY, _BLOCKED_EVERY = 2, 4  # places of the lattice of ways
_DIRECTIONS = 72
_TELLS = 1.0  # worth of one pair of parts


class GoalChoice:
    """The goals of a run.

    No goal is chosen twice while the set has as many parts as before, except for `_ROUNDS` times those that were not reached.

    Parameters
    ----------
    outlook
        What is told apart from where.
    frontiers
        What was seen so far.
    route
        How the robot gets to a goal.
    """

    def __init__(self, outlook: Outlook, frontiers: KnownFrontiers, route: Route) -> None:
        self._outlook, self._frontiers, self._route = outlook, frontiers, route
        self._goal: Goal | None = None
        self._chosen: list[Place] = []
        self._stood: list[Place] = []
        self._fewest, self._rounds, self._born = math.inf, 0, 0

    def __repr__(self) -> str:
        return f"<GoalChoice: {self._goal}, {len(self._chosen)} chosen>"

    @property
    def has_goal(self) -> bool:
        """Whether a goal is being driven to."""
        return self._goal is not None

    @property
    def open(self) -> tuple[int, ...]:
        """The numbers of the decisions that were the first to know the frontiers that are left besides the goal."""
        near, goal = self._route.near_m / 2.0, [] if self._goal is None else [self._goal.place]
        left = [each for each in self._frontiers.left if all(math.dist(each.place, other) >= near for other in self._chosen + goal)]
        return tuple(sorted(each.since for each in left))

    def stand(self, belief: Belief, groups: Groups, *, done: bool) -> None:
        """Take note of where the robot has looked from, and whether it is done there: whether it has seen all that can be seen."""
        if groups.parts < self._fewest:  # what was of no use may be of use now
            self._fewest, self._rounds = groups.parts, 0
            self._chosen.clear()
            self._stood.clear()
        if done:
            self._stood.append((belief.moved.x, belief.moved.y))

    def further(self, belief: Belief, groups: Groups, space: CommonSpace, number: int) -> Decision | None:
        """Return the next part of the way to the goal; None if it is reached, cannot be reached, or tells nothing any more."""
        goal = self._goal
        if goal is None:
            return None
        self._frontiers.look(belief, space, self._born, number)
        at = self._route.in_map(belief, space, goal.place)
        seen = goal.stage in ("frontier", "backtrack") and not self._frontiers.holds(goal.place)
        if goal.stage == "approach" or (not seen and self._outlook.worth(belief, groups, space.here, [(at.x, at.y)])[0] > 0.0):
            drive = self._route.towards(belief, space, goal.place)
            if drive is not None:
                return Decision(drive, goal.stage, "further to the same place", goal.place, goes_on=True)
        self._goal = None
        return None

    def choose(self, belief: Belief, groups: Groups, space: CommonSpace, number: int) -> Decision:
        """Return the way to the best goal; the end if there is none."""
        if (belief.safe_ways(directions(_DIRECTIONS), self._route.hops.hop_m) <= 0.0).all():  # then no goal has to be tried
            return Decision(None, "exhausted", f"in none of {_DIRECTIONS} directions is a way safe wherever the robot is")
        frontiers = self._of_frontiers(belief, groups, space, number)
        views = self._of_views(belief, groups, space)
        decision = self._set_out(belief, space, frontiers + views)
        decision = decision or self._set_out(belief, space, self._approaches(belief, groups, space))
        if decision is not None:
            return decision
        if self._chosen and self._rounds < _ROUNDS:  # some of them were not reached, and may be now
            self._rounds += 1
            self._chosen.clear()
            return self.choose(belief, groups, space, number)
        apart_m, count = _VIEW_EVERY * self._route.spacing_m, len(space.views(_VIEW_EVERY))
        told = f"tells apart any two of {len(groups)} groups of possible poses, by one pose of each"
        reason = f"none of {count} views {apart_m:g} m apart, safe to reach wherever the robot is and not had before, {told}"
        return Decision(None, "exhausted", reason if count else "no view is safe to reach wherever the robot is")

    def _set_out(self, belief: Belief, space: CommonSpace, goals: list[Goal]) -> Decision | None:
        """Take the best goal that can be driven to; None if there is none."""
        for goal in sorted(goals, key=lambda each: -each.value):
            drive = self._route.towards(belief, space, goal.place)
            if drive is not None:
                self._chosen.append(goal.place)
                self._goal = goal
                self._born += goal.stage == "frontier"
                return Decision(drive, goal.stage, f"the best of {len(goals)} goals, {goal.cost_m:.1f} m on", goal.place, since=goal.since)
        return None

    def _fresh(self, goals: Iterable[Goal]) -> list[Goal]:
        """Return those that were not chosen before, and at which the robot has not stood."""
        near = self._route.near_m / 2.0
        return [each for each in goals if all(math.dist(each.place, other) >= near for other in self._chosen + self._stood)]

    def _of_frontiers(self, belief: Belief, groups: Groups, space: CommonSpace, number: int) -> list[Goal]:
        known = self._frontiers.look(belief, space, self._born, number)
        points = [(at.x, at.y) for at in (self._route.in_map(belief, space, each.place) for each in known)]
        worth = self._outlook.worth(belief, groups, space.here, points)
        goals = []
        for each, tells in zip(known, worth.tolist(), strict=True):
            cost = self._route.cost_m(belief, space, each.place)
            if tells >= _TELLS and math.isfinite(cost):
                goals.append(Goal("frontier" if each.born == self._born else "backtrack", each.place, tells, cost, each.since))
        return self._fresh(goals)

    def _of_views(self, belief: Belief, groups: Groups, space: CommonSpace) -> list[Goal]:
        numbers = space.views(_VIEW_EVERY)
        points = [space.point(number) for number in numbers]
        worth = self._outlook.worth(belief, groups, space.here, points)
        return self._fresh(
            Goal("view", self._route.in_start(belief, space, *points[at]), float(worth[at]), space.cost_m(numbers[at]))
            for at in np.flatnonzero(worth).tolist()
        )

    def _approaches(self, belief: Belief, groups: Groups, space: CommonSpace) -> list[Goal]:
        """Return places as near as possible to views that cannot be reached safely yet: nearer to them, less is unknown."""
        points = space.blocked(groups, _BLOCKED_EVERY)
        worth = self._outlook.worth(belief, groups, space.here, points)
        goals = []
        for at in np.argsort(-worth, kind="stable").tolist():
            number = space.towards(*points[at]) if worth[at] >= _TELLS else None
            if number is not None:
                place = self._route.in_start(belief, space, *space.point(number))
                goals.append(Goal("approach", place, float(worth[at]), space.cost_m(number)))
        return self._fresh(goals)
