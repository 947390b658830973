"""`Failures`: where in a map the beams of a whole run fail."""

from pathlib import Path

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import FloatArray
from ial.errors import OutputError
from ial.maps.grids.occupancy_grid import OccupancyGrid

_CELL_M = 0.2  # finer than a piece of furniture, coarse enough to hold several beams

Counts = npt.NDArray[np.int32]


class Failures:
    """Counts beams by the place where they end, or where the map says that they should have ended.

    Parameters
    ----------
    grid
        The map; its frame is that of the counts.

    Attributes
    ----------
    good
        Beams that end at an obstacle of the map, by where they end; int32 of shape (rows, columns).
    ended
        Beams that end where the map has nothing: something new stands there.
    passed
        Beams that went through an obstacle of the map, by where they met it: something has gone from there.
    cell_m
        Width of a cell of the counts.
    """

    def __init__(self, grid: OccupancyGrid) -> None:
        self.grid = grid
        self.cell_m = grid.resolution * max(1, round(_CELL_M / grid.resolution))
        shape = tuple(int(np.ceil(side / self.cell_m)) for side in (grid.height_m, grid.width_m))
        self.good: Counts = np.zeros(shape, dtype=np.int32)
        self.ended: Counts = np.zeros(shape, dtype=np.int32)
        self.passed: Counts = np.zeros(shape, dtype=np.int32)

    def __repr__(self) -> str:
        failed = int(self.ended.sum() + self.passed.sum())
        return f"<Failures: {failed} of {failed + int(self.good.sum())} beams>"

    def count(self, counts: Counts, points: FloatArray) -> None:
        """Add one for each point, in the grid's frame, shape (n, 2), to one of the three counts; those outside the map are left out."""
        column, row = np.floor(points / self.cell_m).astype(np.int64).T
        within = (row >= 0) & (row < counts.shape[0]) & (column >= 0) & (column < counts.shape[1])
        np.add.at(counts, (row[within], column[within]), 1)

    @property
    def share(self) -> FloatArray:
        """The share of the beams of each cell that failed there, NaN where there was none."""
        failed = self.ended + self.passed
        seen = failed + self.good
        return np.asarray(np.where(seen > 0, failed / np.maximum(seen, 1), np.nan))

    def save(self, path: Path) -> None:
        """Write ``failures.npz``: the three counts, ``cell_m``, and ``origin`` (x, y, θ of the lower left corner in the map frame).

        Raises
        ------
        OutputError
            If it cannot be written.
        """
        at = self.grid.origin
        try:
            with path.open("wb") as file:
                origin = np.array([at.x, at.y, at.theta])
                np.savez_compressed(file, good=self.good, ended=self.ended, passed=self.passed, cell_m=self.cell_m, origin=origin)
        except OSError as error:
            raise OutputError(f"{path}: cannot be written ({error.strerror or error}); choose another folder") from None
