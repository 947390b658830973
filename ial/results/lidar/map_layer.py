"""The map as a layer of a picture, and sets of boxes painted on its cells."""

import math

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.colors import to_rgba
from matplotlib.transforms import Affine2D

from ial.contractors.boxes import Boxes
from ial.maps.grids.occupancy_grid import UNKNOWN, MaskArray, OccupancyGrid
from ial.results.palette import FREE, OCCUPIED
from ial.results.palette import UNKNOWN as UNKNOWN_COLOUR

_MARGIN_M = 1.0
_CELLS = 1 << 22  # above, several cells share a pixel, which is painted in the class that matters most
_ORDER = np.array([1, 2, 0], dtype=np.uint8)  # of free, occupied, unknown: what hides what
_COLOURS = np.array([to_rgba(colour) for colour in (UNKNOWN_COLOUR, FREE, OCCUPIED)], dtype=np.float32)

View = tuple[float, float, float, float]


class MapLayer:
    """A map to draw, in the map frame.

    Parameters
    ----------
    grid
        The map; only the part of it that is known is shown.
    """

    def __init__(self, grid: OccupancyGrid) -> None:
        self._grid = grid
        known = grid.cells != UNKNOWN
        rows, columns = np.flatnonzero(known.any(axis=1)), np.flatnonzero(known.any(axis=0))
        full = (0, grid.rows, 0, grid.columns)
        self._window = (int(rows[0]), int(rows[-1]) + 1, int(columns[0]), int(columns[-1]) + 1) if len(rows) else full
        row0, row1, column0, column1 = self._window
        self._factor = math.ceil(math.sqrt(max(1.0, (row1 - row0) * (column1 - column0) / _CELLS)))
        self._pixels = _COLOURS[_reduced(_ORDER[grid.cells[row0:row1, column0:column1]], self._factor)]

    def __repr__(self) -> str:
        return f"<MapLayer of {self._grid}>"

    @property
    def view(self) -> View:
        """What to show of the map frame, in metres: left, right, bottom, top."""
        row0, row1, column0, column1 = (self._grid.resolution * edge for edge in self._window)
        x, y, _ = self._grid.to_map([column0, column1, column0, column1], [row0, row0, row1, row1])
        return float(x.min()) - _MARGIN_M, float(x.max()) + _MARGIN_M, float(y.min()) - _MARGIN_M, float(y.max()) + _MARGIN_M

    def draw(self, axes: Axes, view: View | None = None) -> None:
        """Draw the map, and show a part of the plane, widened to the shape of the axes: all of the map by default."""
        self._show(axes, self._pixels, zorder=0)
        left, right, bottom, top = view or self.view
        shape = axes.get_window_extent()
        scale = max((right - left) / shape.width, (top - bottom) / shape.height)
        x, y, width, height = 0.5 * (left + right), 0.5 * (bottom + top), scale * shape.width, scale * shape.height
        axes.set(xlim=(x - 0.5 * width, x + 0.5 * width), ylim=(y - 0.5 * height, y + 0.5 * height), aspect="equal")
        axes.set_facecolor(UNKNOWN_COLOUR)

    def draw_boxes(self, axes: Axes, boxes: Boxes, colour: str) -> None:
        """Paint every cell that one of some boxes (x, y, …) of the grid frame meets."""
        row0, row1, column0, column1 = self._window
        mask = _reduced(covered_cells(boxes, self._grid)[row0:row1, column0:column1].astype(np.uint8), self._factor)
        pixels = np.zeros((*mask.shape, 4), dtype=np.float32)
        pixels[mask > 0] = to_rgba(colour, 0.85)
        self._show(axes, pixels, zorder=2)

    def draw_pixels(self, axes: Axes, pixels: npt.NDArray[np.float32], width_m: float) -> None:
        """Lay square pixels over the map, RGBA of shape (rows, columns, 4), the first one at the corner of the grid."""
        self._place(axes, pixels, width_m, 0.0, 0.0, zorder=2)

    def _show(self, axes: Axes, pixels: npt.NDArray[np.float32], zorder: int) -> None:
        row0, _, column0, _ = self._window
        width = self._grid.resolution
        self._place(axes, pixels, self._factor * width, column0 * width, row0 * width, zorder)

    def _place(self, axes: Axes, pixels: npt.NDArray[np.float32], cell: float, left: float, bottom: float, zorder: int) -> None:
        extent = (left, left + cell * pixels.shape[1], bottom, bottom + cell * pixels.shape[0])
        origin = self._grid.origin
        place = Affine2D().rotate(origin.theta).translate(origin.x, origin.y)
        axes.imshow(pixels, origin="lower", extent=extent, transform=place + axes.transData, zorder=zorder)


def _reduced(values: npt.NDArray[np.uint8], factor: int) -> npt.NDArray[np.uint8]:
    """Return the largest value of each square block; blocks at the end may be smaller."""
    if factor == 1:
        return values
    for axis in (0, 1):
        values = np.maximum.reduceat(values, np.arange(0, values.shape[axis], factor), axis=axis)
    return values


def covered_cells(boxes: Boxes, grid: OccupancyGrid) -> MaskArray:
    """Return which cells overlap one of the boxes (x, y, …), given in the grid frame; for pictures, rounded to nearest.

    Each box adds one to its cells by four numbers at its corners, and two running sums fill in the rest, so the cost is that of the map
    however many boxes there are.
    """
    first = np.floor(boxes.lower[:, :2] / grid.resolution + 1e-9)
    last = np.maximum(np.ceil(boxes.upper[:, :2] / grid.resolution - 1e-9), first + 1.0)
    first, last = (np.clip(edge, 0.0, (grid.columns, grid.rows)).astype(np.int64) for edge in (first, last))
    counts = np.zeros((grid.rows + 1, grid.columns + 1), dtype=np.int32)
    for rows, columns, sign in (
        (first[:, 1], first[:, 0], 1),
        (last[:, 1], last[:, 0], 1),
        (first[:, 1], last[:, 0], -1),
        (last[:, 1], first[:, 0], -1),
    ):
        np.add.at(counts, (rows, columns), sign)
    return np.asarray(counts.cumsum(axis=0, dtype=np.int32).cumsum(axis=1, dtype=np.int32)[:-1, :-1] > 0)
