"""`Obstacles`: the occupied cells of a map as closed squares, and what lies near them, in plain NumPy.

Cells are taken a little smaller where something must be near them, and a little larger where something must keep off them; so rounding
never makes an answer out of nothing.
"""

import functools

import numpy as np
import numpy.typing as npt
from scipy import ndimage
from scipy.spatial import cKDTree

from ial.maps.grids.occupancy_grid import OCCUPIED, OccupancyGrid

SLACK_M = 1e-9
"""So much is kept off every bound, and 2⁻⁴⁰ of the largest number: thousands of times what doubles round."""

_FAR_CELLS = 64.0  # where more than this may be near, every cell is tried
_AT_ONCE = 1 << 20  # numbers that are held at a time

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]
IndexArray = npt.NDArray[np.intp]


class Obstacles:
    """The occupied cells of a map, in the grid's frame.

    Parameters
    ----------
    grid
        The map.
    """

    def __init__(self, grid: OccupancyGrid) -> None:
        self.resolution = grid.resolution
        self.mask = grid.mask(OCCUPIED)
        self._windows: dict[int, tuple[BoolArray, BoolArray]] = {}

    def __repr__(self) -> str:
        return f"<Obstacles: {np.count_nonzero(self.mask)} occupied cells of {self.resolution:g} m>"

    @functools.cached_property
    def _tree(self) -> cKDTree:
        return cKDTree((np.argwhere(self.mask)[:, ::-1] + 0.5) * self.resolution)

    def distances(self, points: FloatArray) -> FloatArray:
        """Return how far points are from the nearest closed occupied cell, rounded to nearest, shape (n,); points of shape (n, 2)."""
        half = 0.5 * self.resolution
        centre, _ = self._tree.query(points)
        # The nearest square is one of those whose middles are hardly farther than the nearest middle: the corner of one against the side
        # of the other.
        near = self._tree.query_ball_point(points, centre + (2.0**0.5 - 1.0 + 1e-9) * half)
        count = np.array([len(each) for each in near], dtype=np.intp)
        row = np.repeat(np.arange(len(points)), count)
        aside = np.maximum(np.abs(points[row] - self._tree.data[np.concatenate(near).astype(np.intp)]) - half, 0.0)
        nearest = np.full(len(points), np.inf)
        np.minimum.at(nearest, row, np.hypot(aside[:, 0], aside[:, 1]))
        return nearest

    def near(self, starts: FloatArray, ends: FloatArray, distance: float) -> BoolArray:
        """Return which segments certainly come within a distance of a closed occupied cell, shape (n,).

        Parameters
        ----------
        starts, ends
            float64 of shape (n, 2); a point is a segment whose ends are the same.
        distance
            In metres, Euclidean; exactly as far counts.
        """
        within = np.zeros(len(starts), dtype=np.bool_)
        if not len(starts):
            return within
        middles = 0.5 * (starts + ends)
        reach = 0.5 * float(np.abs(ends - starts).max()) + distance
        slack = slack_m(starts, ends, distance)
        wide = reach > _FAR_CELLS * self.resolution
        ring = 0 if wide else int(reach / self.resolution) + 1
        for rows in portions(len(starts), int(self.mask.sum()) if wide else (2 * ring + 1) ** 2):
            row, cells = self._all_occupied(rows) if wide else self.occupied_around(middles[rows], ring)
            corners = cells.T.astype(np.float64)
            low, high = corners * self.resolution + slack, (corners + 1.0) * self.resolution - slack
            a, b = starts[rows][row].T, ends[rows][row].T
            aside = np.maximum(low - np.maximum(a, b), np.minimum(a, b) - high)
            likely = np.flatnonzero(np.maximum(aside[0], aside[1]) <= distance)
            close = _gaps(a[:, likely], b[:, likely], low[:, likely], high[:, likely]) <= distance
            within[rows.start + row[likely[close]]] = True
        return within

    def _all_occupied(self, rows: slice) -> tuple[IndexArray, IndexArray]:
        """Return what `occupied_around` does, with every cell for each of some rows."""
        row, column = np.nonzero(self.mask)
        count = rows.stop - rows.start
        return np.repeat(np.arange(count), len(row)), np.tile(np.stack([column, row], axis=1), (count, 1))

    def occupied_around(self, points: FloatArray, ring: int) -> tuple[IndexArray, IndexArray]:
        """Return the occupied cells around the cells that hold points: the row of the point, and (column, row) of the cell.

        Parameters
        ----------
        points
            float64 of shape (n, 2).
        ring
            How many cells around that cell are looked at, in each direction.

        Returns
        -------
        row, cells
            Of shape (m,) and (m, 2).
        """
        mask, any_near = self._window(ring)
        pad = (len(mask) - len(self.mask)) // 2
        last = np.array(self.mask.shape[::-1]) + ring
        at = np.clip(np.floor(points / self.resolution), -ring - 1, last).astype(np.intp)
        width = mask.shape[1]
        middle = (at[:, 1] + pad) * width + at[:, 0] + pad
        rows = np.flatnonzero(any_near.reshape(-1)[middle])
        # Many points lie in one cell: each cell is looked around once.
        middles, which = np.unique(middle[rows], return_inverse=True)
        side = np.arange(-ring, ring + 1)
        offsets = (side[:, None] * width + side).reshape(-1)
        centre, step = np.nonzero(mask.reshape(-1)[middles[:, None] + offsets])
        count = np.bincount(centre, minlength=len(middles))
        first = np.cumsum(count) - count
        row = np.repeat(np.arange(len(rows)), count[which])
        entry = first[which[row]] + np.arange(len(row)) - np.repeat(np.cumsum(count[which]) - count[which], count[which])
        cell = middles[centre[entry]] + offsets[step[entry]]
        return rows[row], np.stack([cell % width - pad, cell // width - pad], axis=1)

    def any_around(self, points: FloatArray, ring: int) -> BoolArray:
        """Return whether a cell is occupied so many cells around the one that holds each point, shape (...); points (..., 2)."""
        mask, any_near = self._window(ring)
        pad = (len(mask) - len(self.mask)) // 2
        last = np.array(self.mask.shape[::-1]) + ring
        at = np.clip(np.floor(points / self.resolution), -ring - 1, last).astype(np.intp) + pad
        return np.asarray(any_near.reshape(-1)[at[..., 1] * mask.shape[1] + at[..., 0]])

    def _window(self, ring: int) -> tuple[BoolArray, BoolArray]:
        """Return the occupied cells with room around them, and in which cells one is within so many cells, in each direction."""
        if ring not in self._windows:
            padded = np.pad(self.mask, 2 * ring + 2)
            self._windows[ring] = padded, ndimage.maximum_filter(padded, 2 * ring + 1, mode="constant", cval=False)
        return self._windows[ring]


def slack_m(*lengths: npt.ArrayLike) -> float:
    """Return how much is kept off a bound where numbers of this size were computed with (m)."""
    largest = max((float(np.abs(each).max(initial=0.0)) for each in map(np.asarray, lengths)), default=0.0)
    return SLACK_M + 2.0**-40 * largest


def portions(count: int, each: int) -> list[slice]:
    """Return slices of a number of rows, so that not too many numbers are held at a time if each row takes `each`."""
    step = max(1, _AT_ONCE // max(each, 1))
    return [slice(start, min(start + step, count)) for start in range(0, count, step)]


def _gaps(a: FloatArray, b: FloatArray, low: FloatArray, high: FloatArray) -> FloatArray:
    """Return the distance of segments from squares, column by column: at an end of the segment or at a corner, unless they meet."""
    gaps = np.minimum(_to_squares(a, low, high), _to_squares(b, low, high))
    along = b - a
    squared = np.maximum(along[0] ** 2 + along[1] ** 2, np.finfo(np.float64).tiny)
    for x in (low[0], high[0]):
        for y in (low[1], high[1]):
            u, v = x - a[0], y - a[1]
            share = np.clip((u * along[0] + v * along[1]) / squared, 0.0, 1.0)
            gaps = np.minimum(gaps, np.hypot(u - share * along[0], v - share * along[1]))
    return np.where(_meet(a, along, low, high), 0.0, gaps)


def _to_squares(points: FloatArray, low: FloatArray, high: FloatArray) -> FloatArray:
    x, y = np.maximum(np.maximum(low - points, points - high), 0.0)
    return np.asarray(np.hypot(x, y))


def _meet(a: FloatArray, along: FloatArray, low: FloatArray, high: FloatArray) -> BoolArray:
    """Return which segments pass through squares: somewhere between their ends they are within both pairs of sides."""
    with np.errstate(divide="ignore", invalid="ignore"):
        first, second = (low - a) / along, (high - a) / along
    inside = (low <= a) & (a <= high)
    parallel = along == 0.0
    enter = np.where(parallel, np.where(inside, -np.inf, np.inf), np.minimum(first, second))
    leave = np.where(parallel, np.where(inside, np.inf, -np.inf), np.maximum(first, second))
    return np.asarray(np.maximum(np.maximum(*enter), 0.0) <= np.minimum(np.minimum(*leave), 1.0))
