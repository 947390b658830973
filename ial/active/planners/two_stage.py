"""`TwoStagePlanner`: the direction in which possible places differ most, and frontiers where none does (Goyal et al.).

It departs from the paper, which plans a whole path by virtual moves before the robot drives: here the robot drives at once, and each scan
on the way makes the set smaller. Moves are those that are safe for every possible pose. Where no frontier is left, it looks for any view
that would tell possible places apart.
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
from ial.active.planners.known_frontier import KnownFrontier
from ial.active.planners.outlook import MOST_GROUPS, Outlook
from ial.active.planners.route import Place, Route
from ial.active.virtual_sensors import VirtualSensors, directions
from ial.pose import Pose

_FURTHER_M = np.array([0.0, 0.5, 1.0, 1.5, 2.0])  # than where the first beam of stage 1 differs
_SURE_M = 2.0  # of its way that stage 1 needs to be safe, if it is longer
_VIEW_EVERY = 2  # places of the lattice of ways


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
class _Target:
    """What is being driven to, and what chose it."""

    place: Place
    stage: str


@dataclass
class _Leg:
    """A direction that is being followed: its heading in the frame of the start, and how far still."""

    heading: float
    left_m: float


class TwoStagePlanner:
    """Chooses directions, then frontiers, then views. It belongs to one run.

    It ends: no place is chosen twice while the set has as many parts as before.

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
        self._open: list[KnownFrontier] = []
        self._done: list[Place] = []
        self._fewest = math.inf
        self._leg: _Leg | None = None
        self._target: _Target | None = None
        self._tried_here = False
        self._choices = self._decisions = 0

    def __repr__(self) -> str:
        return f"<TwoStagePlanner after {self._choices} choices, {len(self._open)} open frontiers>"

    def choose(self, belief: Belief) -> Decision:
        """Return the next decision."""
        self._decisions += 1
        decision = self._chosen(belief)
        left = [each.since for each in self._open if each.place != decision.target and not self._is_done(each.place)]
        return dataclasses.replace(decision, open=tuple(sorted(left)))

    def _chosen(self, belief: Belief) -> Decision:
        if belief.view is not None:
            self._area.add(belief.view)
        groups = belief.groups(most=MOST_GROUPS)
        if groups.parts < self._fewest:  # what was of no use may be of use now
            self._fewest = groups.parts
            self._done.clear()
        leg = self._along_leg(belief)
        if leg is not None:
            return leg
        space: CommonSpace | None = None
        if self._target is not None:
            space = self._route.space(belief, groups)
            further = self._to_target(belief, groups, space)
            if further is not None:
                return further
        if not self._tried_here and len(groups) > 1:
            self._tried_here = True
            decision = self.by_direction(belief, groups)
            if decision is not None:
                return decision
        space = self._route.space(belief, groups) if space is None else space
        return self._by_frontier(belief, groups, space) or self._by_view(belief, groups, space)

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
        return None if drive is None else Decision(drive, "direction", "further in the same direction", goes_on=True)

    def _to_target(self, belief: Belief, groups: Groups, space: CommonSpace) -> Decision | None:
        """Return the next part of the way to a place; None if it is reached, cannot be reached, or tells nothing any more."""
        if self._target is None:
            return None
        place, stage = self._target.place, self._target.stage
        at = self._route.in_map(belief, space, place)
        gone = stage != "view" and all(math.dist(place, each.place) >= self._route.near_m for each in self._known(belief, space))
        if not gone and self._outlook.worth(belief, groups, space.here, [(at.x, at.y)])[0] > 0.0:
            drive = self._route.towards(belief, space, place)
            if drive is not None:
                return Decision(drive, stage, "further to the same place", place, goes_on=True)
        self._target, self._tried_here = None, False
        return None

    def _set_out(self, place: Place, stage: str) -> None:
        """Drive to a place from now on; it is not chosen again."""
        self._done.append(place)
        self._target, self._tried_here = _Target(place, stage), False
        self._choices += 1

    def _is_done(self, place: Place) -> bool:
        return any(math.dist(place, done) < self._route.near_m / 2.0 for done in self._done)

    def by_direction(self, belief: Belief, groups: Groups) -> Decision | None:
        """Return the decision of stage 1; None if no direction is the best, or the best one leads nowhere."""
        turns = directions(self.options.directions)
        if self.options.guaranteed:
            lower, upper = self._sensors.bounds(groups.hulls, turns)
        else:
            lower = upper = self._sensors.readings(groups.poses, turns)
        choice = DirectionChoice.of(lower, upper, self._sensors.diameter_m, self.options.weights)
        best = int(choice.best[0])
        way = max(0.0, float(lower[:, best].min()) - belief.range_m)
        if len(choice.best) > 1 or not choice.differing[best] or not way:
            return None
        turn = math.remainder(float(turns[best]), 2.0 * math.pi)
        told = self._told_from(belief, groups, turn, way)
        if told is None:
            return None
        way, sure = told, min(told, _SURE_M)
        drive = self._route.hops.straight(belief, turn, way) if belief.safe_ways([turn], sure)[0] >= sure else None
        if drive is None:
            return None
        if drive.distance_m < way:
            self._leg = _Leg(belief.moved.theta + turn, way - drive.distance_m)
        reason = f"{choice.differing[best]} of {len(groups)} groups read differently at {math.degrees(turn):.0f}°, {way:.2f} m on"
        return Decision(drive, "direction", reason)

    def _told_from(self, belief: Belief, groups: Groups, turn: float, way: float) -> float | None:
        """Return from where on a direction enough of a scan differs, not only its one beam (m); None if it does nowhere."""
        here, ways = Pose(*groups.poses[0].tolist()), way + _FURTHER_M
        points = [(at.x, at.y) for at in (here @ Pose(0.0, 0.0, turn) @ Pose(float(each), 0.0, 0.0) for each in ways)]
        worth = self._outlook.worth(belief, groups, here, points)
        return float(ways[np.argmax(worth >= 1.0)]) if (worth >= 1.0).any() else None

    def _by_frontier(self, belief: Belief, groups: Groups, space: CommonSpace) -> Decision | None:
        """Return the way to a frontier: of those seen last, the best (depth first); None if none is of use."""
        known = [each for each in self._known(belief, space) if not self._is_done(each.place)]
        points = [(at.x, at.y) for at in (self._route.in_map(belief, space, each.place) for each in known)]
        worth = self._outlook.worth(belief, groups, space.here, points)
        costs = [self._route.cost_m(belief, space, each.place) for each in known]
        order = sorted(range(len(known)), key=lambda at: (known[at].born, worth[at] / (1.0 + costs[at])), reverse=True)
        for at in order:
            place = known[at].place
            drive = self._route.towards(belief, space, place) if worth[at] >= 1.0 and math.isfinite(costs[at]) else None
            if drive is not None:
                stage = "frontier" if known[at].born == self._choices else "backtrack"
                self._set_out(place, stage)
                return Decision(drive, stage, f"the best of {len(known)} frontiers", place, since=known[at].since)
        for at in order:  # nearer to one that cannot be reached yet, where less may be unknown
            number = space.towards(*points[at]) if worth[at] >= 1.0 and math.isinf(costs[at]) else None
            place = (math.inf, math.inf) if number is None else self._route.in_start(belief, space, *space.point(number))
            if number is None or self._is_done(place):
                continue
            drive = self._route.towards(belief, space, place)
            if drive is not None:
                self._set_out(place, "view")
                return Decision(drive, "view", "as near as possible to a frontier that cannot be reached safely yet", place)
        return None

    def _known(self, belief: Belief, space: CommonSpace) -> list[KnownFrontier]:
        """Return the frontiers that are still there, each since when it is known."""
        found = []
        start = space.here @ belief.moved.inverse()
        for each in self._area.frontiers(start, self.options.least_cells):
            place = self._route.in_start(belief, space, each.x, each.y)
            before = [(old.born, old.since) for old in self._open if math.dist(place, old.place) < self._route.near_m]
            found.append(KnownFrontier(place, *min(before, default=(self._choices, self._decisions))))
        self._open = found
        return found

    def _by_view(self, belief: Belief, groups: Groups, space: CommonSpace) -> Decision:
        """Return the way to the view that tells most places apart for what it costs; the end if there is none."""
        numbers = space.views(_VIEW_EVERY)
        points = [space.point(number) for number in numbers]
        values = self._outlook.worth(belief, groups, space.here, points) / [1.0 + space.cost_m(number) for number in numbers]
        order = sorted((at for at in range(len(numbers)) if values[at]), key=lambda at: -float(values[at]))
        for at in order:
            place = self._route.in_start(belief, space, *points[at])
            drive = None if self._is_done(place) else self._route.towards(belief, space, place)
            if drive is not None:
                self._set_out(place, "view")
                return Decision(drive, "view", f"the best of {len(order)} views that tell possible places apart", place)
        apart_m = _VIEW_EVERY * self._route.spacing_m
        tried = f", but for {len(order)} that it has looked from" if order else ""
        reason = f"none of {len(numbers)} views {apart_m:g} m apart that can be reached safely tells the possible places apart{tried}"
        return Decision(None, "exhausted", reason)
