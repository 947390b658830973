"""`PathPicture`: moments of explorations side by side, each with the way there."""

import math
from collections.abc import Sequence
from contextlib import AbstractContextManager
from itertools import pairwise
from pathlib import Path
from types import TracebackType
from typing import NamedTuple

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose
from ial.results.active.leg import Leg
from ial.results.active.scene import KEYS, UNSEEN, Scene
from ial.results.lidar.map_layer import View
from ial.results.palette import STATUS_COLOURS, TRUTH

_DPI = 110
_COLUMNS, _PANEL_IN = 2, 5.6
_ABOVE_IN, _GAP_IN, _KEYS_IN = 0.42, 0.3, 0.4

_AROUND_M = 2.5  # of a way, where only its surroundings are shown


class Moment(NamedTuple):
    """A panel, as `PathPicture.add` takes it."""

    title: str
    legs: Sequence[Leg]
    following: Leg | None
    near: bool


class PathPicture(AbstractContextManager["PathPicture"]):
    """A PNG of panels, two in a row, which is written when the block ends without an error.

    Parameters
    ----------
    path
        The file.
    grid
        The map.
    radius_m
        The radius of the robot.
    """

    def __init__(self, path: Path, grid: OccupancyGrid, radius_m: float) -> None:
        self._path, self._scene = path, Scene(grid, radius_m)
        self._moments: list[Moment] = []

    def __repr__(self) -> str:
        return f"<PathPicture of {len(self._moments)} moments: {self._path}>"

    def add(self, title: str, legs: Sequence[Leg], following: Leg | None = None, *, near: bool = False) -> None:
        """Add a moment.

        Parameters
        ----------
        title
            What is to be seen.
        legs
            From the first look to this moment.
        following
            The next one, whose decision is drawn; None for none.
        near
            Whether only the surroundings of the way are shown, and not the whole map.
        """
        self._moments.append(Moment(title, legs, following, near))

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        if kind is None:
            self._figure().savefig(self._path, dpi=_DPI, format="png")

    def _figure(self) -> Figure:
        left, right, bottom, top = self._scene.view
        high_in = _PANEL_IN * (top - bottom) / (right - left)
        columns = min(_COLUMNS, len(self._moments))
        rows = math.ceil(len(self._moments) / _COLUMNS)
        width = _GAP_IN + columns * (_PANEL_IN + _GAP_IN)
        height = rows * (_ABOVE_IN + high_in + _GAP_IN) + _KEYS_IN
        figure = Figure(figsize=(width, height), dpi=_DPI, facecolor="white")
        FigureCanvasAgg(figure)
        for number, (title, legs, following, near) in enumerate(self._moments):
            row, column = divmod(number, _COLUMNS)
            x, y = _GAP_IN + column * (_PANEL_IN + _GAP_IN), row * (_ABOVE_IN + high_in + _GAP_IN) + _ABOVE_IN
            axes = figure.add_axes((x / width, 1.0 - (y + high_in) / height, _PANEL_IN / width, high_in / height))
            last = legs[-1]
            self._scene.draw_unseen(axes, legs)
            path = [each.truth for each in legs]
            self._scene.draw(axes, last, following, path, _around(path) if near else None)
            axes.plot([each.x for each in path], [each.y for each in path], ".", color=TRUTH, markersize=4, zorder=5)
            figure.text(x / width, 1.0 - (y - 0.22) / height, title, ha="left", va="bottom", fontsize=10, fontweight="bold")
            said = _state(legs)
            colour = STATUS_COLOURS[last.estimate.status]
            figure.text(x / width, 1.0 - (y - 0.04) / height, said, ha="left", va="bottom", fontsize=9, color=colour)
        keys = [*KEYS, Patch(facecolor=UNSEEN, label="free, not seen")]
        figure.legend(handles=keys, loc="lower center", ncols=len(keys), fontsize=8.5, frameon=False)
        return figure


def _state(legs: Sequence[Leg]) -> str:
    """Return what is known after some legs, and how far the robot has driven."""
    last, drives = legs[-1], sum(each.drives for each in legs)
    places = f"{last.hypotheses} place{'s' * (last.hypotheses != 1)}"
    way = sum(math.dist((one.truth.x, one.truth.y), (two.truth.x, two.truth.y)) for one, two in pairwise(legs))
    return f"{last.estimate.status}, {places}, after {drives} drive{'s' * (drives != 1)}, {way:.1f} m"


def _around(path: Sequence[Pose]) -> View:
    """Return what is near a way."""
    x, y = [each.x for each in path], [each.y for each in path]
    return min(x) - _AROUND_M, max(x) + _AROUND_M, min(y) - _AROUND_M, max(y) + _AROUND_M
