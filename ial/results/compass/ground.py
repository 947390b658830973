"""`draw_polygon`: the environment of a robot with a compass as a layer of a picture."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import PathPatch
from matplotlib.path import Path

from ial.maps.polygons.polygon import Polygon
from ial.results.palette import EDGE, UNKNOWN


def draw_polygon(axes: Axes, polygon: Polygon) -> None:
    """Draw the free space with its walls, and nothing around it."""
    points, codes = [], []
    for ring in polygon.rings:
        points += [(float(x), float(y)) for x, y in (*ring, ring[0])]
        codes += [Path.MOVETO, *[Path.LINETO] * (len(ring) - 1), Path.CLOSEPOLY]
    axes.add_patch(PathPatch(Path(np.array(points), codes), facecolor=UNKNOWN, edgecolor=EDGE, linewidth=0.9, zorder=1))
    low_x, low_y, high_x, high_y = map(float, polygon.bounds)
    margin = 0.04 * max(high_x - low_x, high_y - low_y)
    axes.set_xlim(low_x - margin, high_x + margin)
    axes.set_ylim(low_y - margin, high_y + margin)
    axes.set_aspect("equal")
    axes.set_xticks([])
    axes.set_yticks([])
    for spine in axes.spines.values():
        spine.set_visible(False)


def shape(polygon: Polygon) -> float:
    """Return the height of a polygon as a part of its width."""
    low_x, low_y, high_x, high_y = map(float, polygon.bounds)
    return (high_y - low_y) / (high_x - low_x)
