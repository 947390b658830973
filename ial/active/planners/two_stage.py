"""`TwoStagePlanner`: the direction in which possible places differ most, and frontiers where none does (Goyal et al.).

It departs from the paper, which plans a whole path by virtual moves before the robot drives: here the robot drives at once, and each scan
on the way makes the set smaller. Moves are those that are safe for every possible pose. Where no frontier is left, it looks for any view
that would tell possible places apart.
"""

import dataclasses
import math
from dataclasses import dataclass, field

from ial.active.belief import Belief, Groups
from ial.active.common_space import CommonSpace, in_robot_frame, moved_along
from ial.active.decision import Decision
from ial.active.direction_choice import DirectionChoice, Weights
from ial.active.explored_area import ExploredArea
from ial.active.planners.route import Place, Route
from ial.active.telling_apart import SENSORS, told_apart
from ial.active.virtual_sensors import VirtualSensors, directions
from ial.pose import Pose


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


@dataclass(frozen=True)
class _Open:
    """A frontier as it is remembered: where it is in the frame of the start, and which decision was the first to know it."""

    place: Place
    born: int


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
        self._area = ExploredArea(belief.grid)
        self._open: list[_Open] = []
        self._done: list[Place] = []
        self._viewed: list[Place] = []
        self._leg: _Leg | None = None
        self._target: _Target | None = None
        self._tried_here = False
        self._decisions = 0

    def __repr__(self) -> str:
        return f"<TwoStagePlanner after {self._decisions} decisions, {len(self._open)} open frontiers>"

    def choose(self, belief: Belief) -> Decision:
        """Return the next decision."""
        self._decisions += 1
        decision = self._chosen(belief)
        target = None if self._target is None else self._target.place
        left = (each.born for each in self._open if each.place != target and each.place not in self._done)
        return dataclasses.replace(decision, open=tuple(sorted(left)))

    def _chosen(self, belief: Belief) -> Decision:
        if belief.view is not None:
            self._area.add(belief.view)
        groups = belief.groups()
        going_on = self._further(belief, groups)
        if going_on is not None:
            return going_on
        if not self._tried_here and len(groups) > 1:
            self._tried_here = True
            decision = self.by_direction(belief, groups)
            if decision is not None:
                return decision
        space = self._route.space(belief, groups)
        return self._by_frontier(belief, groups, space) or self._by_view(belief, groups, space)

    def _further(self, belief: Belief, groups: Groups) -> Decision | None:
        """Return the next part of what was begun; None if it is done, or cannot be gone on with."""
        if self._leg is not None:
            turn = math.remainder(self._leg.heading - belief.moved.theta, 2.0 * math.pi)
            drive = self._route.hops.straight(belief, turn, self._leg.left_m)
            if drive is not None:
                self._leg.left_m -= drive.distance_m
                if self._leg.left_m <= 0.0:
                    self._leg = None
                return Decision(drive, "direction", "further in the same direction", goes_on=True)
            self._leg = None
        if self._target is not None:
            drive = self._route.towards(belief, self._route.space(belief, groups), self._target.place)
            if drive is not None:
                return Decision(drive, self._target.stage, "further to the same place", self._target.place, goes_on=True)
            self._done.append(self._target.place)
            self._target, self._tried_here = None, False
        return None

    def by_direction(self, belief: Belief, groups: Groups) -> Decision | None:
        """Return the decision of stage 1; None if no direction is the best, or the best one leads nowhere."""
        turns = directions(self.options.directions)
        if self.options.guaranteed:
            lower, upper = self._sensors.bounds(groups.hulls, turns)
        else:
            lower = upper = self._sensors.readings(groups.poses, turns)
        choice = DirectionChoice.of(lower, upper, self._sensors.diameter_m, self.options.weights)
        best = int(choice.best[0])
        if len(choice.best) > 1 or not choice.differing[best]:
            return None
        way = max(0.0, float(lower[:, best].min()) - belief.range_m)
        turn = math.remainder(float(turns[best]), 2.0 * math.pi)
        drive = self._route.hops.straight(belief, turn, way) if way > 0.0 else None
        if drive is None:
            return None
        if drive.distance_m < way:
            self._leg = _Leg(belief.moved.theta + turn, way - drive.distance_m)
        reason = f"{choice.differing[best]} of {len(groups)} groups read differently at {math.degrees(turn):.0f}°, {way:.2f} m on"
        return Decision(drive, "direction", reason)

    def _by_frontier(self, belief: Belief, groups: Groups, space: CommonSpace) -> Decision | None:
        candidates = self._known(belief, space)
        scores = {
            each: (each.born, self._apart(belief, groups, space, each.place), -self._route.cost_m(belief, space, each.place))
            for each in candidates
        }
        for best in sorted(candidates, key=scores.__getitem__, reverse=True):
            drive = self._route.towards(belief, space, best.place)
            if drive is not None:
                stage = "frontier" if best.born == self._decisions else "backtrack"
                self._target, self._tried_here = _Target(best.place, stage), False
                return Decision(drive, stage, f"the best of {len(candidates)} frontiers", best.place, since=best.born)
            self._done.append(best.place)
        return None

    def _known(self, belief: Belief, space: CommonSpace) -> list[_Open]:
        """Return the frontiers that are still there and were not tried, each since when it is known."""
        near, found = self._route.near_m, []
        start = space.here @ belief.moved.inverse()
        for each in self._area.frontiers(start, self.options.least_cells):
            place = self._route.in_start(belief, space, each.x, each.y)
            if any(math.dist(place, done) < near for done in self._done):
                continue
            before = [old.born for old in self._open if math.dist(place, old.place) < near]
            found.append(_Open(place, min(before, default=self._decisions)))
        self._open = found
        return found

    def _by_view(self, belief: Belief, groups: Groups, space: CommonSpace) -> Decision:
        """Return the way to the view that tells most places apart for what it costs; the end if there is none."""
        views = []
        for number in space.views(2):
            place = self._route.in_start(belief, space, *space.point(number))
            if all(math.dist(place, viewed) >= self._route.near_m / 2.0 for viewed in self._viewed):
                pairs = self._apart(belief, groups, space, place)
                if pairs:
                    views.append((pairs / (1.0 + space.cost_m(number)), place))
        for _, place in sorted(views, reverse=True):
            self._viewed.append(place)
            drive = self._route.towards(belief, space, place)
            if drive is not None:
                self._target, self._tried_here = _Target(place, "view"), False
                return Decision(drive, "view", f"the best of {len(views)} views that tell possible places apart", place)
        return Decision(None, "exhausted", "no view that can be reached safely, wherever the robot is, tells its possible places apart")

    def _apart(self, belief: Belief, groups: Groups, space: CommonSpace, place: Place) -> int:
        """Return how many pairs of groups would be told apart from a place."""
        at: Pose = self._route.in_map(belief, space, place)
        ((ahead, aside),) = in_robot_frame(space.here, [(at.x, at.y)])
        readings = self._sensors.readings(moved_along(groups.poses, ahead, aside), directions(SENSORS)).clip(max=belief.range_m)
        return told_apart(readings, self.options.weights.same_m, belief.bad_part)
