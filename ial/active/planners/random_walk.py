"""`RandomPlanner`: drives in any direction that is safe. What every planner has to be better than."""

import math

import numpy as np

from ial.active.belief import Belief
from ial.active.decision import Decision
from ial.active.planners.hops import Hops

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
        ahead = self._hops.straight(belief, 0.0, self._hops.hop_m)
        if ahead is not None and ahead.distance_m == self._hops.hop_m:
            return Decision(ahead, "random", "straight on", goes_on=belief.motion is not None)
        for turn in self._random.permutation(2.0 * math.pi * np.arange(_DIRECTIONS) / _DIRECTIONS - math.pi).tolist():
            drive = self._hops.straight(belief, turn, self._hops.hop_m)
            if drive is not None:
                return Decision(drive, "random", "in a direction at random")
        return Decision(None, "exhausted", "no direction is safe wherever the robot is")
