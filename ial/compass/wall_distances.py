"""`WallDistances`: about how many motions apart the walls of a polygon are, a guide for plans."""

import numpy as np
import numpy.typing as npt

from ial.maps.polygons.exact.rational import rational
from ial.maps.polygons.exact.shortest_path import ShortestPaths

FloatArray = npt.NDArray[np.float64]


class WallDistances:
    """How often the shortest paths between the middles of walls turn.

    Parameters
    ----------
    paths
        The shortest paths.

    Attributes
    ----------
    table
        For each pair of walls 1 more than the number of turns; 0 for a wall and itself.
    """

    def __init__(self, paths: ShortestPaths) -> None:
        shooter = paths.visibility.shooter
        count, half = len(shooter), rational(1) / 2
        middles = [shooter.on_edge(edge, half).place for edge in range(count)]
        hops = paths.hops
        lengths = np.full((count, count), np.inf)
        self.table = np.ones((count, count))
        if len(hops):
            fans = [paths.fan(middle) for middle in middles]
            for one in range(count):
                first, near = fans[one]
                if not len(first):
                    continue
                ways = near[:, None] + paths.between[first]  # to every corner where a path turns
                nearest = ways.argmin(axis=0)
                for other in range(one):
                    last, far = fans[other]
                    if not len(last):
                        continue
                    total = ways[nearest[last], last] + far
                    at = int(total.argmin())
                    lengths[one, other] = total[at]
                    turns = 2.0 + hops[first[nearest[last[at]]], last[at]]
                    self.table[one, other] = self.table[other, one] = turns
            for one in range(count):
                seen = [other for other in range(one) if np.isfinite(lengths[one, other])]
                sights = paths.visibility.seen(middles[one], [middles[other] for other in seen])
                for other, sight in zip(seen, sights, strict=True):
                    if sight:
                        self.table[one, other] = self.table[other, one] = 1.0
        np.fill_diagonal(self.table, 0.0)

    def __repr__(self) -> str:
        return f"<WallDistances between {len(self.table)} walls>"

    def spans(self, walls: npt.NDArray[np.int64]) -> FloatArray:
        """Return for each row of numbers of walls the length of the shortest tree that joins them."""
        rows, count = walls.shape
        between = self.table[walls[:, :, None], walls[:, None, :]]
        left = np.ones((rows, count), dtype=np.bool_)
        left[:, 0] = False
        near, total = between[:, 0].copy(), np.zeros(rows)
        every = np.arange(rows)
        for _ in range(count - 1):
            nearest = np.where(left, near, np.inf).argmin(axis=1)
            total += near[every, nearest]
            left[every, nearest] = False
            near = np.minimum(near, between[every, nearest])
        return total
