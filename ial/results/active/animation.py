"""`ExplorationAnimation`: a film of an exploration, one frame for each scan."""

import io
import math
import textwrap
from contextlib import AbstractContextManager
from pathlib import Path
from types import TracebackType

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose
from ial.results.active.film import Film, Frame
from ial.results.active.leg import Leg
from ial.results.active.scene import KEYS, Scene
from ial.results.palette import STATUS_COLOURS

_WIDTH_IN, _DPI = 9.0, 100
_LOWEST_IN, _HIGHEST_IN = 2.0, 7.5  # of the map
_ABOVE_IN, _BELOW_IN, _BESIDE_IN = 0.95, 0.3, 0.45
_LETTERS = 118  # in a line


class ExplorationAnimation(AbstractContextManager["ExplorationAnimation"]):
    """Shows the set after each scan, the possible robots, the true one, and what is decided then.

    Parameters
    ----------
    path
        The film: a name that ends in .gif or .mp4.
    grid
        The map.
    radius_m
        The radius of the robot.
    name
        The title.
    """

    def __init__(self, path: Path, grid: OccupancyGrid, radius_m: float, name: str) -> None:
        self._film = Film(path)
        self._name = name
        self._scene = Scene(grid, radius_m)
        left, right, bottom, top = self._scene.view
        inner = _WIDTH_IN - 2.0 * _BESIDE_IN
        high = min(max(inner * (top - bottom) / (right - left), _LOWEST_IN), _HIGHEST_IN)
        self._height_in = math.ceil((high + _ABOVE_IN + _BELOW_IN) * _DPI / 2.0) * 2.0 / _DPI  # a film has an even number of rows
        self._box = _BESIDE_IN / _WIDTH_IN, _BELOW_IN / self._height_in, inner / _WIDTH_IN, high / self._height_in
        self._shown: Leg | None = None
        self._path: list[Pose] = []

    def __repr__(self) -> str:
        return f"<ExplorationAnimation: {self._film.path}>"

    def __enter__(self) -> "ExplorationAnimation":
        self._film.__enter__()
        return self

    def add(self, leg: Leg) -> None:
        """Take the next leg: the frame before it is drawn, with what was decided there.

        Raises
        ------
        OutputError
            If the film cannot be written.
        """
        if self._shown is not None:
            self._film.add(self._frame(self._shown, leg))
        self._shown = leg if leg.drives or not leg.number else None

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        if kind is None and self._shown is not None:
            self._film.add(self._frame(self._shown, None))
        self._film.__exit__(kind, error, trace)

    def _frame(self, leg: Leg, following: Leg | None) -> Frame:
        """Return the frame after a leg, with the decision of the following one."""
        figure = Figure(figsize=(_WIDTH_IN, self._height_in), dpi=_DPI, facecolor="white")
        FigureCanvasAgg(figure)
        axes = figure.add_axes(self._box)
        self._path.append(leg.truth)
        self._scene.draw(axes, leg, following, self._path)
        self._write(figure, leg, following)
        drawn = io.BytesIO()
        figure.savefig(drawn, format="rgba", dpi=_DPI)
        rows, columns = round(self._height_in * _DPI), round(_WIDTH_IN * _DPI)
        return np.ascontiguousarray(np.frombuffer(drawn.getvalue(), dtype=np.uint8).reshape(rows, columns, 4)[:, :, :3])

    def _write(self, figure: Figure, leg: Leg, following: Leg | None) -> None:
        """Write the title, the keys, and what is decided."""
        left, line = _BESIDE_IN / _WIDTH_IN, 1.0 / self._height_in
        figure.text(left, 1.0 - 0.08 * line, self._name, ha="left", va="top", fontsize=11, fontweight="bold")
        left_over = f"{leg.hypotheses} hypothes{'is' if leg.hypotheses == 1 else 'es'}"
        state = f"{leg.estimate.status}: {left_over} after {leg.number} drive{'s' * (leg.number != 1)}"
        colour = STATUS_COLOURS[leg.estimate.status]
        figure.text(left, 1.0 - 0.33 * line, state + ", collided" * leg.taken.collided, ha="left", va="top", fontsize=10, color=colour)
        said = "" if following is None else f"{following.number}. {following.words}"
        figure.text(left, 1.0 - 0.56 * line, textwrap.shorten(said, _LETTERS, placeholder=" …"), ha="left", va="top", fontsize=8.5)
        corner = 1.0 - left, 1.0 - 0.02 * line
        figure.legend(handles=KEYS, loc="upper right", bbox_to_anchor=corner, ncols=2, fontsize=7.5, frameon=False, borderaxespad=0.1)
