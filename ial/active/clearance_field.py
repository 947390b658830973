"""`ClearanceField`: from how far off a place certainly is whatever is not free; a lower bound for every part of a map's cells."""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy import ndimage

from ial.contractors.margins import BELOW
from ial.errors import MapError
from ial.maps.grids.occupancy_grid import FREE, MaskArray, OccupancyGrid

FloatArray = npt.NDArray[np.float64]

_FINEST, _MOST_PLACES = 4, 2**24


@dataclass(frozen=True, eq=False)
class ClearanceField:
    """Distances to the nearest cell that is not free; what lies outside of the map is not free.

    Parameters
    ----------
    distance_m
        For each place, the least distance (m) of any of its points to any point of a closed cell that is not free, rounded down; float64
        of shape (rows, columns).
    place_m
        The width of a place: of a cell, or of a half or a quarter of one. The distance of a point is larger than that of its place by the
        diagonal of a place at most.
    """

    distance_m: FloatArray
    place_m: float

    def __repr__(self) -> str:
        rows, columns = self.distance_m.shape
        return f"<ClearanceField of {rows} × {columns} places, up to {self.distance_m.max(initial=0.0):g} m>"

    @classmethod
    def of(cls, grid: OccupancyGrid, least_m: float) -> "ClearanceField":
        """Return the field of a map.

        Raises
        ------
        MapError
            If a robot that keeps such a distance fits nowhere.
        """
        around = 2
        parts = next((each for each in range(_FINEST, 1, -1) if each**2 * grid.cells.size <= _MOST_PLACES), 1)
        free = np.pad(grid.mask(FREE), around)
        made = cls.of_mask(np.kron(~free, np.ones((parts, parts), dtype=np.bool_)), grid.resolution / parts)
        inside = slice(around * parts, -around * parts)
        distance = np.ascontiguousarray(made.distance_m[inside, inside])
        if not (distance >= least_m).any():
            raise MapError(f"the map has no free space for a robot that keeps {least_m:g} m; give a smaller radius or clearance")
        return cls(distance, made.place_m)

    @classmethod
    def of_mask(cls, mask: MaskArray, place_m: float) -> "ClearanceField":
        """Return the distances to the places of a mask, which has one at least; outside of it there is none."""
        # Squares k columns and l rows apart are max(k − 1, 0) and max(l − 1, 0) of their width apart: that is the distance between
        # centres, with each square of the mask grown by its neighbours.
        apart = ndimage.distance_transform_edt(~ndimage.binary_dilation(mask, np.ones((3, 3), dtype=np.bool_)))
        return cls(np.asarray(apart, dtype=np.float64) * (place_m * BELOW), place_m)

    @property
    def size_m(self) -> float:
        """The diagonal of the map (m)."""
        return math.hypot(*self.distance_m.shape) * self.place_m

    def at(self, x: npt.ArrayLike, y: npt.ArrayLike) -> FloatArray:
        """Return the bound at points of the grid's frame (m); 0 outside of the map."""
        column = np.floor(np.asarray(x) / self.place_m).astype(np.int64)
        row = np.floor(np.asarray(y) / self.place_m).astype(np.int64)
        rows, columns = self.distance_m.shape
        inside = (row >= 0) & (row < rows) & (column >= 0) & (column < columns)
        found = self.distance_m[np.where(inside, row, 0), np.where(inside, column, 0)]
        return np.asarray(np.where(inside, found, 0.0))
