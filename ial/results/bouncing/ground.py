"""`BounceGround`: the environment of a bouncing robot as a layer of a picture, in metres of its own frame."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb

from ial.bouncing.filters.setting import Setting
from ial.maps.polygons.raster import Raster
from ial.results.palette import EDGE, FREE, OCCUPIED, UNKNOWN

_FEW_CELLS = 40  # along a side; with more, lines between cells would hide what is drawn on them
NO_CELL = "#4a5058"
FloatArray = npt.NDArray[np.float64]

BRIGHT = ("#1b6ca8", "#e8a33d", "#1b9e77", "#8e1b5e", "#6f4e9c", "#17a2b8", "#a0522d", "#d16ba5", "#7a8b1f", "#0b2545")
"""Colours that are told apart beside each other."""


@dataclass(frozen=True, eq=False)
class BounceGround:
    """Where the robot can be, and where cells lie.

    Parameters
    ----------
    name
        The environment.
    raster
        Its free cells.
    whole
        Whether these are all; if not, nothing is known about the others.
    """

    name: str
    raster: Raster
    whole: bool = True

    @classmethod
    def of_setting(cls, setting: Setting, places: Sequence[tuple[npt.NDArray[np.int32], npt.NDArray[np.int32]]]) -> list["BounceGround"]:
        """Return grounds of which only some cells are known to be free.

        Parameters
        ----------
        setting
            What a filter was built for.
        places
            The rows and the columns of these cells for each environment.
        """
        grounds = []
        for name, (x, y), (rows, columns) in zip(setting.names, setting.corners, places, strict=True):
            free = np.zeros((rows.max(initial=0) + 1, columns.max(initial=0) + 1), dtype=np.bool_)
            free[rows, columns] = True
            grounds.append(cls(name, Raster(free, setting.cell, x, y), False))
        return grounds

    @property
    def extent(self) -> tuple[float, float, float, float]:
        """Left, right, bottom and top in metres."""
        rows, columns = self.raster.free.shape
        cell, x, y = float(self.raster.cell), float(self.raster.x), float(self.raster.y)
        return x, x + cell * columns, y, y + cell * rows

    @property
    def shape(self) -> float:
        """The height as a part of the width."""
        rows, columns = self.raster.free.shape
        return float(rows / columns)

    def centres(self, rows: npt.ArrayLike, columns: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Return x and y of the centres of cells, in metres."""
        cell, (left, _, bottom, _) = float(self.raster.cell), self.extent
        return left + cell * (np.asarray(columns) + 0.5), bottom + cell * (np.asarray(rows) + 0.5)

    def draw(self, axes: Axes, pixels: npt.NDArray[np.float64] | None = None) -> None:
        """Draw the free cells white, or in RGB pixels of shape (rows, columns, 3), and all others dark, or grey if they are unknown."""
        free, other = self.raster.free, NO_CELL if self.whole else UNKNOWN
        shown = np.where(free[..., None], np.array(to_rgb(FREE)) if pixels is None else pixels, np.array(to_rgb(other)))
        left, right, bottom, top = self.extent
        axes.imshow(shown, origin="lower", extent=(left, right, bottom, top), interpolation="nearest", zorder=0)
        rows, columns = free.shape
        if max(rows, columns) <= _FEW_CELLS:
            cell = float(self.raster.cell)
            axes.vlines(left + cell * np.arange(columns + 1), bottom, top, color=EDGE, linewidth=0.35, alpha=0.6, zorder=1)
            axes.hlines(bottom + cell * np.arange(rows + 1), left, right, color=EDGE, linewidth=0.35, alpha=0.6, zorder=1)
        frame(axes, self.extent)
        axes.set_facecolor(OCCUPIED if self.whole else UNKNOWN)


def frame(axes: Axes, extent: tuple[float, float, float, float]) -> None:
    """Show a panel from left, right, bottom and top in metres, with a little around them."""
    left, right, bottom, top = extent
    margin = 0.02 * max(right - left, top - bottom)
    axes.set(xlim=(left - margin, right + margin), ylim=(bottom - margin, top + margin), aspect="equal")
    axes.locator_params(nbins=6)
    axes.tick_params(labelsize=7.5, colors="#444444", length=2.5)
    for spine in axes.spines.values():
        spine.set_color(EDGE)
