"""`TwoStagePlanner`: the direction in which possible places differ most, and frontiers where none does (Goyal et al.).

It departs from the paper, which plans a whole path by virtual moves before the robot drives: here the robot drives at once, and each scan
on the way makes the set smaller. Moves are those that are safe for every possible pose.
"""

import math
from dataclasses import dataclass, field

import numpy as np

from ial.active.belief import Belief, Groups
from ial.active.common_space import CommonSpace, in_robot_frame, moved_along
from ial.active.decision import Decision
from ial.active.direction_choice import DirectionChoice, Weights
from ial.active.explored_area import ExploredArea, Frontier
from ial.active.planners.hops import Hops
from ial.active.telling_apart import told_apart
from ial.active.virtual_sensors import VirtualSensors, directions
from ial.pose import Pose

_SENSORS = 72  # of a view
_MOST_PARTS = 500  # of a set, by which common space is judged


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
    spacing_m
        Between places of which paths are made.
    least_cells
        Frontiers of fewer cells are of no interest.
    near_m
        A frontier this near was reached, or is the one that was there before.
    hops
        How the robot gets on.
    """

    weights: Weights = field(default_factory=Weights)
    directions: int = 36
    guaranteed: bool = False
    spacing_m: float = 0.25
    least_cells: int = 4
    near_m: float = 0.6
    hops: Hops = field(default_factory=Hops)


@dataclass(frozen=True)
class _Open:
    """A frontier as it is remembered: where it is in the frame of the start, and after how many choices it was first seen."""

    x: float
    y: float
    born: int


@dataclass
class _Leg:
    """A direction that is being followed: how far still, and in which heading of the frame of the start."""

    heading: float
    left_m: float


@dataclass
class TwoStagePlanner:
    """Chooses directions, then frontiers. It belongs to one run.

    Parameters
    ----------
    belief
        What is known, and will be.
    options
        What can be chosen.
    """

    belief: Belief
    options: Options = Options()
    _open: list[_Open] = field(default_factory=list)
    _done: list[tuple[float, float]] = field(default_factory=list)
    _viewed: list[tuple[float, float]] = field(default_factory=list)
    _leg: _Leg | None = None
    _target: _Open | None = None
    _tried_here: bool = False
    _choices: int = 0

    def __post_init__(self) -> None:
        self._sensors = VirtualSensors(self.belief.grid)
        self._area = ExploredArea(self.belief.grid)

    def choose(self, belief: Belief) -> Decision:
        """Return the next decision."""
        if belief.view is not None:
            self._area.add(belief.view)
        groups = belief.groups()
        going_on = self._further(belief, groups)
        if going_on is not None:
            return going_on
        self._choices += 1
        if not self._tried_here and len(groups) > 1:
            self._tried_here = True
            decision = self._by_direction(belief, groups)
            if decision is not None:
                return decision
        return self._by_frontier(belief, groups)

    def _further(self, belief: Belief, groups: Groups) -> Decision | None:
        """Return the next part of what was begun; None if it is done, or cannot be gone on with."""
        if self._leg is not None:
            turn = math.remainder(self._leg.heading - belief.moved.theta, 2.0 * math.pi)
            drive = self.options.hops.straight(belief, turn, self._leg.left_m)
            if drive is not None:
                self._leg.left_m -= drive.distance_m
                if self._leg.left_m <= 0.0:
                    self._leg = None
                return Decision(drive, "direction", "further in the same direction")
            self._leg = None
        if self._target is not None:
            space = self._space(belief, groups)
            decision = self._towards(belief, space, self._target, "frontier", "further to the same frontier")
            if decision is not None:
                return decision
            self._done.append((self._target.x, self._target.y))
            self._target, self._tried_here = None, False
        return None

    def _space(self, belief: Belief, groups: Groups) -> CommonSpace:
        return CommonSpace(
            groups.poses[0], belief.groups(self.options.spacing_m, _MOST_PARTS), belief.field, belief.distances, self.options.spacing_m
        )

    def _by_direction(self, belief: Belief, groups: Groups) -> Decision | None:
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
        drive = self.options.hops.straight(belief, turn, way) if way > 0.0 else None
        if drive is None:
            return None
        if drive.distance_m < way:
            self._leg = _Leg(belief.moved.theta + turn, way - drive.distance_m)
        reason = f"{choice.differing[best]} of {len(groups)} groups read differently at {math.degrees(turn):.0f}°, {way:.2f} m on"
        return Decision(drive, "direction", reason)

    def _by_frontier(self, belief: Belief, groups: Groups) -> Decision:
        start = Pose(*groups.poses[0].tolist()) @ belief.moved.inverse()
        space = self._space(belief, groups)
        candidates = self._known(start, self._area.frontiers(start, self.options.least_cells))
        while candidates:
            best = max(candidates, key=lambda each: (each.born, self._score(groups, space, start, each)))
            stage = "frontier" if best.born == self._choices else "backtrack"
            decision = self._towards(belief, space, best, stage, f"the best of {len(candidates)} frontiers")
            if decision is not None:
                self._target, self._tried_here = best, False
                return decision
            candidates.remove(best)
            self._done.append((best.x, best.y))
        return self._by_view(belief, groups, space, start)

    def _by_view(self, belief: Belief, groups: Groups, space: CommonSpace, start: Pose) -> Decision:
        """Return the way to the view that tells most places apart; the end if there is none."""
        views = []
        for place in space.views(2):
            ((ahead, aside),) = in_robot_frame(space.here, [space.point(place)])
            at = start.inverse() @ Pose(*space.point(place), 0.0)
            if all(math.hypot(at.x - x, at.y - y) >= self.options.near_m / 2.0 for x, y in self._viewed):
                pairs = self._apart(groups, ahead, aside)
                if pairs:
                    views.append((pairs / (1.0 + space.cost_m(place)), _Open(at.x, at.y, self._choices)))
        for _, view in sorted(views, key=lambda each: -each[0]):
            self._viewed.append((view.x, view.y))
            decision = self._towards(belief, space, view, "view", f"the best of {len(views)} views that tell possible places apart")
            if decision is not None:
                self._target, self._tried_here = view, False
                return decision
        return Decision(None, "exhausted", "no view that can be reached safely, wherever the robot is, tells its possible places apart")

    def _apart(self, groups: Groups, ahead: float, aside: float) -> int:
        """Return how many pairs of groups would be told apart from so far ahead of the robot and to its left."""
        readings = self._sensors.readings(moved_along(groups.poses, ahead, aside), directions(_SENSORS))
        readings = np.minimum(readings, self.belief.range_m)
        return told_apart(readings, self.options.weights.same_m, self.belief.bad_part)

    def _known(self, start: Pose, frontiers: list[Frontier]) -> list[_Open]:
        """Return the frontiers that are still there and were not tried, each since when it is known."""
        back = start.inverse()
        found = []
        for each in frontiers:
            at = back @ Pose(each.x, each.y, 0.0)
            if any(math.hypot(at.x - x, at.y - y) < self.options.near_m for x, y in self._done):
                continue
            before = [old for old in self._open if math.hypot(at.x - old.x, at.y - old.y) < self.options.near_m]
            found.append(_Open(at.x, at.y, min((old.born for old in before), default=self._choices)))
        self._open = found.copy()
        return found

    def _score(self, groups: Groups, space: CommonSpace, start: Pose, frontier: _Open) -> tuple[int, float]:
        """Return how many pairs of groups would be told apart from a frontier, and minus what the way to it costs."""
        at = start @ Pose(frontier.x, frontier.y, 0.0)
        ((ahead, aside),) = in_robot_frame(space.here, [(at.x, at.y)])
        place = space.nearest(at.x, at.y, self.options.near_m)
        return self._apart(groups, ahead, aside), -space.cost_m(place) if place is not None else -math.inf

    def _towards(self, belief: Belief, space: CommonSpace, frontier: _Open, stage: str, reason: str) -> Decision | None:
        """Return a drive to a frontier; None if it was reached, or there is no safe way."""
        start = space.here @ belief.moved.inverse()
        at = start @ Pose(frontier.x, frontier.y, 0.0)
        place = space.nearest(at.x, at.y, self.options.near_m)
        if place is None or math.hypot(at.x - space.here.x, at.y - space.here.y) < self.options.near_m / 2.0:
            return None
        points = space.path(place)
        if not points:
            return None
        drive = self.options.hops.along(belief, in_robot_frame(space.here, points))
        return None if drive is None else Decision(drive, stage, reason, (frontier.x, frontier.y))
