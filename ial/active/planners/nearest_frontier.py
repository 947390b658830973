"""`NearestFrontierPlanner`: to the nearest border of what was seen (Yamauchi 1997), whatever it would tell."""

import math

from ial.active.belief import Belief
from ial.active.decision import Decision
from ial.active.explored_area import ExploredArea
from ial.active.planners.route import Place, Route


class NearestFrontierPlanner:
    """Explores. It belongs to one run.

    Parameters
    ----------
    belief
        What is known, and will be.
    route
        How the robot gets to a frontier.
    least_cells
        Frontiers of fewer cells are of no interest.
    """

    def __init__(self, belief: Belief, route: Route | None = None, least_cells: int = 4) -> None:
        self._route = Route() if route is None else route
        self._area = ExploredArea(belief.grid)
        self._least_cells = least_cells
        self._done: list[Place] = []
        self._target: Place | None = None

    def __repr__(self) -> str:
        return f"<NearestFrontierPlanner, {len(self._done)} frontiers done>"

    def choose(self, belief: Belief) -> Decision:
        """Return the next decision."""
        if belief.view is not None:
            self._area.add(belief.view)
        space = self._route.space(belief, belief.groups())
        if self._target is not None:
            drive = self._route.towards(belief, space, self._target)
            if drive is not None:
                return Decision(drive, "frontier", "further to the same frontier", self._target, goes_on=True)
            self._done.append(self._target)
            self._target = None
        start = space.here @ belief.moved.inverse()
        found = [self._route.in_start(belief, space, each.x, each.y) for each in self._area.frontiers(start, self._least_cells)]
        fresh = [each for each in found if all(math.dist(each, done) >= self._route.near_m for done in self._done)]
        for place in sorted(fresh, key=lambda each: self._route.cost_m(belief, space, each)):
            drive = self._route.towards(belief, space, place)
            if drive is not None:
                self._target = place
                return Decision(drive, "frontier", f"the nearest of {len(fresh)} frontiers", place)
            self._done.append(place)
        return Decision(None, "exhausted", "no frontier can be reached safely wherever the robot is")
