"""Symmetries of a map: rotations after which it looks the same, so that no scan can tell one place from its image."""

import math

import numpy as np

from ial.maps.occupancy_grid import MaskArray
from ial.pose import Pose


def symmetries(*masks: MaskArray, resolution: float) -> tuple[Pose, ...]:
    """Return the rotations by quarter turns, other than none, that map each set of cells exactly onto itself.

    Parameters
    ----------
    masks
        Sets of cells, bool of the same shape (rows, columns), row 0 at the bottom: such as the occupied cells and the domain.
    resolution
        The width of a cell in metres.

    Returns
    -------
    tuple of Pose
        Transforms of the grid frame: the image of a pose is ``symmetry @ pose``. A mirrored map is no symmetry, since a lidar tells left
        from right; nor is a repeated room in a map that ends somewhere.
    """
    # By lines, since the places of all cells of a large map would not fit into the memory.
    rows, columns = (np.flatnonzero(np.any([mask.any(axis=axis) for mask in masks], axis=0)) for axis in (1, 0))
    if not len(rows):
        return ()
    top, right = rows[-1] + 1, columns[-1] + 1
    parts = [mask[rows[0] : top, columns[0] : right] for mask in masks]
    x, y = 0.5 * (columns[0] + right) * resolution, 0.5 * (rows[0] + top) * resolution
    found = []
    for quarters in (1, 2, 3):
        if all(np.array_equal(np.rot90(part, quarters), part) for part in parts):
            # With row 0 at the bottom, rot90 of the array turns the plane clockwise; the set of symmetries is the same either way.
            turn = Pose(0.0, 0.0, 0.5 * math.pi * quarters)
            found.append(Pose(x, y) @ turn @ Pose(-x, -y))
    return tuple(found)
