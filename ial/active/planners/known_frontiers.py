"""`KnownFrontiers`: the frontiers of what a robot has seen, as a planner remembers them."""

import math
from dataclasses import dataclass

from ial.active.belief import Belief
from ial.active.common_space import CommonSpace
from ial.active.explored_area import ExploredArea
from ial.active.planners.route import Place, Route


@dataclass(frozen=True)
class KnownFrontier:
    """A frontier, and since when it is known.

    Parameters
    ----------
    place
        Where it is, in metres in the frame of the start.
    born
        After how many choices of a frontier it was first seen: those that were seen last are tried first.
    since
        The number of the decision that was the first to know it, counted from 1.
    """

    place: Place
    born: int
    since: int


class KnownFrontiers:
    """What was seen so far, and its frontiers.

    Parameters
    ----------
    area
        What was seen.
    least_cells
        Frontiers of fewer cells are of no interest.
    route
        How the robot gets to one.

    Attributes
    ----------
    left
        The frontiers when it was last looked for them.
    """

    def __init__(self, area: ExploredArea, least_cells: int, route: Route) -> None:
        self.area, self.left = area, list[KnownFrontier]()
        self._least_cells, self._route = least_cells, route

    def __repr__(self) -> str:
        return f"<KnownFrontiers: {len(self.left)}>"

    def look(self, belief: Belief, space: CommonSpace, born: int, since: int) -> list[KnownFrontier]:
        """Return the frontiers that are there now; one near to an earlier one is that one."""
        found = []
        start = space.here @ belief.moved.inverse()
        for each in self.area.frontiers(start, self._least_cells):
            place = self._route.in_start(belief, space, each.x, each.y)
            before = [(old.born, old.since) for old in self.left if math.dist(place, old.place) < self._route.near_m]
            found.append(KnownFrontier(place, *min(before, default=(born, since))))
        self.left = found
        return found

    def holds(self, place: Place) -> bool:
        """Return whether there was a frontier near a place when it was last looked for them."""
        return any(math.dist(place, each.place) < self._route.near_m for each in self.left)
