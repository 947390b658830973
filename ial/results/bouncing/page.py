"""A page of equal panels for pictures of bouncing robots, with a title above and keys below."""

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ial.whole_file import whole_files

_DPI = 120
_PANEL_IN = 3.4
_MOST_COLUMNS = 4
_HEAD_IN, _FOOT_IN = 0.62, 0.30


class BouncePage:
    """Panels in rows.

    Parameters
    ----------
    count
        How many panels.
    shape
        The height of what a panel shows as a part of its width.
    title, remark
        What is shown, and a line below it.
    keys
        What the legend explains.
    panel_in
        The width of a panel in inches; by default what suits their number.
    """

    def __repr__(self) -> str:
        return f"<BouncePage of {len(self.panels)} panels>"

    def __init__(self, count: int, shape: float, title: str, remark: str, keys: Sequence[Artist], panel_in: float | None = None) -> None:
        shape = min(max(shape, 0.25), 2.0)
        wanted = math.sqrt(2.2 * count * shape)
        columns = min(range(1, min(count, _MOST_COLUMNS) + 1), key=lambda each: abs(each - wanted) + 1.1 * (-count % each))
        rows = math.ceil(count / columns)
        panel = panel_in or max(_PANEL_IN, min(8.0 / columns, 5.5 / max(shape, 0.5)))
        width = max(columns * panel + 0.5, 7.0)
        legend_columns = max(1, int(width / 2.6))
        foot = _FOOT_IN + 0.22 * math.ceil(len(keys) / legend_columns)
        height = rows * (panel * shape + 0.55) + _HEAD_IN + foot
        self._figure = Figure(figsize=(width, height), facecolor="white")
        FigureCanvasAgg(self._figure)
        grid = self._figure.add_gridspec(
            rows,
            columns,
            left=0.45 / width,
            right=1.0 - 0.2 / width,
            top=1.0 - (_HEAD_IN + 0.22) / height,
            bottom=(foot + 0.2) / height,
            wspace=0.16,
            hspace=0.55 / (panel * shape),
        )
        self.panels: list[Axes] = [self._figure.add_subplot(grid[divmod(number, columns)]) for number in range(count)]
        self._figure.text(0.25 / width, 1.0 - 0.12 / height, title, ha="left", va="top", fontsize=13, fontweight="bold")
        self._figure.text(0.25 / width, 1.0 - 0.40 / height, remark, ha="left", va="top", fontsize=9, color="#444444")
        if keys:
            self._figure.legend(
                handles=list(keys),
                loc="lower left",
                bbox_to_anchor=(0.15 / width, 0.02 / height),
                ncols=legend_columns,
                fontsize=8.5,
                frameon=False,
                handletextpad=0.5,
            )

    def write(self, path: Path) -> None:
        """Write the page as a PNG file, which appears when it is complete.

        Raises
        ------
        OutputError
            If it cannot be written.
        """
        with whole_files(path, what="the picture") as (lent,):
            self._figure.savefig(lent, dpi=_DPI, format="png", pil_kwargs={"compress_level": 6})


def arrow(axes: Axes, x: float, y: float, heading_deg: float, size: float, colour: str) -> None:
    """Draw a wedge at a place that points in a direction; its size is in points."""
    outline = np.array([(1.0, 0.0), (-0.75, 0.62), (-0.4, 0.0), (-0.75, -0.62)])
    c, s = math.cos(math.radians(heading_deg)), math.sin(math.radians(heading_deg))
    marker = outline @ np.array([[c, s], [-s, c]])
    axes.plot([x], [y], marker=marker.tolist(), markersize=size, color=colour, markeredgecolor="white", markeredgewidth=0.7, zorder=8)
