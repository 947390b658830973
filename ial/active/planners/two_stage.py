"""`TwoStagePlanner`: the direction in which possible places differ most, and frontiers where none does (Goyal et al.).

It departs from the paper, which plans a whole path by virtual moves before the robot drives: here the robot drives at once, and each scan
on the way makes the set smaller. Moves are those that are safe for every possible pose. Where no frontier is left, it looks for any view
that would tell possible places apart.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np

from ial.active.belief import Belief, Groups
from ial.active.common_space import CommonSpace
from ial.active.decision import Decision
from ial.active.direction_choice import DirectionChoice, Weights
from ial.active.explored_area import ExploredArea
from ial.active.planners.outlook import MOST_GROUPS, Outlook
from ial.active.planners.route import Place, Route
from ial.active.virtual_sensors import VirtualSensors, directions
from ial.pose import Pose

_FURTHER_M = np.array([0.0, 0.5, 1.0, 1.5, 2.0])  # than where the first beam of stage 1 differs
_SURE_M = 2.0  # of its way that stage 1 needs to be safe, if it is longer
_SETTING_OUT_M = 1.0  # what a new target costs besides its way
_DEEPER = 2.0  # as much more are frontiers worth that were seen last
_ROUNDS = 2  # so often places are tried again that could not be reached
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


@dataclass(frozen=True)
class _Open:
    """A frontier as it is remembered: where it is in the frame of the start, and after which choice it was first seen."""

    place: Place
    born: int


@dataclass(frozen=True)
class _Choice:
    """A place to drive to: what it tells apart, what the way costs, and what chose it."""

    worth: float
    cost_m: float
    place: Place
    stage: str

    @property
    def value(self) -> float:
        """What is told apart for a metre; those frontiers are preferred that were seen last, as a search in depth does."""
        return (_DEEPER if self.stage == "frontier" else 1.0) * self.worth / (_SETTING_OUT_M + self.cost_m)


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
        self._open: list[_Open] = []
        self._done: list[Place] = []
        self._stood: list[Place] = []
        self._fewest, self._rounds = math.inf, 0
        self._leg: _Leg | None = None
        self._target: _Choice | None = None
        self._tried_here = False
        self._choices = 0

    def __repr__(self) -> str:
        return f"<TwoStagePlanner after {self._choices} choices, {len(self._open)} open frontiers>"

    def choose(self, belief: Belief) -> Decision:
        """Return the next decision."""
        if belief.view is not None:
            self._area.add(belief.view)
        groups = belief.groups(most=MOST_GROUPS)
        if groups.parts < self._fewest:  # what was of no use may be of use now
            self._fewest, self._rounds = groups.parts, 0
            self._done.clear()
            self._stood.clear()
        self._stood.append((belief.moved.x, belief.moved.y))
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
        return self._by_place(belief, groups, space)

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
        return None if drive is None else Decision(drive, "direction", "further in the same direction")

    def _to_target(self, belief: Belief, groups: Groups, space: CommonSpace) -> Decision | None:
        """Return the next part of the way to a place; None if it is reached, cannot be reached, or tells nothing any more."""
        if self._target is None:
            return None
        place, stage = self._target.place, self._target.stage
        at = self._route.in_map(belief, space, place)
        gone = stage in ("frontier", "backtrack") and all(
            math.dist(place, each.place) >= self._route.near_m for each in self._known(belief, space)
        )
        if stage == "approach" or (not gone and self._outlook.worth(belief, groups, space.here, [(at.x, at.y)])[0] > 0.0):
            drive = self._route.towards(belief, space, place)
            if drive is not None:
                return Decision(drive, stage, "further to the same place", place)
        self._target, self._tried_here = None, False
        return None

    def _fresh(self, choices: Iterable[_Choice]) -> list[_Choice]:
        """Return those that were not set out to before, and at which the robot has not stood."""
        near = self._route.near_m / 2.0
        return [each for each in choices if all(math.dist(each.place, other) >= near for other in self._done + self._stood)]

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

    def _by_place(self, belief: Belief, groups: Groups, space: CommonSpace) -> Decision:
        """Return the way to the best frontier or view, or towards a frontier that is blocked; the end if there is none."""
        known = self._known(belief, space)
        points = [(at.x, at.y) for at in (self._route.in_map(belief, space, each.place) for each in known)]
        worth = self._outlook.worth(belief, groups, space.here, points)
        costs = [self._route.cost_m(belief, space, each.place) for each in known]
        of_use = [at for at in range(len(known)) if worth[at] >= 1.0]
        stages = ["frontier" if each.born == self._choices else "backtrack" for each in known]
        frontiers = self._fresh(
            _Choice(float(worth[at]), costs[at], known[at].place, stages[at]) for at in of_use if math.isfinite(costs[at])
        )
        numbers = space.views(_VIEW_EVERY)
        views = self._views(belief, groups, space, numbers)
        blocked = [points[at] for at in of_use if math.isinf(costs[at])]
        found = self._best(belief, space, frontiers + views)
        found = found or self._best(belief, space, self._approaches(belief, space, blocked))
        if found is not None:
            return found
        if self._done and self._rounds < _ROUNDS:  # some of them were not reached, and may be now
            self._rounds += 1
            self._done.clear()
            return self._by_place(belief, groups, space)
        apart_m = _VIEW_EVERY * self._route.spacing_m
        reason = f"none of {len(numbers)} views {apart_m:g} m apart that can be reached safely is left that tells possible places apart"
        return Decision(None, "exhausted", reason)

    def _best(self, belief: Belief, space: CommonSpace, choices: list[_Choice]) -> Decision | None:
        """Set out to that of some places which tells most apart for what it costs; None if none can be driven to."""
        for best in sorted(choices, key=lambda each: -each.value):
            drive = self._route.towards(belief, space, best.place)
            if drive is not None:
                self._done.append(best.place)
                self._target, self._tried_here = best, False
                self._choices += best.stage == "frontier"
                return Decision(drive, best.stage, f"the best of {len(choices)} places, {best.cost_m:.1f} m on", best.place)
        return None

    def _views(self, belief: Belief, groups: Groups, space: CommonSpace, numbers: list[int]) -> list[_Choice]:
        """Return the places of a lattice from which something is told apart."""
        points = [space.point(number) for number in numbers]
        worth = self._outlook.worth(belief, groups, space.here, points)
        return self._fresh(
            _Choice(float(worth[at]), space.cost_m(numbers[at]), self._route.in_start(belief, space, *points[at]), "view")
            for at in np.flatnonzero(worth).tolist()
        )

    def _approaches(self, belief: Belief, space: CommonSpace, blocked: list[Place]) -> list[_Choice]:
        """Return places as near as possible to frontiers that cannot be reached safely yet: nearer to them, less may be unknown."""
        numbers = [number for number in (space.towards(*point) for point in blocked) if number is not None]
        found = [_Choice(1.0, space.cost_m(each), self._route.in_start(belief, space, *space.point(each)), "approach") for each in numbers]
        return self._fresh(found)

    def _known(self, belief: Belief, space: CommonSpace) -> list[_Open]:
        """Return the frontiers that are still there, each since when it is known."""
        found = []
        start = space.here @ belief.moved.inverse()
        for each in self._area.frontiers(start, self.options.least_cells):
            place = self._route.in_start(belief, space, each.x, each.y)
            before = [old.born for old in self._open if math.dist(place, old.place) < self._route.near_m]
            found.append(_Open(place, min(before, default=self._choices)))
        self._open = found
        return found
