"""Symmetries of a map: rotations after which it looks the same, so that no scan can tell one place from its image."""

import math

import numpy as np

from ial.contractors.kernels import kernel
from ial.maps.grids.occupancy_grid import OCCUPIED, OccupancyGrid
from ial.pose import Pose


@kernel
def _extent(cells, kinds):  # type: ignore[no-untyped-def]
    """Return the first and one past the last row and column with a cell of a kind other than 0."""
    rows, columns = cells.shape
    low_row, high_row, low_column, high_column = rows, -1, columns, -1
    for row in range(rows):
        for column in range(columns):
            if kinds[cells[row, column]]:
                low_row, high_row = min(low_row, row), row
                low_column, high_column = min(low_column, column), max(high_column, column)
    return low_row, high_row + 1, low_column, high_column + 1


@kernel
def _alike(cells, kinds, extent, quarters):  # type: ignore[no-untyped-def]
    """Return whether the cells within an extent keep their kinds in a rotation about its middle by so many quarter turns."""
    row0, row1, column0, column1 = extent
    rows, columns = row1 - row0, column1 - column0
    if quarters != 2 and rows != columns:
        return False
    for row in range(rows):
        for column in range(columns):
            if quarters == 2:
                there = (rows - 1 - row, columns - 1 - column)
            elif quarters == 1:
                there = (column, rows - 1 - row)
            else:
                there = (rows - 1 - column, row)
            if kinds[cells[row0 + row, column0 + column]] != kinds[cells[row0 + there[0], column0 + there[1]]]:
                return False
    return True


def symmetries(grid: OccupancyGrid, domain: tuple[int, ...]) -> tuple[Pose, ...]:
    """Return the rotations by quarter turns, other than none, that map the occupied cells and the domain exactly onto themselves.

    Parameters
    ----------
    grid
        The map.
    domain
        The classes of cells in which the robot may be; other cells that are not occupied do not matter.

    Returns
    -------
    tuple of Pose
        Transforms of the grid frame: the image of a pose is ``symmetry @ pose``. A mirrored map is no symmetry, since a lidar tells left
        from right; nor is a repeated room in a map that ends somewhere.
    """
    kinds = np.zeros(256, dtype=np.uint8)
    kinds[list(domain)] = 1
    kinds[OCCUPIED] = 2
    # Cell by cell, until the first that differs: large maps are not copied.
    extent = _extent(grid.cells, kinds)
    if extent[0] >= extent[1]:
        return ()
    x, y = (0.5 * (low + high) * grid.resolution for low, high in (extent[2:], extent[:2]))
    turns = [quarters for quarters in (1, 2, 3) if _alike(grid.cells, kinds, extent, quarters)]
    return tuple(Pose(x, y) @ Pose(0.0, 0.0, 0.5 * math.pi * quarters) @ Pose(-x, -y) for quarters in turns)
