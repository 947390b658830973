"""`Scene`: the map, the set, the possible robots and the true one, and what is decided, as one picture of an exploration."""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.colors import to_rgba
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, FancyArrowPatch

from ial.active.explored_area import ExploredArea, View
from ial.lidar.estimate import Estimate
from ial.maps.grids.occupancy_grid import FREE, OccupancyGrid
from ial.pose import Pose
from ial.results.active.leg import Leg
from ial.results.lidar.map_layer import MapLayer, covered_cells
from ial.results.lidar.map_layer import View as Shown
from ial.results.palette import EDGE, HYPOTHESES, OCCUPIED, PREDICTION, TRUTH

KEYS = [
    Line2D([], [], color=HYPOTHESES[0], marker="o", markersize=7, linestyle="none", label="possible robots, 64 at most"),
    Line2D([], [], color=TRUTH, marker="o", markersize=9, fillstyle="none", markeredgewidth=2.0, label="true robot and its path"),
    Line2D([], [], color=TRUTH, marker="*", markersize=9, linestyle="none", label="its target"),
    Line2D([], [], color=OCCUPIED, marker=">", markersize=5, linewidth=1.0, label="next drive"),
]
"""What stands for what."""
UNSEEN = to_rgba(PREDICTION, 0.45)
"""The colour of free space that was not seen."""


class Scene:
    """Draws moments of an exploration.

    Parameters
    ----------
    grid
        The map.
    radius_m
        The radius of the robot.
    """

    def __init__(self, grid: OccupancyGrid, radius_m: float) -> None:
        self.radius_m = radius_m
        self._grid, self._layer = grid, MapLayer(grid)

    def __repr__(self) -> str:
        return f"<Scene of {self._grid!r}>"

    @property
    def view(self) -> Shown:
        """What is shown of the map frame, in metres: left, right, bottom, top."""
        return self._layer.view

    def draw(self, axes: Axes, leg: Leg, following: Leg | None, path: Sequence[Pose], view: Shown | None = None) -> None:
        """Draw what is known after a leg.

        Parameters
        ----------
        axes
            Where to draw.
        leg
            The leg.
        following
            The next one, whose decision is drawn; None for none.
        path
            Where the robot was at each scan, ``T_map_base``.
        view
            What is shown of the map frame; all of the map if None.
        """
        self._layer.draw(axes, view)
        self._layer.draw_pixels(axes, _pixels(leg.estimate, self._grid), self._grid.resolution)
        axes.plot([each.x for each in path], [each.y for each in path], color=TRUTH, linewidth=1.0, alpha=0.7, zorder=4)
        for pose, number in zip(leg.groups.poses.tolist(), leg.groups.component.tolist(), strict=True):
            self._draw_robot(axes, self._grid.origin @ Pose(*pose), following, HYPOTHESES[number % len(HYPOTHESES)])
        self._draw_truth(axes, leg, following)
        axes.tick_params(labelsize=7, colors="#444444")
        for spine in axes.spines.values():
            spine.set_color(EDGE)

    def draw_unseen(self, axes: Axes, legs: Sequence[Leg]) -> None:
        """Shade the free space that the true robot has not seen on some legs."""
        area = ExploredArea(self._grid)
        for leg in legs:
            area.add(View.of(leg.step.scan, self._grid.pose_to_grid(leg.truth)))
        unseen = (self._grid.cells == FREE) & ~area.seen(Pose(0.0, 0.0, 0.0))
        pixels = np.zeros((*unseen.shape, 4), dtype=np.float32)
        pixels[unseen] = UNSEEN
        self._layer.draw_pixels(axes, pixels, self._grid.resolution)

    def _draw_robot(self, axes: Axes, pose: Pose, following: Leg | None, colour: str) -> None:
        """Draw a possible robot, and where it would drive."""
        axes.add_patch(Circle((pose.x, pose.y), self.radius_m, facecolor=colour, edgecolor="white", linewidth=0.7, zorder=6))
        nose = pose @ Pose(self.radius_m, 0.0, 0.0)
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


def _pixels(estimate: Estimate, grid: OccupancyGrid) -> npt.NDArray[np.float32]:
    """Return the cells of the map in the colours of the hypotheses that have positions in them."""
    pixels = np.zeros((grid.rows, grid.columns, 4), dtype=np.float32)
    labels = estimate.poses.clusters.labels
    for number, colour in enumerate(HYPOTHESES):
        rows = labels % len(HYPOTHESES) == number
        if rows.any():
            pixels[covered_cells(estimate.poses.boxes[rows], grid)] = to_rgba(colour, 0.45)
    return pixels
