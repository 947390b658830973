"""`ExploredArea`: what a robot has seen so far, in the map, if it is in one of its possible poses now; and the frontiers of that."""

import math
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt
from scipy import ndimage

from ial.datasets.scan import LaserScan
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid
from ial.maps.grids.ray_casting import cast_rays
from ial.pose import Pose

FloatArray = npt.NDArray[np.float64]
MaskArray = npt.NDArray[np.bool_]

_RAYS = 1440
_FULL_TURN = 2.0 * math.pi


@dataclass(frozen=True)
class View:
    """What a lidar can see.

    Parameters
    ----------
    at
        Where it was, in the frame of the robot at its start.
    range_m
        How far it sees.
    first_rad, last_rad
        Its first and its last bearing.
    """

    at: Pose
    range_m: float
    first_rad: float
    last_rad: float

    @classmethod
    def of(cls, scan: LaserScan, robot: Pose) -> "View":
        """Return what the lidar of a scan could see from a pose of the robot."""
        last = scan.angle_min + (len(scan.ranges) - 1) * scan.angle_increment
        return cls(robot @ scan.mounting.pose, scan.range_max, min(scan.angle_min, last), max(scan.angle_min, last))


@dataclass(frozen=True)
class Frontier:
    """A border between what was seen and free space that was not.

    Parameters
    ----------
    x, y
        A cell of it near its middle, in the grid's frame, in metres.
    cells
        How many cells it has.
    """

    x: float
    y: float
    cells: int


@dataclass
class ExploredArea:
    """The views of a robot.

    Parameters
    ----------
    grid
        The map.
    """

    grid: OccupancyGrid
    views: list[View] = field(default_factory=list)
    _seen: tuple[Pose, int, MaskArray] | None = None

    def add(self, view: View) -> None:
        """Take in a view."""
        self.views.append(view)

    def seen(self, start: Pose) -> MaskArray:
        """Return which free cells were seen, if the robot has started at a pose in the grid's frame."""
        if self._seen is not None and _same(self._seen[0], start):
            _, count, seen = self._seen
        else:
            count, seen = 0, np.zeros(self.grid.cells.shape, dtype=np.bool_)
        for view in self.views[count:]:
            self._mark(seen, start @ view.at, view)
        self._seen = start, len(self.views), seen
        return seen

    def _mark(self, seen: MaskArray, laser: Pose, view: View) -> None:
        """Mark the free cells whose middle a view shows from a pose of the laser."""
        width = self.grid.resolution
        angles = np.linspace(-math.pi, math.pi, _RAYS, endpoint=False)
        reach = cast_rays(self.grid.mask(OCCUPIED), width, laser.x, laser.y, angles, view.range_m + width)
        reach = np.minimum(reach, view.range_m)
        cells = math.ceil(view.range_m / width) + 1
        row, column = math.floor(laser.y / width), math.floor(laser.x / width)
        rows = np.arange(max(row - cells, 0), min(row + cells + 1, self.grid.rows))
        columns = np.arange(max(column - cells, 0), min(column + cells + 1, self.grid.columns))
        dy, dx = (rows + 0.5)[:, None] * width - laser.y, (columns + 0.5) * width - laser.x
        way, angle = np.hypot(dx, dy), np.arctan2(dy, dx)
        ray = np.round((angle + math.pi) * (_RAYS / _FULL_TURN)).astype(np.int64) % _RAYS
        turned = (angle - laser.theta - view.first_rad) % _FULL_TURN
        shown = (way <= reach[ray]) & (turned <= view.last_rad - view.first_rad)
        shown &= self.grid.cells[np.ix_(rows, columns)] == FREE
        seen[np.ix_(rows, columns)] |= shown

    def frontiers(self, start: Pose, least_cells: int) -> list[Frontier]:
        """Return the frontiers of what was seen from a start, the largest first; those of fewer cells are left out."""
        seen = self.seen(start)
        beyond = (self.grid.cells == FREE) & ~seen & ndimage.binary_dilation(seen)
        labels, count = ndimage.label(beyond, np.ones((3, 3)))
        found = []
        for number in range(1, count + 1):
            cells = np.argwhere(labels == number)
            if len(cells) >= least_cells:
                row, column = cells[np.argmin(((cells - cells.mean(axis=0)) ** 2).sum(axis=1))]
                found.append(Frontier((column + 0.5) * self.grid.resolution, (row + 0.5) * self.grid.resolution, len(cells)))
        return sorted(found, key=lambda each: -each.cells)


def _same(one: Pose, other: Pose) -> bool:
    return math.hypot(one.x - other.x, one.y - other.y) < 0.1 and abs(math.remainder(one.theta - other.theta, _FULL_TURN)) < 0.02
