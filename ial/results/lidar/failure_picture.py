"""A picture of where beams fail: what has come into the world since the map was made, and what has gone."""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.results.lidar.map_layer import MapLayer
from ial.results.palette import OFF_WALL, ON_WALL

if TYPE_CHECKING:
    Counts = npt.NDArray[np.int32]

_ENDED, _PASSED, _GOOD = OFF_WALL, "#1b6ca8", ON_WALL
_MANY = 5  # beams; a cell with fewer is paler


def draw_failures(path: Path, grid: OccupancyGrid, name: str, cell_m: float, good: "Counts", ended: "Counts", passed: "Counts") -> None:
    """Write a picture of counts of beams on a map.

    Parameters
    ----------
    path
        The PNG file.
    grid
        The map.
    name
        What was recorded.
    cell_m
        Width of a cell of the counts.
    good, ended, passed
        Beams that ended at an obstacle, where the map has nothing, and behind an obstacle that they went through, int32 of shape
        (rows, columns).
    """
    layer = MapLayer(grid)
    left, right, bottom, top = layer.view
    width, height = 13.0, min(max(13.0 * (top - bottom) / (right - left), 4.0), 13.0) + 1.0
    figure = Figure(figsize=(width, height), facecolor="white")
    FigureCanvasAgg(figure)
    axes = figure.add_axes((0.05, 0.5 / height, 0.93, 1.0 - 1.1 / height))
    layer.draw(axes)
    seen = np.maximum(good + ended + passed, 1)
    for counts, colour in ((good, _GOOD), (passed, _PASSED), (ended, _ENDED)):
        pixels = np.zeros((*counts.shape, 4), dtype=np.float32)
        pixels[..., :3] = to_rgb(colour)
        pixels[..., 3] = counts / seen * np.minimum(counts / _MANY, 1.0) * (0.35 if counts is good else 0.9)
        layer.draw_pixels(axes, pixels, cell_m)
    total = int(good.sum() + ended.sum() + passed.sum())
    words = ((_GOOD, "end at an obstacle", good), (_ENDED, "end where the map has none", ended), (_PASSED, "went through one", passed))
    keys = [Patch(color=colour, label=f"{100.0 * counts.sum() / max(total, 1):.1f} % {text}") for colour, text, counts in words]
    axes.set_title(f"where the beams of {Path(name).name[:60]} fail", loc="left", fontsize=11)
    axes.tick_params(labelsize=8, colors="#444444")
    axes.legend(handles=keys, loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=3, fontsize=9, frameon=False)
    figure.savefig(path, dpi=110, format="png", pil_kwargs={"compress_level": 3})
