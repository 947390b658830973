"""`Raster`: the free cells of an environment, decided exactly.

Cell (row, column) is a closed square; row 0 lies at the lower edge of the environment, column 0 at its left edge.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal, get_args

import numpy as np
import numpy.typing as npt

from ial.errors import ConfigError, MapError
from ial.maps.grids.occupancy_grid import check_size
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.polygon import Polygon, common_denominator, scaled
from ial.maps.polygons.ring import Point, edges

Rule = Literal["centre", "inside"]
MaskArray = npt.NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Raster:
    """A plane of square cells, each free or not.

    Parameters
    ----------
    free
        bool of shape (rows, columns), row 0 at the bottom.
    cell
        The width of a cell in metres.
    x, y
        The lower left corner in the frame of the environment, in metres.
    """

    free: MaskArray
    cell: Fraction = Fraction(1)
    x: Fraction = Fraction(0)
    y: Fraction = Fraction(0)

    def __repr__(self) -> str:
        rows, columns = self.free.shape
        return f"<Raster: {columns} × {rows} cells of {float(self.cell):g} m, {int(self.free.sum())} free>"


def rasterize(environment: Environment, cell: Fraction, rule: Rule = "centre") -> Raster:
    """Return which cells are free; nothing is rounded.

    Parameters
    ----------
    environment
        The free space, a closed set.
    cell
        The width of a cell in metres.
    rule
        ``centre``: a cell is free if its centre is, as in the paper. ``inside``: if all of it is free space, so that a robot in a free cell
        meets no obstacle, wherever it stands there.

    Raises
    ------
    ConfigError
        If the width of a cell is not positive, or the rule is unknown.
    MapError
        If there would be too many cells.
    """
    if cell <= 0:
        raise ConfigError(f"the width of a cell is {cell}; give a number greater than 0, in metres")
    if rule not in get_args(Rule):
        raise ConfigError(f"the rule {rule!r} for free cells is unknown; give 'inside' or 'centre'")
    x0, y0, x1, y1 = environment.bounds
    columns, rows = math.ceil((x1 - x0) / cell), math.ceil((y1 - y0) / cell)
    try:
        check_size(rows, columns)
    except MapError as error:
        raise MapError(f"cells of {float(cell):g} m are too small: {error}") from None
    free = np.zeros((rows, columns), dtype=np.bool_)
    for polygon in environment.polygons:
        shifted = [[((x - x0) / cell, (y - y0) / cell) for x, y in ring] for ring in polygon.rings]
        _fill(Polygon.trusted(tuple(shifted[0]), tuple(map(tuple, shifted[1:]))), rule, free)
    return Raster(free, cell, x0, y0)


def cover(environment: Environment, cell: Fraction) -> Raster:
    """Return the cells that together hold all of the free space, each with a part of it inside; in the frame of `rasterize`.

    Raises
    ------
    ConfigError, MapError
        As `rasterize`.
    """
    raster = rasterize(environment, cell, "centre")
    free = raster.free.copy()
    for polygon in environment.polygons:
        shifted = [tuple(((x - raster.x) / cell, (y - raster.y) / cell) for x, y in ring) for ring in polygon.rings]
        scale = common_denominator(shifted)
        for row, first, stop in _crossed([edge for ring in shifted for edge in edges(scaled(ring, scale))], scale):
            free[row, first:stop] = True
    return Raster(free, cell, raster.x, raster.y)


def _fill(polygon: Polygon, rule: Rule, free: MaskArray) -> None:
    """Mark the free cells of one polygon whose coordinates count cells."""
    scale = 2 * common_denominator(polygon.rings)  # even, so that centres are whole, too
    every = [edge for ring in polygon.rings for edge in edges(scaled(ring, scale))]
    marked = np.zeros_like(free)
    for row, first, stop in _centres(every, scale, free.shape[0]):
        marked[row, first:stop] = True
    if rule == "inside":
        for row, first, stop in _crossed(every, scale):
            marked[row, first:stop] = False
    free |= marked


def _centres(every: list[tuple[Point, Point]], scale: int, rows: int) -> Iterator[tuple[int, int, int]]:
    """Yield runs (row, first column, column past the last) of the cells whose centres lie in the closed polygon.

    The line through the centres of a row meets the polygon in the union of two sets of closed intervals: between the edges that reach
    above the line, and between those that reach below. Both count, so that points on the boundary are inside.
    """
    reached: list[list[tuple[Point, Point]]] = [[] for _ in range(rows)]
    for a, b in every:
        low, high = sorted((a[1], b[1]))
        for row in range(max(-((scale // 2 - low) // scale), 0), min((high - scale // 2) // scale + 1, rows)):
            reached[row].append((a, b))
    half = scale // 2
    for row, near in enumerate(reached):
        y = row * scale + half
        for above in (True, False):
            cut = [_at(a, b, y) for a, b in near if a[1] != b[1] and (y < max(a[1], b[1]) if above else y > min(a[1], b[1]))]
            cut.sort()
            for left, right in zip(cut[::2], cut[1::2], strict=True):
                yield row, int(-((half - left) // scale)), int((right - half) // scale) + 1


def _crossed(every: list[tuple[Point, Point]], scale: int) -> Iterator[tuple[int, int, int]]:
    """Yield runs of the cells whose open squares an edge meets."""
    for a, b in every:
        bottom, top = sorted((a[1], b[1]))
        for row in range(bottom // scale, -(-top // scale)):
            # Where the edge lies in the open strip of the row, it spans these columns; their ends are met by no open square.
            low, high = max(row * scale, bottom), min((row + 1) * scale, top)
            left, right = sorted((_at(a, b, low), _at(a, b, high)) if bottom < top else (a[0], b[0]))
            yield row, int(left // scale), int(-(-right // scale))


def _at(a: Point, b: Point, y: int) -> int | Fraction:
    """Return the x at which an edge that is not horizontal passes a y."""
    return a[0] if a[0] == b[0] else a[0] + Fraction((b[0] - a[0]) * (y - a[1]), b[1] - a[1])
