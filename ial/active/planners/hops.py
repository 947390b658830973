"""`Hops`: the next drive towards a point, as far as it is safe wherever the robot is."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ial.active.belief import Belief
from ial.active.robot import Drive

_SHORTEST_M = 0.05
_LOOK_AHEAD, _TRIES = 40, 6


@dataclass(frozen=True)
class Hops:
    """How a robot gets on.

    Parameters
    ----------
    hop_m
        The longest way between two scans.
    """

    hop_m: float = 1.0

    def straight(self, belief: Belief, turn_rad: float, distance_m: float) -> Drive | None:
        """Return the next part of a straight way; None if not even the shortest is safe."""
        most = min(distance_m, self.hop_m)
        way = float(belief.safe_ways([turn_rad], most)[0])
        return Drive(turn_rad, way) if way >= min(_SHORTEST_M, distance_m) and way > 0.0 else None

    def along(self, belief: Belief, points: Sequence[tuple[float, float]]) -> Drive | None:
        """Return the next drive along a path, whose points are ahead and to the left of the robot: to the farthest that is safe."""
        ahead = points[:_LOOK_AHEAD]
        turns = [math.atan2(y, x) for x, y in ahead]
        lengths = np.array([math.hypot(x, y) for x, y in ahead])
        safe = belief.safe_ways(turns, float(lengths.max(initial=0.0)))
        whole = np.flatnonzero(safe >= lengths)
        order = [*whole[::-1].tolist(), *np.argsort(-safe, kind="stable").tolist()]  # else those to which it comes farthest
        drives = (self.straight(belief, turns[at], float(lengths[at])) for at in order[:_TRIES])
        return next((drive for drive in drives if drive is not None), None)
