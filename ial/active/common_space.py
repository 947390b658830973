"""`CommonSpace`: where a robot can drive whichever of its possible poses is the true one, and the ways there.

Plans are made on a lattice in the map, seen from one of the poses. They only prefer: what is driven is checked for all poses again
(`safe_ways`), since a lattice knows groups of poses by their hulls.
"""

import math
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
from scipy import sparse
from scipy.sparse.csgraph import dijkstra

from ial.active.belief import Groups
from ial.active.clearance_field import ClearanceField
from ial.active.safe_way import Distances
from ial.pose import Pose

FloatArray = npt.NDArray[np.float64]

_DEAREST = 3.0  # by so many parts more costs a way without any clearance
_NEIGHBOURS = [(0, 1), (1, 0), (1, 1), (1, -1)]


class CommonSpace:
    """A lattice of places that are free for every group of poses.

    Parameters
    ----------
    here
        A possible pose (x, y, θ): places are named as they are seen from it, in the grid's frame.
    groups
        All that are possible.
    field
        The map.
    distances
        What the robot keeps to everything. Ways keep its radius, and longer ones are taken for more clearance.
    spacing_m
        The distance between places.
    """

    def __init__(self, here: FloatArray, groups: Groups, field: ClearanceField, distances: Distances, spacing_m: float) -> None:
        self.spacing_m = spacing_m
        self.here = Pose(*here.tolist())
        rows, columns = field.distance_m.shape
        self._columns = max(1, math.floor(columns * field.place_m / spacing_m))
        self._rows = max(1, math.floor(rows * field.place_m / spacing_m))
        x, y = np.meshgrid((np.arange(self._columns) + 0.5) * spacing_m, (np.arange(self._rows) + 0.5) * spacing_m)
        self._x, self._y = x.reshape(-1), y.reshape(-1)
        ahead, aside = _seen_from(self.here, self._x, self._y)
        away = np.hypot(ahead, aside)
        spare = np.full(len(self._x), np.inf)
        halves = 0.5 * groups.hulls.width()
        for (px, py, heading), (wide, high, _) in zip(groups.poses.tolist(), halves.tolist(), strict=True):
            cosine, sine = math.cos(heading), math.sin(heading)
            clear = field.at(px + cosine * ahead - sine * aside, py + sine * ahead + cosine * aside)
            spare = np.minimum(spare, clear - distances.radius_m - math.hypot(wide, high))
        free = (spare >= 0.0) | (away < spacing_m)  # it stands there
        wanted = distances.clearance_m - distances.radius_m + spacing_m
        self._dear = 1.0 + _DEAREST * np.clip((wanted - spare) / wanted, 0.0, 1.0)
        self._free = free
        self._own = field.at(self._x, self._y) >= distances.radius_m
        self._field, self._radius_m = field, distances.radius_m
        self._graph = self._linked(free)
        begin = int(self.places(self.here.x, self.here.y))
        (self._ways,), (self._before,) = dijkstra(self._graph, directed=False, indices=[begin], return_predecessors=True)

    def __repr__(self) -> str:
        return f"<CommonSpace: {int(self._free.sum())} of {len(self._free)} places>"

    def _linked(self, free: npt.NDArray[np.bool_]) -> sparse.csr_array:
        numbers = np.arange(len(free)).reshape(self._rows, self._columns)
        begins, ends, lengths = [], [], []
        for down, right in _NEIGHBOURS:
            one = numbers[: self._rows - down, max(-right, 0) : self._columns - max(right, 0)].reshape(-1)
            other = numbers[down:, max(right, 0) : self._columns - max(-right, 0)].reshape(-1)
            both = free[one] & free[other]
            begins.append(one[both])
            ends.append(other[both])
            lengths.append(0.5 * (self._dear[one] + self._dear[other])[both] * self.spacing_m * math.hypot(down, right))
        pair = np.concatenate(begins), np.concatenate(ends)
        return sparse.csr_array((np.concatenate(lengths), pair), shape=(len(free), len(free)))

    def places(self, x: npt.ArrayLike, y: npt.ArrayLike) -> npt.NDArray[np.int64]:
        """Return the places in which points of the grid's frame are; outside of the map, the nearest."""
        column = np.clip(np.floor(np.asarray(x) / self.spacing_m), 0, self._columns - 1)
        row = np.clip(np.floor(np.asarray(y) / self.spacing_m), 0, self._rows - 1)
        return np.asarray(row * self._columns + column, dtype=np.int64)

    def nearest(self, x: float, y: float, most_m: float) -> int | None:
        """Return the place nearest to a point that can be reached, at most so far from it; None if there is none."""
        away = np.hypot(self._x - x, self._y - y)
        away[np.isinf(self._ways)] = np.inf
        at = int(np.argmin(away))
        return at if away[at] <= most_m else None

    def towards(self, x: float, y: float) -> int | None:
        """Return the place that can be reached from which the way on to a point is the shortest, if the robot is where it is seen from.

        None if there is no way, even so.
        """
        away = np.hypot(self._x - x, self._y - y)
        away[~self._own] = np.inf
        target = int(np.argmin(away))
        if away[target] > 2.0 * self.spacing_m:
            return None
        (left,) = dijkstra(self._linked(self._own | self._free), directed=False, indices=[target])
        left[np.isinf(self._ways)] = np.inf
        at = int(np.argmin(left))
        return at if np.isfinite(left[at]) else None

    def views(self, every: int) -> list[int]:
        """Return the places that can be reached, one in so many rows and columns."""
        return [int(each) for each in np.flatnonzero(np.isfinite(self._ways) & self._thinned(every))]

    def blocked(self, groups: Groups, every: int) -> list[tuple[float, float]]:
        """Return places, one in so many rows and columns, that would be free from one pose of each group, and cannot be reached."""
        places = np.flatnonzero(np.isinf(self._ways) & self._own & self._thinned(every))
        ahead, aside = _seen_from(self.here, self._x[places], self._y[places])
        moved = moved_along(groups.poses, ahead, aside)
        free = (self._field.at(moved[..., 0], moved[..., 1]) >= self._radius_m).all(axis=1)
        return [self.point(each) for each in places[free].tolist()]

    def _thinned(self, every: int) -> npt.NDArray[np.bool_]:
        row, column = np.divmod(np.arange(len(self._x)), self._columns)
        return np.asarray((row % every == 0) & (column % every == 0))

    def cost_m(self, place: int) -> float:
        """Return what the best way to a place costs: its length, more where it is narrow (m); infinite if there is none."""
        return float(self._ways[place])

    def costs_from(self, place: int) -> FloatArray:
        """Return what the way from each place to this one costs (m); infinite where there is none."""
        (ways,) = dijkstra(self._graph, directed=False, indices=[place])
        return np.asarray(ways)

    def point(self, place: int) -> tuple[float, float]:
        """Return where a place is, in metres, in the grid's frame."""
        return float(self._x[place]), float(self._y[place])

    def path(self, place: int) -> list[tuple[float, float]]:
        """Return the places on the best way to a place, the first after the robot's own first."""
        found: list[int] = []
        while place >= 0 and self._ways[place] > 0.0:
            found.append(place)
            place = int(self._before[place])
        return [self.point(each) for each in reversed(found)]


def _seen_from(pose: Pose, x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return how far ahead of a pose and to its left points are."""
    cosine, sine = math.cos(pose.theta), math.sin(pose.theta)
    return cosine * (x - pose.x) + sine * (y - pose.y), cosine * (y - pose.y) - sine * (x - pose.x)


def moved_along(poses: FloatArray, ahead: npt.ArrayLike, aside: npt.ArrayLike) -> FloatArray:
    """Return where poses (x, y, θ) come if each moves by so much ahead and to its left, with its heading kept; shape (moves, poses, 3)."""
    cosine, sine = np.cos(poses[:, 2]), np.sin(poses[:, 2])
    forth, left = np.asarray(ahead)[:, None], np.asarray(aside)[:, None]
    x, y = poses[:, 0] + cosine * forth - sine * left, poses[:, 1] + sine * forth + cosine * left
    return np.stack([x, y, np.broadcast_to(poses[:, 2], x.shape)], axis=2)


def in_robot_frame(pose: Pose, points: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """Return points as seen from a pose: ahead and to the left, in metres."""
    x, y = np.array(points, dtype=np.float64).reshape(-1, 2).T
    return [(float(one), float(other)) for one, other in zip(*_seen_from(pose, x, y), strict=True)]
