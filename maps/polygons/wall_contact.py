"""`WallContact`: in which cells a disk can stand that touches a wall, and in which it certainly overlaps one.

Distances are computed to nearest and compared with a margin to spare: each is a root of two squares of products and differences of
coordinates, far fewer roundings than `Walls.margin` is made for. A cell that can hold a disk is never left out.
"""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
import numpy.typing as npt

from ial.contractors.margins import ABOVE, BELOW
from ial.maps.polygons.raster import MaskArray, Raster
from ial.maps.polygons.walls import FloatArray, Walls


def raster_scale(walls: Walls, raster: Raster) -> float:
    """Return a length that no distance between two points of an environment or of its raster exceeds, in metres.

    Large cells reach far beyond the walls; what is rounded about their corners grows with this, and so must margins.
    """
    rows, columns = raster.free.shape
    return max(walls.scale, float(np.hypot(rows, columns)) * float(raster.cell) * ABOVE)


@dataclass(frozen=True, eq=False)
class WallContact:
    """What the walls leave to the centre of a disk.

    Parameters
    ----------
    touching
        For each wall, the cells in which the centre can be while the disk touches the wall, its ends included: numbers of cells counted row
        by row, int64 each.
    overlapping
        Whether the disk overlaps one and the same wall from wherever in a cell its centre is, bool of shape (rows, columns).
    """

    touching: tuple[npt.NDArray[np.int64], ...]
    overlapping: MaskArray

    def __repr__(self) -> str:
        return f"<WallContact of {len(self.touching)} walls>"

    @classmethod
    def of(cls, walls: Walls, raster: Raster, radius: Fraction) -> "WallContact":
        """Return where a disk of some radius meets walls, for the cells of a raster of the same environment."""
        rows, columns = raster.free.shape
        margin = walls.margin * (raster_scale(walls, raster) / walls.scale)
        cell, least, most = float(raster.cell), float(radius) * BELOW - margin, float(radius) * ABOVE + margin
        overlapping = np.zeros(raster.free.shape, dtype=np.bool_)
        touching = []
        for wall in range(len(walls)):
            ends = np.array([[walls.x[at], walls.y[at]] for at in (wall, walls.after[wall])])
            first = np.maximum(np.floor((ends.min(axis=0) - most) / cell).astype(np.int64) - 1, 0)
            stop = np.minimum(np.floor((ends.max(axis=0) + most) / cell).astype(np.int64) + 2, [columns, rows])
            near, far = _distances(ends, np.arange(first[0], stop[0] + 1) * cell, np.arange(first[1], stop[1] + 1) * cell, margin)
            overlapping[first[1] : stop[1], first[0] : stop[0]] |= far < least
            row, column = np.nonzero((near <= most) & (far >= least))
            touching.append((row + first[1]) * columns + column + first[0])
        return cls(tuple(touching), overlapping)


def _distances(ends: FloatArray, x: FloatArray, y: FloatArray, margin: float) -> tuple[FloatArray, FloatArray]:
    """Return the least and the greatest distance of a segment from the points of each cell between neighbouring lines, (rows, columns)."""
    (ax, ay), (bx, by) = ends
    ex, ey = bx - ax, by - ay
    length = np.hypot(ex, ey)
    px, py = x[None, :] - ax, y[:, None] - ay
    along, side = (px * ex + py * ey) / length, (py * ex - px * ey) / length
    corners = np.hypot(along - np.clip(along, 0.0, length), side)
    far = _of_corners(np.maximum, corners)
    near = _of_corners(np.minimum, corners)
    for cx, cy in ends:
        dx, dy = np.maximum(np.maximum(x[:-1] - cx, cx - x[1:]), 0.0), np.maximum(np.maximum(y[:-1] - cy, cy - y[1:]), 0.0)
        near = np.minimum(near, np.hypot(dx[None, :], dy[:, None]))
    # A segment meets a square unless a line along an axis or along the segment lies between the two.
    crossed = (_of_corners(np.minimum, side) <= margin) & (_of_corners(np.maximum, side) >= -margin)
    crossed &= ((x[:-1] <= max(ax, bx) + margin) & (x[1:] >= min(ax, bx) - margin))[None, :]
    crossed &= ((y[:-1] <= max(ay, by) + margin) & (y[1:] >= min(ay, by) - margin))[:, None]
    return np.where(crossed, 0.0, near), far


def _of_corners(choose: np.ufunc, values: FloatArray) -> FloatArray:
    """Return the least or the greatest of the values at the four corners of each cell."""
    pairs = choose(values[:-1], values[1:])
    chosen: FloatArray = choose(pairs[:, :-1], pairs[:, 1:])
    return chosen
