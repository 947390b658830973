"""`RandomPlanner`: drives in any direction that is safe. What every planner has to be better than."""

import math

import numpy as np

from ial.active.belief import Belief
from ial.active.decision import Decision
from ial.active.planners.hops import Hops
from ial.active.robot import Drive

_DIRECTIONS = 36


class RandomPlanner:
    """Goes straight on as long as it is safe, then in another direction at random.

    Parameters
    ----------
    seed
        The same seed gives the same choices.
    hops
        How the robot gets on.
    """

    def __init__(self, seed: int = 0, hops: Hops | None = None) -> None:
        self._random = np.random.default_rng(seed)
        self._hops = Hops() if hops is None else hops

    def __repr__(self) -> str:
        return "<RandomPlanner>"

    def choose(self, belief: Belief) -> Decision:
        """Return the next decision."""
        turns = 2.0 * math.pi * np.arange(_DIRECTIONS) / _DIRECTIONS - math.pi
        ways = belief.safe_ways(np.append(turns, 0.0), self._hops.hop_m)
        if ways[-1] == self._hops.hop_m:
            return Decision(Drive(0.0, self._hops.hop_m), "random", "straight on", goes_on=belief.motion is not None)
        free = np.flatnonzero(ways[:-1] >= self._hops.shortest_m)
        if len(free):
            chosen = int(self._random.choice(free))
            return Decision(Drive(float(turns[chosen]), float(ways[chosen])), "random", "in a direction at random")
        return Decision(None, "exhausted", "no direction is safe wherever the robot is")
