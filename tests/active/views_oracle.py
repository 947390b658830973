"""What views can tell a robot that may be in one of several places: an exhaustive search that shares no code with the planners.

The lattice of views: places `VIEW_M` apart along the first heading of the robot and across it, its start being one of them. The robot gets
from one to another through the places of a finer lattice, `WAY_M` apart, that are free from every pose that is still possible.

The answer is judged twice. *Localizable*: it is even if all that is unsure is against it, with poses spread over the whole first set.
*Not*: even if all that is unsure is in its favour, there is left an exact copy of the true pose, moved by whole cells and turned by
quarter turns, that was possible at first. What is neither is *undecided*.
"""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt
from scipy import ndimage

from ial.contractors.boxes import Boxes
from ial.datasets.simulator import Lidar
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid
from ial.pose import Pose

FloatArray = npt.NDArray[np.float64]
MaskArray = npt.NDArray[np.bool_]
Verdict = Literal["localizable", "not", "undecided"]

WAY_M, PARTS = 0.1, 5
VIEW_M = PARTS * WAY_M
NEAR_M, NEAR_RAD = 0.5, 0.25  # of the true pose: that is localized
SPREAD_M, SPREAD_RAD = 0.25, 0.1  # of the poses that stand for a set
MOST_POSES = 1000
MOST_RAYS = 20_000  # at a time


@dataclass(frozen=True)
class Margins:
    """How all that is unsure is taken.

    Parameters
    ----------
    radius_m, clearance_m
        What the robot keeps to what is not free, on its way and where it looks, between middles of cells.
    differs_m
        Readings that differ by more are told apart.
    beside
        With how many readings on each side one is compared.
    bad
        So many of them may differ all the same.
    again
        Whether a second look from the start may tell something.
    """

    radius_m: float
    clearance_m: float
    differs_m: float
    beside: int
    bad: int
    again: bool


class ViewsOracle:
    """A map, and a robot in it.

    Parameters
    ----------
    grid
        The map.
    lidar
        The sensor, in the middle of the robot.
    radius_m, clearance_m
        What the robot keeps.
    allowed, real
        How many beams of a scan may be bad, and how many are.
    """

    def __init__(self, grid: OccupancyGrid, lidar: Lidar, radius_m: float, clearance_m: float, allowed: int, real: int) -> None:
        self.grid, self.lidar = grid, lidar
        # Against it: two cells on the diagonal, errors of position and of motion; readings from anywhere in a cube differ by half of its
        # diagonal. In its favour: two cells on the diagonal, and the steps of a ray.
        self.strict = Margins(radius_m + 0.15, clearance_m + 0.15, 0.3, 1, allowed + real + 2, again=False)
        self.lenient = Margins(radius_m - 0.1, clearance_m - 0.1, 0.03, 0, allowed - real, again=True)
        away = ndimage.distance_transform_edt(np.pad(grid.cells == FREE, 1))
        self._clear = np.asarray(away)[1:-1, 1:-1] * grid.resolution
        self._occupied = grid.cells == OCCUPIED

    def judge(self, truth: Pose, possible: Boxes) -> Verdict:
        """Return whether views tell a pose of the grid's frame from all others of a set but its images under a symmetry of the map."""
        at = np.array([truth.x, truth.y, truth.theta])
        images = np.stack([at, *self._images(at)])
        every = _apart(0.5 * (possible.lower + possible.upper), images)
        if not len(self._left(at, every, _spread(every), self.strict)):
            return "localizable"
        copies = _apart(self._copies(at, possible), images)
        return "not" if len(self._left(at, copies, np.arange(len(copies)), self.lenient)) else "undecided"

    def _images(self, at: FloatArray) -> list[FloatArray]:
        """Return the images of a pose under the turns that map the whole map onto itself."""
        same = [turns for turns in (1, 2, 3) if np.array_equal(np.rot90(self.grid.cells, -turns), self.grid.cells)]
        middle = np.array([0.5 * self.grid.width_m, 0.5 * self.grid.height_m])
        return [np.append(middle + _turned(at[:2] - middle, turns), at[2] + 0.5 * math.pi * turns) for turns in same]

    def _copies(self, at: FloatArray, possible: Boxes) -> FloatArray:
        """Return all poses of a set that are the given one moved by whole cells, after quarter turns."""
        width, found = self.grid.resolution, set()
        for turns in range(4):
            x, y = _turned(at[:2], turns).tolist()
            middle, half = 0.5 * (possible.lower[:, 2] + possible.upper[:, 2]), 0.5 * possible.width()[:, 2]
            heading = at[2] + 0.5 * math.pi * turns
            for row in np.flatnonzero(np.abs(_wrapped(heading - middle)) <= half).tolist():
                low, high = possible.lower[row, :2] - [x, y], possible.upper[row, :2] - [x, y]
                columns, rows = (range(math.ceil(a / width), math.floor(b / width) + 1) for a, b in zip(low, high, strict=True))
                found |= {(x + width * right, y + width * up, heading) for right in columns for up in rows}
        return np.array(sorted(found)).reshape(-1, 3)

    def _left(self, at: FloatArray, others: FloatArray, stands: npt.NDArray[np.int64], margins: Margins) -> FloatArray:
        """Return the other poses that no view tells from the true one which can be reached, as long as they are possible.

        Views are compared at those that stand for others, one for each; what is free is decided at all.
        """
        u, v, start = self._lattice(at)
        every, looked = others, np.zeros(u.shape, dtype=np.bool_)
        looked[start] = not margins.again
        while True:
            free = self._free(np.stack([at, *others]), u, v, margins)
            free[:, start[0], start[1]] = True  # it stands there
            labels, _ = ndimage.label(free[0])
            fresh = (labels == labels[start]) & free[1] & ~looked
            fresh &= (np.arange(u.shape[0])[:, None] % PARTS == start[0] % PARTS) & (np.arange(u.shape[1]) % PARTS == start[1] % PARTS)
            if not fresh.any() or not len(others):
                return others
            order = np.argsort(np.hypot(u[fresh], v[fresh]))
            looked |= fresh
            for ahead, aside in zip(u[fresh][order].tolist(), v[fresh][order].tolist(), strict=True):
                which, each = np.unique(stands, return_inverse=True)
                kept = ~self._tells(at, every[which], ahead, aside, margins)[each.reshape(-1)]
                others, stands = others[kept], stands[kept]

    def _lattice(self, at: FloatArray) -> tuple[FloatArray, FloatArray, tuple[int, int]]:
        """Return places, ahead and to the left of a pose, that cover the map, and which of them is the pose itself."""
        corners = np.array([(x, y) for x in (0.0, self.grid.width_m) for y in (0.0, self.grid.height_m)]) - at[:2]
        cosine, sine = math.cos(at[2]), math.sin(at[2])
        seen = np.column_stack([cosine * corners[:, 0] + sine * corners[:, 1], cosine * corners[:, 1] - sine * corners[:, 0]])
        low, high = np.floor(seen.min(axis=0) / WAY_M).astype(int), np.ceil(seen.max(axis=0) / WAY_M).astype(int)
        u, v = (WAY_M * np.arange(begin, end + 1) for begin, end in zip(low.tolist(), high.tolist(), strict=True))
        return *np.meshgrid(u, v, indexing="ij"), (-int(low[0]), -int(low[1]))

    def _free(self, poses: FloatArray, u: FloatArray, v: FloatArray, margins: Margins) -> MaskArray:
        """Return where on the lattice the robot can pass, and where it can look, whichever of some poses it has started in."""
        free = np.ones((2, *u.shape), dtype=np.bool_)
        for pose in poses:
            clear = self._at(self._clear, *_moved(pose, u, v), 0.0)
            free &= np.stack([clear >= margins.radius_m, clear >= margins.clearance_m])
        return free

    def _tells(self, at: FloatArray, others: FloatArray, ahead: float, aside: float, margins: Margins) -> MaskArray:
        """Return which poses a view tells from the true one."""
        if not len(others):
            return np.zeros(0, dtype=np.bool_)
        (seen,) = self._readings(np.array([[*_moved(at, ahead, aside), at[2]]]))
        theirs = self._readings(np.column_stack([*_moved(others.T, ahead, aside), others[:, 2]]))
        beams = np.flatnonzero(seen < self.lidar.range_max)
        beside = theirs[:, (beams[:, None] + np.arange(-margins.beside, margins.beside + 1)) % self.lidar.beams]
        differs = (beside.min(axis=2) > seen[beams] + margins.differs_m) | (beside.max(axis=2) < seen[beams] - margins.differs_m)
        return np.asarray(differs.sum(axis=1) > margins.bad)

    def _readings(self, poses: FloatArray) -> FloatArray:
        """Return what is read from poses: steps of half a cell along each beam, until there is something; as far as the range."""
        steps = np.arange(0.0, self.lidar.range_max, 0.5 * self.grid.resolution)
        bearings = self.lidar.angle_min + self.lidar.angle_increment * np.arange(self.lidar.beams)
        together = max(1, MOST_RAYS // self.lidar.beams)
        parts = []
        for begin in range(0, len(poses), together):
            part = poses[begin : begin + together]
            angles = (part[:, 2, None] + bearings)[..., None]
            x, y = part[:, 0, None, None] + steps * np.cos(angles), part[:, 1, None, None] + steps * np.sin(angles)
            hit = self._at(self._occupied, x, y, 0)
            parts.append(np.where(hit.any(axis=2), steps[hit.argmax(axis=2)], self.lidar.range_max))
        return np.concatenate(parts)

    def _at(self, values: npt.NDArray[np.generic], x: FloatArray, y: FloatArray, outside: float) -> npt.NDArray[np.generic]:
        """Return the values of the cells in which points are."""
        column, row = np.floor(x / self.grid.resolution).astype(np.int64), np.floor(y / self.grid.resolution).astype(np.int64)
        inside = (row >= 0) & (row < self.grid.rows) & (column >= 0) & (column < self.grid.columns)
        return np.where(inside, values[np.where(inside, row, 0), np.where(inside, column, 0)], outside)


def _spread(poses: FloatArray) -> npt.NDArray[np.int64]:
    """Return which pose stands for each, one for each cube; cubes are larger where there are too many."""
    size = np.array([SPREAD_M, SPREAD_M, SPREAD_RAD])
    while True:
        _, first, cube = np.unique(np.floor(poses / size).astype(np.int64), axis=0, return_index=True, return_inverse=True)
        if len(first) <= MOST_POSES:
            return np.asarray(first[cube.reshape(-1)])
        size *= 1.25


def _apart(poses: FloatArray, images: FloatArray) -> FloatArray:
    """Return the poses that are near to no image."""
    near = np.zeros(len(poses), dtype=np.bool_)
    for x, y, heading in images.tolist():
        near |= (np.hypot(poses[:, 0] - x, poses[:, 1] - y) < NEAR_M) & (np.abs(_wrapped(poses[:, 2] - heading)) < NEAR_RAD)
    return poses[~near]


def _moved(pose: FloatArray, ahead: npt.ArrayLike, aside: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Return where one comes from a pose so far ahead and to the left."""
    x, y, heading = pose
    return x + np.cos(heading) * ahead - np.sin(heading) * aside, y + np.sin(heading) * ahead + np.cos(heading) * aside


def _turned(point: FloatArray, quarters: int) -> FloatArray:
    cosine, sine = ((1, 0), (0, 1), (-1, 0), (0, -1))[quarters]
    return np.array([cosine * point[0] - sine * point[1], sine * point[0] + cosine * point[1]])


def _wrapped(angle: npt.ArrayLike) -> FloatArray:
    return np.asarray(np.remainder(np.asarray(angle) + math.pi, 2.0 * math.pi) - math.pi)
