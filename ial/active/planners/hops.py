"""`Hops`: the next drive towards a point, as far as it is safe wherever the robot is."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ial.active.belief import Belief
from ial.active.robot import Drive

_LOOK_AHEAD, _TRIES = 16, 6


@dataclass(frozen=True)
class Hops:
    """How a robot gets on.

    Parameters
    ----------
    hop_m
        The longest way between two scans.
    shortest_m
        Shorter ones are not driven, except to a goal that is so near.
    """

    hop_m: float = 1.0
    shortest_m: float = 0.1

    def straight(self, belief: Belief, turn_rad: float, distance_m: float) -> Drive | None:
        """Return the next part of a straight way; None if not even the shortest is safe."""
        most = min(distance_m, self.hop_m)
        way = float(belief.safe_ways([turn_rad], most)[0])
        return Drive(turn_rad, way) if way >= min(self.shortest_m, distance_m) and way > 0.0 else None

    def along(self, belief: Belief, points: Sequence[tuple[float, float]]) -> Drive | None:
        """Return the next drive along a path, whose points are ahead and to the left of the robot: the one that gets on most.

        None if none gets on by the shortest way that is driven.
        """
        ahead = np.array(points[:_LOOK_AHEAD], dtype=np.float64).reshape(-1, 2)
        turns, lengths = np.arctan2(ahead[:, 1], ahead[:, 0]), np.hypot(ahead[:, 0], ahead[:, 1])
        along = np.cumsum(np.hypot(*np.diff(ahead, axis=0, prepend=[[0.0, 0.0]]).T))
        ways = np.minimum(belief.safe_ways(turns, self.hop_m), lengths)
        gained = along - (lengths - ways)  # what of the path is behind it then
        order = [at for at in np.argsort(-gained, kind="stable").tolist() if ways[at] >= self.shortest_m]
        drives = (self.straight(belief, float(turns[at]), float(ways[at])) for at in order[:_TRIES])
        return next((drive for drive in drives if drive is not None), None)
