"""Narrowing a box of poses to those from which enough beams can end at an occupied cell."""

import numpy as np

from ial.contractors.combinators.relaxation import covered
from ial.contractors.kernels import kernel
from ial.lidar.search.rectangle_indices import OFFSET, rectangle_indices
from ial.maps.grids.cell_index import columns_with_cells, count, rows_with_cells


@kernel
def narrow(xl, yl, xu, yu, bounds, q, table, low, high):  # type: ignore[no-untyped-def]
    """Return the hull (xl, yl, xu, yu) of the positions of a box that at least n − q beams allow; all in cells.

    Each beam's rectangle of end points is contracted to the hull of its occupied cells; going back along the beam leaves an interval of
    positions along each axis. Along each axis the relaxed intersection of these is taken. The margin in `bounds` (see `margins.MARGIN`)
    covers the rounding here.

    Parameters
    ----------
    xl, yl, xu, yu
        The box, less than `margins.NEAR` from the corner of the map.
    bounds
        Relative end points as `end_points.relative_bounds` writes them, float64 of shape (n, 4).
    q
        How many beams may fail, less than n.
    table
        Summed-area table of the occupied cells.
    low, high
        Working space, float64 of shape (2, n).
    """
    beams = len(bounds)
    rows = np.int32(table.shape[0] - 1)
    columns = np.int32(table.shape[1] - 1)
    kept = 0
    for i in range(beams):
        left, below, right, above = rectangle_indices(
            bounds, i, xl + OFFSET, yl + OFFSET, xu + (OFFSET + 1.0), yu + (OFFSET + 1.0), columns, rows
        )
        if left >= right or below >= above or count(table, below, above, left, right) == 0:
            continue
        first, end = columns_with_cells(table, below, above, left, right)
        low[0, kept] = max(xl, first - bounds[i, 2])
        high[0, kept] = min(xu, end - bounds[i, 0])
        first, end = rows_with_cells(table, below, above, left, right)
        low[1, kept] = max(yl, first - bounds[i, 3])
        high[1, kept] = min(yu, end - bounds[i, 1])
        if low[0, kept] <= high[0, kept] and low[1, kept] <= high[1, kept]:
            kept += 1
    x0, x1 = covered(np.sort(low[0, :kept]), np.sort(high[0, :kept]), beams - q)
    y0, y1 = covered(np.sort(low[1, :kept]), np.sort(high[1, :kept]), beams - q)
    if x0 > x1 or y0 > y1:
        return np.inf, np.inf, -np.inf, -np.inf
    return x0, y0, x1, y1
