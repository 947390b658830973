"""`FlatTable`: a summed-area table as one line of numbers, in which the corners of a rectangle are found without a test."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ial.contractors.kernels import kernel
from ial.lidar.search.rectangle_indices import rectangle_indices
from ial.maps.grids.cell_table import BORDER


class FlatTable(NamedTuple):
    """A table of occupied cells; see `CellTable.bordered`.

    Parameters
    ----------
    line
        Row after row, from the first corner of the first row on.
    stride
        How far apart rows are.
    rows, columns
        The largest indices.
    """

    line: npt.NDArray[np.int32]
    stride: np.uint64
    rows: np.int32
    columns: np.int32


@kernel
def flat_table(bordered):  # type: ignore[no-untyped-def]
    """Return a table with its border as one line."""
    rows, columns = np.int32(bordered.shape[0] - 1), np.int32(bordered.shape[1] - 1 - 2 * BORDER)
    return FlatTable(bordered.reshape(-1)[BORDER:], np.uint64(bordered.shape[1]), rows, columns)


@kernel
def ends_nowhere(table, bounds, i, xl, yl, xu, yu):  # type: ignore[no-untyped-def]
    """Return whether a beam certainly misses every occupied cell from all of a box: whether there is none where it can end.

    Parameters
    ----------
    table
        The `FlatTable` of the occupied cells.
    bounds
        Relative end points as `end_points.relative_bounds` writes them, float64 of shape (n, 4).
    i
        The number of the beam.
    xl, yl, xu, yu
        The box, as `rectangle_indices` takes it.
    """
    left, below, right, above = rectangle_indices(bounds, i, xl, yl, xu, yu, table.columns, table.rows)
    low, high = np.uint64(below) * table.stride, np.uint64(above) * table.stride
    near, far = np.uint64(left), np.uint64(right)
    return table.line[high + far] - table.line[low + far] - table.line[high + near] + table.line[low + near] == 0
