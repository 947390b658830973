"""`open_ways`: from which cells a robot can drive straight to which others, as far as each wall alone tells."""

import numpy as np
import numpy.typing as npt

from ial.contractors import threads
from ial.contractors.kernels import kernel
from ial.maps.polygons.raster import MaskArray, Raster
from ial.maps.polygons.wall_contact import raster_scale
from ial.maps.polygons.walls import FloatArray, Walls


@kernel
def _lies(left, x, y, near_x, near_y, far_x, far_y, cell, least):  # type: ignore[no-untyped-def]
    """Return whether a point certainly lies on one side of every line from a point of one cell to a point of another."""
    for i in range(4):
        px, py = near_x + cell * (i % 2), near_y + cell * (i // 2)
        for j in range(4):
            qx, qy = far_x + cell * (j % 2), far_y + cell * (j // 2)
            turn = (qx - px) * (y - py) - (qy - py) * (x - px)
            if (turn if left else -turn) <= least:
                return False
    return True


@kernel
def _beside(line, x, y, cell, least):  # type: ignore[no-untyped-def]
    """Return 1 if a cell certainly lies on the left of a line, −1 if on the right, 0 if neither."""
    ax, ay, bx, by = line
    left = right = True
    for i in range(4):
        turn = (bx - ax) * (y + cell * (i // 2) - ay) - (by - ay) * (x + cell * (i % 2) - ax)
        left, right = left and turn > least, right and turn < -least
    return 1 if left else -1 if right else 0


@kernel
def _mark_open(start, stop, free, offsets, cell, lines, least, ways):  # type: ignore[no-untyped-def]
    """Mark the open ways from the cells of rows start … stop − 1."""
    rows, columns = free.shape
    for row in range(start, stop):
        for column in range(columns):
            if not free[row, column]:
                continue
            x, y = cell * column, cell * row
            for at in range(len(offsets)):
                there, across = row + offsets[at, 1], column + offsets[at, 0]
                if not (0 <= there < rows and 0 <= across < columns and free[there, across]):
                    continue
                to_x, to_y = cell * across, cell * there
                blocked = False
                for wall in range(len(lines)):
                    ax, ay, bx, by = lines[wall]
                    if min(ax, bx) > max(x, to_x) + cell or max(ax, bx) < min(x, to_x):
                        continue
                    if min(ay, by) > max(y, to_y) + cell or max(ay, by) < min(y, to_y):
                        continue
                    side = _beside((ax, ay, bx, by), x, y, cell, least)
                    if side == 0 or _beside((ax, ay, bx, by), to_x, to_y, cell, least) != -side:
                        continue
                    # Who crosses a wall from its left to its right has its start on the right.
                    if _lies(side < 0, ax, ay, x, y, to_x, to_y, cell, least) and _lies(side > 0, bx, by, x, y, to_x, to_y, cell, least):
                        blocked = True
                        break
                ways[at, row, column] = not blocked


def open_ways(walls: Walls, raster: Raster, offsets: npt.NDArray[np.int64]) -> MaskArray:
    """Return which ways are open: from a free cell to another free one, unless a wall certainly crosses every straight way between the two.

    Parameters
    ----------
    walls
        The walls of the environment of the raster.
    raster
        The free cells.
    offsets
        (columns, rows) from the cell where a way begins to that where it ends, int64 of shape (ways, 2).

    Returns
    -------
    numpy.ndarray
        bool of shape (ways, rows, columns), by the cell where a way begins.
    """
    lines: FloatArray = np.stack([walls.x, walls.y, walls.x[walls.after], walls.y[walls.after]], axis=1)
    ways = np.zeros((len(offsets), *raster.free.shape), dtype=np.bool_)
    # A turn is a difference of two products of lengths below a scale: a few roundings of its square, for which the margin is far more.
    scale = raster_scale(walls, raster)
    least = walls.margin * (scale / walls.scale) * scale
    threads.run(_mark_open, len(raster.free), raster.free, offsets, float(raster.cell), lines, least, ways, minimum=4)
    return ways
