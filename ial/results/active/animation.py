"""`ExplorationAnimation`: a film of an exploration, one frame for each scan."""

import io
import math
import textwrap
from contextlib import AbstractContextManager
from pathlib import Path
from types import TracebackType

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, FancyArrowPatch

from ial.lidar.estimate import Estimate
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose
from ial.results.active.film import Film, Frame
from ial.results.active.leg import Leg
from ial.results.lidar.map_layer import MapLayer, covered_cells
from ial.results.palette import EDGE, HYPOTHESES, OCCUPIED, STATUS_COLOURS, TRUTH

_WIDTH_IN, _DPI = 9.0, 100
_LOWEST_IN, _HIGHEST_IN = 2.0, 7.5  # of the map
_ABOVE_IN, _BELOW_IN, _BESIDE_IN = 0.95, 0.3, 0.45
_LETTERS = 118  # in a line

FloatArray = npt.NDArray[np.float64]


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
        self._grid, self._radius_m, self._name = grid, radius_m, name
        self._layer = MapLayer(grid)
        left, right, bottom, top = self._layer.view
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
        self._layer.draw(axes)
        self._layer.draw_pixels(axes, _pixels(leg.estimate, self._grid), self._grid.resolution)
        self._path.append(leg.truth)
        axes.plot([each.x for each in self._path], [each.y for each in self._path], color=TRUTH, linewidth=1.0, alpha=0.7, zorder=4)
        for pose, number in zip(leg.groups.poses.tolist(), leg.groups.component.tolist(), strict=True):
            self._draw_robot(axes, self._grid.origin @ Pose(*pose), following, HYPOTHESES[number % len(HYPOTHESES)])
        self._draw_truth(axes, leg, following)
        axes.tick_params(labelsize=7, colors="#444444")
        for spine in axes.spines.values():
            spine.set_color(EDGE)
        self._write(figure, leg, following)
        drawn = io.BytesIO()
        figure.savefig(drawn, format="rgba", dpi=_DPI)
        rows, columns = round(self._height_in * _DPI), round(_WIDTH_IN * _DPI)
        return np.ascontiguousarray(np.frombuffer(drawn.getvalue(), dtype=np.uint8).reshape(rows, columns, 4)[:, :, :3])

    def _draw_robot(self, axes: Axes, pose: Pose, following: Leg | None, colour: str) -> None:
        """Draw a possible robot, and where it would drive."""
        axes.add_patch(Circle((pose.x, pose.y), self._radius_m, facecolor=colour, edgecolor="white", linewidth=0.7, zorder=6))
        nose = pose @ Pose(self._radius_m, 0.0, 0.0)
        axes.plot([pose.x, nose.x], [pose.y, nose.y], color="white", linewidth=1.1, zorder=7)
        drive = None if following is None or following.taken.decision is None else following.taken.decision.drive
        if drive is not None:
            end = pose @ Pose(0.0, 0.0, drive.turn_rad) @ Pose(drive.distance_m, 0.0, 0.0)
            arrow = FancyArrowPatch(
                (pose.x, pose.y), (end.x, end.y), arrowstyle="-|>", mutation_scale=8.0, shrinkA=0, shrinkB=0, color=OCCUPIED, linewidth=1.0
            )
            arrow.set_zorder(8)
            axes.add_patch(arrow)

    def _draw_truth(self, axes: Axes, leg: Leg, following: Leg | None) -> None:
        """Ring the true robot, and mark where it is going in the end."""
        at = leg.truth
        axes.plot([at.x], [at.y], "o", markersize=19, fillstyle="none", color=TRUTH, markeredgewidth=2.0, zorder=9)
        target = None if following is None or following.taken.decision is None else following.taken.decision.target
        if target is not None:
            there = at @ leg.taken.moved.inverse() @ Pose(*target, 0.0)
            axes.plot([there.x], [there.y], "*", markersize=11, color=TRUTH, markeredgecolor="white", markeredgewidth=0.6, zorder=9)

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
        keys = [
            Line2D([], [], color=HYPOTHESES[0], marker="o", markersize=7, linestyle="none", label="possible robots, 64 at most"),
            Line2D([], [], color=TRUTH, marker="o", markersize=9, fillstyle="none", markeredgewidth=2.0, label="true robot and its path"),
            Line2D([], [], color=TRUTH, marker="*", markersize=9, linestyle="none", label="its target"),
            Line2D([], [], color=OCCUPIED, marker=">", markersize=5, linewidth=1.0, label="next drive"),
        ]
        corner = 1.0 - left, 1.0 - 0.02 * line
        figure.legend(handles=keys, loc="upper right", bbox_to_anchor=corner, ncols=2, fontsize=7.5, frameon=False, borderaxespad=0.1)


def _pixels(estimate: Estimate, grid: OccupancyGrid) -> npt.NDArray[np.float32]:
    """Return the cells of the map in the colours of the hypotheses that have positions in them."""
    pixels = np.zeros((grid.rows, grid.columns, 4), dtype=np.float32)
    labels = estimate.poses.clusters.labels
    for number, colour in enumerate(HYPOTHESES):
        rows = labels % len(HYPOTHESES) == number
        if rows.any():
            pixels[covered_cells(estimate.poses.boxes[rows], grid)] = to_rgba(colour, 0.45)
    return pixels
