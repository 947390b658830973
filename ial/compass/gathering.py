"""`Gathering`: the search for motions after which fewer points are possible, among directions of few bits."""

import math
from collections import Counter
from heapq import heappop, heappush
from itertools import count

import numpy as np

from ial.compass.chase import Points, edges_of, key
from ial.compass.primitive import MOST_BITS, Direction, bits, primitive, reverse
from ial.compass.segment_phase import wall_direction
from ial.compass.state import InformationState
from ial.compass.transition import Transition
from ial.compass.wall_distances import WallDistances

_AROUND = 32  # directions beside those of walls
_AROUND_SIZE = 64  # of their components
_MOST_WALLS = 48  # directions of walls that are tried always; those of walls with several points on them are tried, too
_TRIES = 8  # sets of points from which all directions are tried
_KEPT = 12  # directions of each that may be gone on with


class Gathering:
    """A best-first search: all directions are tried on all points at once, and those go on that leave few points, close together.

    Two points on one wall become one by a motion along it, exactly; so most of what it finds is a motion that brings points onto one wall,
    and one along that wall. This is not in the papers, which bring points together in pairs.

    Parameters
    ----------
    transition
        What a motion does.
    distances
        How far walls are apart.
    """

    def __init__(self, transition: Transition, distances: WallDistances) -> None:
        self._transition = transition
        self._distances = distances
        shooter = self._shooter = transition.shooter
        lengths: dict[Direction, float] = {}
        for edge, (ex, ey) in enumerate(shooter.edges):
            line = max(wall_direction(shooter, edge), reverse(wall_direction(shooter, edge)))
            lengths[line] = lengths.get(line, 0.0) + math.hypot(float(ex), float(ey))
        lines = sorted(lengths, key=lambda line: (-lengths[line], line))[:_MOST_WALLS]
        angles = [2.0 * math.pi * (0.37 + each) / _AROUND for each in range(_AROUND)]  # none of them along an axis
        around = [primitive(round(_AROUND_SIZE * math.cos(each)), round(_AROUND_SIZE * math.sin(each))) for each in angles]
        self._always = [each for each in dict.fromkeys([*lines, *map(reverse, lines), *around]) if bits(each) <= MOST_BITS]

    def __repr__(self) -> str:
        return f"<Gathering in {self._shooter!r}, {len(self._always)} directions>"

    def search(self, state: InformationState) -> list[Direction] | None:
        """Return motions after which there are fewer points, None if none were found.

        Parameters
        ----------
        state
            Points only, at least two.
        """
        order = count()
        queue: list[tuple[float, int, Points, list[Direction]]] = [(0.0, next(order), state.points, [])]
        seen = {key(state.points, self._shooter)}
        for _ in range(_TRIES):
            if not queue:
                return None
            _, _, points, taken = heappop(queue)
            ways = self._ways(points)
            images = self._transition.points(points, ways)
            sizes = np.array([len({point.place for point in each}) for each in images])
            costs = sizes + self._distances.spans(np.array([[point.edge for point in each] for each in images]))
            if sizes.min() < len(points):
                fewest = np.flatnonzero(sizes == sizes.min())
                return [*taken, ways[int(fewest[costs[fewest].argmin()])]]
            for at in np.argsort(costs, kind="stable")[:_KEPT].tolist():
                name = key(images[at], self._shooter)
                if name not in seen:
                    seen.add(name)
                    heappush(queue, (len(taken) + float(costs[at]), next(order), images[at], [*taken, ways[at]]))
        return None

    def _ways(self, points: Points) -> list[Direction]:
        walls = Counter(edge for point in points for edge in edges_of(self._shooter, point))
        lines = sorted({wall_direction(self._shooter, edge) for edge, held in walls.items() if held > 1})
        return list(dict.fromkeys([*lines, *map(reverse, lines), *self._always]))
