"""`Lattice`: space and heading divided into equal cells, so that overlapping boxes can be replaced by cells that do not overlap."""

import functools
import math

import numpy as np

from ial.contractors.angles import wrapped
from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.intervals.angle import wrap_angle
from ial.contractors.intervals.trigonometric import PI_UPPER
from ial.contractors.kernels import kernel
from ial.contractors.margins import ABOVE
from ial.errors import ConfigError
from ial.lidar.margins import FITTING, MOST_PARTS
from ial.lidar.search.cell_bitmaps import CellBitmaps, IntArray, bitmaps_met, filled_bitmaps

_LARGEST_WORK = 1 << 22  # pairs of a box and a bitmap; beyond, a coarser lattice is taken
_TOO_MANY = 2.0  # times as many cells as there may be
_WORK_PER_CELL = 32  # the same for each cell that is wanted at most


class Lattice:
    """Cells of equal size over (x, y, θ); a coarser level doubles them along every axis.

    Parameters
    ----------
    position_m
        Width of a cell of the finest level along x and y; rounded up to 24 bits for each of its parts, so that cells, their halves and
        their parts have exact bounds.
    heading_rad
        The circle is divided into the smallest power of two of equal parts that are at most this wide.
    parts
        Into how many parts a cell is divided along x and along y where it is tried piece by piece.
    """

    def __init__(self, position_m: float, heading_rad: float, parts: int = 2) -> None:
        self.parts = parts
        self.part_m = _rounded_up(position_m / parts)
        self.position_m = parts * self.part_m
        self.layers = 1 << max(1, math.ceil(math.log2(2.0 * math.pi / heading_rad)))

    @property
    def widths(self) -> FloatArray:
        """Widths of a cell of the finest level, rounded up; float64 of shape (3,)."""
        return np.array([self.position_m, self.position_m, 2.0 * math.pi / self.layers]) * FITTING

    def root(self, width_m: float, height_m: float) -> Boxes:
        """Return one box around ``[0, width] × [0, height]`` and all headings, whose repeated bisection meets the cells."""
        side = self.position_m * 2.0 ** max(0, math.ceil(math.log2(max(width_m, height_m) / self.position_m)))
        while side < max(width_m, height_m):
            side *= 2.0
        return Boxes.of([(0.0, side), (0.0, side), (-PI_UPPER, PI_UPPER)])

    def layer(self, boxes: Boxes) -> IntArray:
        """Return in which layer of the finest level the headings of each cell begin, or those of a union of cells; int64 of shape (n,)."""
        return np.rint((boxes.lower[:, 2] + math.pi) * (self.layers / (2.0 * math.pi))).astype(np.int64)

    def cover(self, boxes: Boxes, max_cells: int, volume: float = 0.0) -> Boxes:
        """Return different cells of one level that together cover all boxes: the finest level on which they are at most `max_cells`.

        Parameters
        ----------
        boxes
            What to cover; headings may have any turn, and empty boxes are left out.
        max_cells
            How many cells there may be.
        volume
            A volume that the union of the boxes does not fall below by much: levels too fine for it are not tried.
        """
        boxes = wrapped(boxes, 2)
        boxes = boxes[~boxes.empty]
        if not len(boxes):
            return boxes
        for level in range(64):
            step, edges = self.position_m * 2.0**level, layer_edges(max(1, self.layers >> level))
            if volume > _TOO_MANY * max_cells * step**2 * 2.0 * math.pi / (len(edges) - 1):
                continue
            bitmaps = _few_bitmaps(boxes, step, edges, max_cells)
            if bitmaps is not None:
                return bitmaps.boxes(step, edges)
        return filled_bitmaps(_ranges(boxes, step, edges), len(edges) - 1).boxes(step, edges)

    def bitmaps(self, boxes: Boxes) -> CellBitmaps:
        """Return the cells of the finest level that together cover all boxes."""
        return filled_bitmaps(_ranges(boxes, self.position_m, layer_edges(self.layers)), self.layers)

    def few_bitmaps(self, boxes: Boxes, max_cells: int) -> CellBitmaps | None:
        """Return the same where they are at most `max_cells`, else None."""
        return _few_bitmaps(boxes, self.position_m, layer_edges(self.layers), max_cells)

    def boxes(self, bitmaps: CellBitmaps) -> Boxes:
        """Return cells of the finest level as boxes."""
        return bitmaps.boxes(self.position_m, layer_edges(self.layers))


def divide(resolution: float, position_m: float) -> tuple[int, int]:
    """Return into how many parts the cells of a map are split along an axis, and of how many such parts a cell of the lattice consists.

    The second number is at least 2: a cell of the answer is kept if one of its parts may hold a consistent pose. Parts exclude more than
    whole cells do, while whole cells keep what belongs together connected.

    Raises
    ------
    ConfigError
        If a cell of the lattice would consist of more cells of the map than `margins.MOST_PARTS` along an axis.
    """
    if 2.0 * resolution > position_m * FITTING:
        return math.ceil(2.0 * resolution / position_m / FITTING), 2
    parts = math.floor(position_m / resolution * FITTING)
    if parts > MOST_PARTS:
        raise ConfigError(
            f"precision.position_m is {position_m:g} m, {parts} cells of the map ({resolution:g} m each); give at most "
            f"{MOST_PARTS * resolution:g} m, or a map with larger cells"
        )
    return 1, parts


def _rounded_up(width: float) -> float:
    """Return a width of 24 significant bits. Its multiples are exact up to 2^29, and bisecting a multiple of a power of two meets them.

    With a width such as 0.1, bisection misses every third multiple by a bit, and a box that sticks out so far takes a whole cell more.
    """
    mantissa, exponent = math.frexp(width)
    return math.ldexp(math.ceil(math.ldexp(mantissa, 24)), exponent - 24)


@functools.lru_cache(maxsize=64)
def layer_edges(layers: int) -> FloatArray:
    """Return the boundaries of the headings' cells, those that `Boxes.bisect` makes of the circle, bit for bit."""
    edges = np.array([-PI_UPPER, PI_UPPER])
    while len(edges) <= layers:
        finer = np.empty(2 * len(edges) - 1)
        finer[::2] = edges
        finer[1::2] = edges[:-1] + 0.5 * (edges[1:] - edges[:-1])
        edges = finer
    edges.setflags(write=False)
    return edges


@kernel
def _cell_ranges(lower, upper, step, edges, ranges):  # type: ignore[no-untyped-def]
    """Fill `ranges` with the first and last cell of each box along x, y and θ; the θ cells are counted on beyond a turn.

    Bounds are compared exactly with those of the cells. Only for an arc beyond π is the last cell computed, rounded up: π, a sum, the width
    and a quotient, and how far a bound of a cell is from where its number says.
    """
    layers = len(edges) - 1
    width = 2.0 * math.pi / layers
    for row in range(len(lower)):
        for axis in range(2):
            # Multiples k·step are exact. A double beside one differs from it by 2⁻⁵³ of it or more, and a number that is rounded to k
            # differs from k by less: no quotient is rounded to k from below or from above, and both whole numbers are right.
            first = int(math.floor(lower[row, axis] / step))
            last = max(first, int(math.ceil(upper[row, axis] / step)) - 1)
            ranges[row, 2 * axis] = first
            ranges[row, 2 * axis + 1] = last
        start, stop = wrap_angle(lower[row, 2], upper[row, 2])
        first = min(max(int(math.floor((start + math.pi) / width)), 0), layers - 1)
        while first > 0 and edges[first] > start:
            first -= 1
        while first < layers - 1 and edges[first + 1] <= start:
            first += 1
        if stop > edges[layers]:
            last = max(int(math.floor((stop + math.pi) / width * ABOVE)), layers)
        else:
            last = min(max(int(math.floor((stop + math.pi) / width)), first), layers - 1)
            while edges[last + 1] < stop:
                last += 1
            while last > first and edges[last] >= stop:
                last -= 1
        ranges[row, 4] = first
        ranges[row, 5] = min(last, first + layers - 1)


def _ranges(boxes: Boxes, step: float, edges: FloatArray) -> IntArray:
    """Return the first and the last cell of each box along x, y and θ, int64 of shape (n, 6)."""
    ranges = np.empty((len(boxes), 6), dtype=np.int64)
    _cell_ranges(boxes.lower, boxes.upper, step, edges, ranges)
    return ranges


def _few_bitmaps(boxes: Boxes, step: float, edges: FloatArray, max_cells: int) -> CellBitmaps | None:
    ranges = _ranges(boxes, step, edges)
    layers = len(edges) - 1
    largest = (ranges[:, 1::2] - ranges[:, ::2] + 1).prod(axis=1).max(initial=0)
    if largest > max(max_cells, 8) or bitmaps_met(ranges, layers) > min(_LARGEST_WORK, _WORK_PER_CELL * max_cells):
        return None
    bitmaps = filled_bitmaps(ranges, layers)
    return bitmaps if len(bitmaps) <= max_cells else None
