"""The parts of a picture: the track, the first step, one scan on the walls, and the status over time."""

import math
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PathCollection, PolyCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ial.contractors.boxes import Boxes
from ial.datasets.recording import Step
from ial.datasets.scan import BeamClass
from ial.lidar.hypothesis import Hypothesis
from ial.maps.grids.cell_index import CellIndex
from ial.maps.grids.occupancy_grid import OCCUPIED, OccupancyGrid
from ial.pose import Pose
from ial.results.lidar.enclosures import Enclosure
from ial.results.lidar.map_layer import MapLayer, View
from ial.results.lidar.track import Track
from ial.results.palette import EDGE, FOUND, OFF_WALL, ON_WALL, PATH, PREDICTION, STATUS_COLOURS, TRUTH, VANISHING

_HULLS = 50_000  # more are thinned out evenly
_RINGS = 200  # more hypotheses of the first scan are not ringed
_BAR_PIXELS = 1500  # of the status over time; more scans than that share a bar

_DASHES = (0, (4, 2))
_LOW = 0.5  # where the bars of the status begin

FloatArray = npt.NDArray[np.float64]
Key = Line2D | Patch | PathCollection


def draw_track(axes: Axes, layer: MapLayer, track: Track, truth: Sequence[Pose]) -> None:
    """Draw the hull of every hypothesis of every scan, the path of the localized robot, and the reference if there is one."""
    layer.draw(axes)
    unconfirmed = [each for scan in track.scans for each in scan.hypotheses if each.prediction]
    hypotheses = [(scan.status, each) for scan in track.scans for each in scan.hypotheses if not each.prediction]
    _draw_hulls(axes, unconfirmed, [PREDICTION] * len(unconfirmed), alpha=0.0, zorder=1)
    for certain in (False, True):  # the certain ones above all others
        rows = [(status, each) for status, each in hypotheses if (status == "localized") is certain]
        colours = [STATUS_COLOURS[status] for status, _ in rows]
        _draw_hulls(axes, [each for _, each in rows], colours, alpha=0.30 if certain else 0.16, zorder=2 + certain)
    pieces = _pieces(track.scans)
    axes.add_collection(LineCollection(pieces, colors="white", linewidths=3.2, zorder=5), autolim=False)
    axes.add_collection(LineCollection(pieces, colors=PATH, linewidths=1.6, zorder=6), autolim=False)
    if truth:
        axes.plot([pose.x for pose in truth], [pose.y for pose in truth], color=TRUTH, linewidth=1.1, linestyle=_DASHES, zorder=7)
    vanishing = [each.centre for scan in track.scans if scan.vanishing for each in scan.hypotheses]
    axes.add_line(_crosses([pose.x for pose in vanishing], [pose.y for pose in vanishing]))
    last = next((scan.pose for scan in reversed(track.scans) if scan.pose is not None), None)
    if last is not None:
        _draw_robot(axes, last)
    statuses = {status for status, _ in hypotheses}
    keys: list[Key] = [Line2D([], [], color=PATH, linewidth=1.6, label="path")] if pieces else []
    keys += [Line2D([], [], color=TRUTH, linestyle=_DASHES, label="reference")] if truth else []
    keys += [Patch(color=colour, alpha=0.6, label=name) for name, colour in STATUS_COLOURS.items() if name in statuses]
    keys += [Patch(facecolor="none", edgecolor=PREDICTION, label="rejected prediction")] if unconfirmed else []
    keys += [_crosses([], [], "vanishing")] if vanishing else []
    _finish(axes, f"enclosures of {len(track)} scans", keys)


def _draw_hulls(axes: Axes, hypotheses: Sequence[Hypothesis], colours: Sequence[str], alpha: float, zorder: int) -> None:
    """Draw the hulls on the floor, filled with some opacity; where there are too many to see, they are thinned out evenly."""
    thinned = max(1, len(hypotheses) // _HULLS)
    corners = [[(x0, y0), (x1, y0), (x1, y1), (x0, y1)] for x0, x1, y0, y1 in ((*each.x, *each.y) for each in hypotheses[::thinned])]
    chosen = colours[::thinned]
    if alpha:
        axes.add_collection(PolyCollection(corners, facecolors=chosen, edgecolors="none", alpha=alpha, zorder=zorder), autolim=False)
    edges = PolyCollection(corners, facecolors="none", edgecolors=chosen, linewidths=0.4, alpha=0.6, zorder=zorder)
    axes.add_collection(edges, autolim=False)


def _pieces(track: Sequence[Enclosure]) -> list[FloatArray]:
    """Return the path, in pieces between which the robot was not localized."""
    pieces: list[list[tuple[float, float]]] = [[]]
    for scan in track:
        if scan.pose is None:
            pieces.append([])
        else:
            pieces[-1].append((scan.pose.x, scan.pose.y))
    return [np.array(piece if len(piece) > 1 else piece * 2) for piece in pieces if piece]


def draw_first(axes: Axes, layer: MapLayer, boxes: Boxes, track: Track) -> None:
    """Draw the answer to the first scan, which is a search of the whole map unless the start was given."""
    layer.draw(axes)
    layer.draw_boxes(axes, boxes, FOUND)
    hypotheses = track.scans[0].hypotheses if track else ()
    if len(hypotheses) <= _RINGS:
        for pose in (each.centre for each in hypotheses):
            axes.plot([pose.x], [pose.y], "o", markersize=13, fillstyle="none", color=FOUND, markeredgewidth=0.9, zorder=4)
    count = "1 hypothesis" if len(hypotheses) == 1 else f"{len(hypotheses)} hypotheses"
    _finish(axes, f"after the first scan: {count}, {len(boxes)} boxes", [])


def draw_scan(axes: Axes, layer: MapLayer, grid: OccupancyGrid, scan: tuple[Step, Pose] | None, walls_m: float) -> None:
    """Lay the hits of one scan on the walls, as seen from the pose of the robot."""
    if scan is None:
        layer.draw(axes)
        _finish(axes, "no scan to lay on the walls: the robot was never localized", [])
        return
    step, pose = scan
    points = _end_points(step, pose)
    on = _near_walls(points, grid, walls_m)
    laser = pose @ step.scan.mounting.pose
    layer.draw(axes, _around(points, pose))
    rays = np.stack([np.broadcast_to((laser.x, laser.y), points.shape), points], axis=1)
    axes.add_collection(LineCollection(list(rays), colors=EDGE, linewidths=0.25, alpha=0.45, zorder=3), autolim=False)
    keys = [
        axes.scatter(points[chosen, 0], points[chosen, 1], s=9, color=colour, linewidths=0, zorder=5, label=f"{chosen.sum()} {where}")
        for chosen, colour, where in ((on, ON_WALL, "on the walls"), (~on, OFF_WALL, "elsewhere"))
    ]
    _draw_robot(axes, pose)
    _finish(axes, f"hits of scan {step.index} laid on the walls", keys)


def _end_points(step: Step, pose: Pose) -> FloatArray:
    """Return where the hits of a scan end in the map frame, shape (n, 2)."""
    hits = step.scan.classes() == BeamClass.HIT
    lower, upper = step.scan.bearings()
    laser = pose @ step.scan.mounting.pose
    angle = laser.theta + 0.5 * (lower + upper)[hits]
    reach = step.scan.ranges[hits].astype(np.float64)
    return np.stack([laser.x + reach * np.cos(angle), laser.y + reach * np.sin(angle)], axis=1)


def _near_walls(points: FloatArray, grid: OccupancyGrid, walls_m: float) -> npt.NDArray[np.bool_]:
    """Return which points lie near an occupied cell, by a square around each."""
    x, y, _ = grid.to_grid(points[:, 0], points[:, 1])
    at = np.stack([x, y], axis=1)
    return np.asarray(CellIndex(grid.mask(OCCUPIED), grid.resolution).meet(Boxes(at - walls_m, at + walls_m)))


def _around(points: FloatArray, pose: Pose) -> View:
    """Return a view of most of some points, and of the robot."""
    at = np.array([pose.x, pose.y])
    low, high = np.minimum(np.percentile(points, 4.0, axis=0), at), np.maximum(np.percentile(points, 96.0, axis=0), at)
    margin = 0.06 * float((high - low).max()) + 0.5
    return float(low[0]) - margin, float(high[0]) + margin, float(low[1]) - margin, float(high[1]) + margin


def draw_status(axes: Axes, track: Track) -> None:
    """Draw how many hypotheses each scan left, in the colour of its status."""
    scans = track.scans
    group = max(1, math.ceil(len(scans) / _BAR_PIXELS))
    bars = [max(scans[at : at + group], key=lambda scan: len(scan.hypotheses)) for at in range(0, len(scans), group)]
    index = np.array([bar.index for bar in bars], dtype=np.float64)
    count = np.array([max(1, len(bar.hypotheses)) for bar in bars], dtype=np.float64)
    width = float(np.diff(index).min()) if len(index) > 1 else 1.0
    axes.bar(index, count - _LOW, width=width, bottom=_LOW, color=[STATUS_COLOURS[bar.status] for bar in bars], linewidth=0)
    vanishing = [scan.index for scan in scans if scan.vanishing]
    axes.add_line(_crosses(vanishing, [_LOW] * len(vanishing)))
    axes.set(yscale="log", ylim=(_LOW, max(10.0, 1.6 * count.max(initial=1.0))), xlabel="scan")
    axes.margins(x=0.004)
    axes.yaxis.set_major_formatter("{x:g}")
    names = sorted(track.statuses, key=list(STATUS_COLOURS).index)
    keys: list[Key] = [Patch(color=STATUS_COLOURS[name], label=f"{name} ({track.statuses[name]})") for name in names]
    keys += [_crosses([], [], f"vanishing ({track.vanishing})")] if vanishing else []
    axes.spines[["top", "right"]].set_visible(False)
    axes.tick_params(labelsize=8, colors="#444444")
    axes.set_title("hypotheses left by each scan", loc="left", fontsize=10)
    _add_legend(axes, keys)


def _crosses(x: Sequence[float], y: Sequence[float], label: str = "") -> Line2D:
    """Return marks for the scans that have left hardly anything."""
    return Line2D(
        x, y, linestyle="", marker="x", color=VANISHING, markersize=7.0, markeredgewidth=1.6, zorder=7, clip_on=False, label=label
    )


def _draw_robot(axes: Axes, pose: Pose) -> None:
    """Draw a wedge that points where the robot looks, of the same size in every picture."""
    outline = [(1.0, 0.0), (-0.7, 0.6), (-0.35, 0.0), (-0.7, -0.6)]
    c, s = math.cos(pose.theta), math.sin(pose.theta)
    marker = [(c * x - s * y, s * x + c * y) for x, y in outline]
    axes.plot([pose.x], [pose.y], marker=marker, markersize=17, color=PATH, markeredgecolor="white", markeredgewidth=1.0, zorder=8)


def _finish(axes: Axes, title: str, keys: Sequence[Key]) -> None:
    axes.set_title(title, loc="left", fontsize=10)
    axes.tick_params(labelsize=8, colors="#444444")
    axes.locator_params(nbins=8)
    for spine in axes.spines.values():
        spine.set_color(EDGE)
    _add_legend(axes, keys)


def _add_legend(axes: Axes, keys: Sequence[Key]) -> None:
    """Put the keys above the axes at the right, where they hide nothing."""
    if keys:
        legend = axes.legend(handles=list(keys), loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=len(keys), fontsize=8, frameon=False)
        legend.borderaxespad = legend.borderpad = 0.15
