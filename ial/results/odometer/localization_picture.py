"""A picture of a localization: the path of the robot, the candidates, two of them laid upon each other, and what is left."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, PathPatch
from matplotlib.path import Path as Outline

from ial.maps.polygons.polygon import Polygon
from ial.odometer.hypotheses import Hypothesis
from ial.odometer.localization import Localization
from ial.results.bouncing.page import BouncePage, arrow
from ial.results.palette import FOUND, FREE, OCCUPIED, PATH, STATUS_COLOURS, TRUTH, UNKNOWN

FloatArray = npt.NDArray[np.float64]

_MOST_ARROWS = 400
_OTHER = STATUS_COLOURS["ambiguous"]


def draw_localization(
    path: Path, name: str, polygons: Mapping[str, Polygon], found: Localization, places: Sequence[tuple[float, float]]
) -> None:
    """Write a picture of four panels.

    Parameters
    ----------
    path
        The PNG file.
    name
        What the environment is called.
    polygons
        The environments by the names that the hypotheses have; the same frame for all.
    found
        What the robot has found out.
    places
        Where it was: at the start, and after each command, in metres.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    first = next((each for each in found.trail if each), ())
    pair = _pair(first, found.hypotheses)
    keys = [
        Line2D([], [], color=PATH, marker="o", markersize=4, linewidth=1.6, label="path of the robot"),
        Line2D([], [], color=TRUTH, marker="o", markersize=9, linestyle="none", label="where it is"),
        Line2D([], [], color=FOUND, marker=">", markersize=8, linestyle="none", label="a hypothesis"),
        Patch(facecolor=STATUS_COLOURS["localized"], alpha=0.35, label="in the frame of one candidate"),
        Patch(facecolor=_OTHER, alpha=0.45, label="in the frame of another"),
    ]
    shape = float(np.median([_shape(each) for each in polygons.values()]))
    words = {"localized": "localized", "symmetric": "localized up to symmetry", "ambiguous": "not localized", "rejected": "contradicted"}
    remark = f"{len(found.steps)} commands, {words[found.status]}; axes in m"
    page = BouncePage(4, shape, f"{name[:60]}: a robot with odometers", remark, keys)
    driven, candidates, overlay, end = page.panels
    for axes in (driven, candidates, end):
        _ground(axes, polygons.values())
    x, y = zip(*places, strict=True)
    driven.plot(x, y, color=PATH, marker="o", markersize=4, linewidth=1.6, zorder=5)
    driven.plot(x[:1], y[:1], color=PATH, marker="o", markersize=8, markerfacecolor="white", zorder=6)
    driven.set_title(f"path from the open circle, {len(found.steps)} drives", fontsize=9)
    at = next((number for number, each in enumerate(found.trail) if each), len(places) - 2)
    _arrows(candidates, first)
    candidates.plot(*places[at + 1], color=TRUTH, marker="o", markersize=9, zorder=7)
    candidates.set_title(f"after {at + 1} drives: {len(first)} candidate{'s' * (len(first) != 1)}", fontsize=9)
    _overlay(overlay, polygons, pair)
    _arrows(end, found.hypotheses)
    end.plot(*places[-1], color=TRUTH, marker="o", markersize=9, zorder=7)
    count = len(found.hypotheses)
    end.set_title(f"at the end: {count} hypothes{'is' if count == 1 else 'es'}", fontsize=9)
    page.write(path)


def _shape(polygon: Polygon) -> float:
    low_x, low_y, high_x, high_y = map(float, polygon.bounds)
    return (high_y - low_y) / (high_x - low_x)


def _pair(first: Sequence[Hypothesis], last: Sequence[Hypothesis]) -> Sequence[Hypothesis]:
    """Return two candidates that differ most in their headings, the first of the list among them."""
    if len(first) < 2:
        return first or last[:1]
    return first[0], max(first[1:], key=lambda each: 1.0 - math.cos(each.heading_rad - first[0].heading_rad))


def _outline(polygon: Polygon, moved: Hypothesis | None = None) -> Outline:
    """Return the rings of a polygon; or in the frame of a robot, which looks up."""
    vertices, codes = [], []
    for ring in polygon.rings:
        corners = np.array([(float(x), float(y)) for x, y in (*ring, ring[0])])
        if moved is not None:
            turn = 0.5 * math.pi - moved.heading_rad
            c, s = math.cos(turn), math.sin(turn)
            corners = (corners - np.array([moved.x, moved.y])) @ np.array([[c, s], [-s, c]])
        vertices.append(corners)
        codes += [Outline.MOVETO, *[Outline.LINETO] * (len(ring) - 1), Outline.CLOSEPOLY]
    return Outline(np.concatenate(vertices), codes)


def _ground(axes: Axes, polygons) -> None:  # type: ignore[no-untyped-def]
    axes.set_facecolor(UNKNOWN)
    for polygon in polygons:
        axes.add_patch(PathPatch(_outline(polygon), facecolor=FREE, edgecolor=OCCUPIED, linewidth=1.2))
    axes.autoscale_view()
    axes.margins(0.04)
    axes.set_aspect("equal")
    axes.tick_params(labelsize=8)


def _arrows(axes: Axes, found: Sequence[Hypothesis]) -> None:
    """Draw hypotheses; of those that are curves, all samples."""
    places = np.concatenate([each.samples for each in found]) if found else np.empty((0, 3))
    for x, y, heading in places[:: -(-len(places) // _MOST_ARROWS) or 1].tolist():
        arrow(axes, x, y, math.degrees(heading), 13.0, FOUND)


def _overlay(axes: Axes, polygons: Mapping[str, Polygon], pair: Sequence[Hypothesis]) -> None:
    axes.set_facecolor(UNKNOWN)
    for each, colour, alpha in zip(pair, (STATUS_COLOURS["localized"], _OTHER), (0.35, 0.45), strict=False):
        axes.add_patch(PathPatch(_outline(polygons[each.world], each), facecolor=colour, edgecolor=OCCUPIED, alpha=alpha, linewidth=1.2))
    arrow(axes, 0.0, 0.0, 90.0, 14.0, FOUND)
    axes.autoscale_view()
    axes.margins(0.04)
    axes.set_aspect("equal", adjustable="datalim")
    axes.tick_params(labelsize=8)
    axes.set_title("two candidates laid upon each other" if len(pair) > 1 else "the only candidate", fontsize=9)
