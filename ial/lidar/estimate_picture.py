"""The hypotheses that a scan leaves, as a picture for people. It knows no map: a run's `picture.png` shows them in one."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from ial.lidar.hypothesis import Hypothesis
from ial.pose import Pose

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_COLOUR, _PREDICTION = "#1b6ca8", "#8d99ae"
_MOST = 2000  # of hypotheses; the largest are drawn
_FAN = 0.4  # the length of the fan of headings of a single hypothesis, as a part of the picture; many are smaller


def draw_hypotheses(ax: "Axes", hypotheses: Sequence[Hypothesis], pose: Pose | None, title: str) -> None:
    """Draw the hull of each hypothesis in the map frame, and a fan of the headings that it has.

    Parameters
    ----------
    ax
        Where to draw.
    hypotheses
        The largest first; of more than 2000 the largest are drawn, and the title says so. Only predicted ones are grey.
    pose
        The pose of a localized robot, drawn as a dot.
    title
        What stands above.
    """
    from matplotlib.patches import Rectangle, Wedge

    drawn = hypotheses[:_MOST]
    title += f", the {_MOST} largest shown" if len(drawn) < len(hypotheses) else ""
    left, right = min((each.x[0] for each in drawn), default=0.0), max((each.x[1] for each in drawn), default=1.0)
    bottom, top = min((each.y[0] for each in drawn), default=0.0), max((each.y[1] for each in drawn), default=1.0)
    fan = _FAN * max(right - left, top - bottom) / math.sqrt(max(1, len(drawn)))
    for each in drawn:
        (x0, x1), (y0, y1), (low, high) = each.x, each.y, map(math.degrees, each.theta)
        colour = _PREDICTION if each.prediction else _COLOUR
        ax.add_patch(Rectangle((x0, y0), x1 - x0, y1 - y0, facecolor=colour, edgecolor=colour, alpha=0.4))
        middle = (0.5 * (x0 + x1), 0.5 * (y0 + y1))
        ax.add_patch(Wedge(middle, fan, low, min(high, low + 360.0), facecolor=colour, edgecolor="white", linewidth=0.4, alpha=0.8))
    if pose is not None:
        ax.plot([pose.x], [pose.y], "o", color="#0b2545", markersize=4)
    ax.set(xlim=(left - fan, right + fan), ylim=(bottom - fan, top + fan), aspect="equal")
    ax.set(xlabel="x of the map (m)", ylabel="y of the map (m)")
    ax.set_title(title, fontsize=10)
