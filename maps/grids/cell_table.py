"""`CellTable`: a set of cells of a grid, as kernels take it."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

BORDER = 64
"""Columns on either side of a table that repeat its edge: rectangles up to this far outside are looked up without a test."""

Counts = npt.NDArray[np.int32 | np.uint16]


class CellTable(NamedTuple):
    """The summed-area table of a set of cells, and where it lies.

    Parameters
    ----------
    table
        Of shape (rows + 1, columns + 1): ``table[i, j]`` cells of the set lie in rows below i and columns below j.
    bordered
        The same table with `BORDER` more columns on either side, contiguous; `table` is a view of it.
    origin
        Row and column of its first cell in the grid.
    resolution, inverse_resolution
        The width of a cell in metres, and 1 / resolution rounded to nearest.
    """

    table: Counts
    bordered: Counts
    origin: tuple[int, int]
    resolution: float
    inverse_resolution: float

    @classmethod
    def of(cls, bordered: Counts, origin: tuple[int, int], resolution: float) -> "CellTable":
        """Return the table that lies in a bordered one."""
        return cls(bordered[:, BORDER : bordered.shape[1] - BORDER], bordered, origin, resolution, 1.0 / resolution)
