"""`Contact`: whether a disk in a map touches something that is not free."""

import math

import numpy as np

from ial.maps.grids.occupancy_grid import FREE, OccupancyGrid
from ial.pose import Pose


class Contact:
    """A disk in a map. What lies outside of the map is not free.

    Parameters
    ----------
    grid
        The map.
    radius_m
        The radius of the disk, in metres.
    """

    def __init__(self, grid: OccupancyGrid, radius_m: float) -> None:
        self.grid, self.radius_m = grid, radius_m
        self._reach = math.ceil(radius_m / grid.resolution) + 1  # cells beside its own in which there can be what it touches
        self._blocked = ~np.pad(grid.mask(FREE), self._reach)

    def __repr__(self) -> str:
        return f"<Contact of a disk of {self.radius_m:g} m in {self.grid!r}>"

    def touches(self, pose: Pose) -> bool:
        """Return whether a cell that is not free is nearer to a pose of the map frame than the radius, or holds it."""
        at = self.grid.pose_to_grid(pose)
        place = np.array([at.y, at.x]) / self.grid.resolution
        if not ((place >= 0.0) & (place < self.grid.cells.shape)).all():
            return True
        row, column = (int(each) for each in np.floor(place))
        around = self._blocked[row : row + 2 * self._reach + 1, column : column + 2 * self._reach + 1]
        cells = np.argwhere(around) + np.array([row - self._reach, column - self._reach])
        away = np.maximum(np.maximum(cells - place, place - (cells + 1)), 0.0)
        return bool(((away**2).sum(axis=1) < (self.radius_m / self.grid.resolution) ** 2).any() or around[self._reach, self._reach])
