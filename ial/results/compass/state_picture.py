"""`draw_states`: the information state after each motion, as in the tables of O'Kane 2005."""

import math
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from ial.compass.sequence import Sequence
from ial.compass.state import InformationState
from ial.compass.transition import Transition
from ial.maps.polygons.exact.shooter import Shooter
from ial.results.bouncing.page import BouncePage, arrow
from ial.results.compass.ground import draw_polygon, shape
from ial.results.palette import FOUND, PATH

_PANEL_IN = 2.6


def draw_states(path: Path, sequence: Sequence, name: str) -> None:
    """Draw where a robot can be at first and after each motion.

    Parameters
    ----------
    path
        The PNG file to write.
    sequence
        What is carried out.
    name
        What the title calls it.

    Raises
    ------
    OutputError
        If the picture cannot be written.
    """
    keys = [
        Line2D([], [], color=FOUND, linewidth=3.0, label="a piece of a wall where it can be"),
        Line2D([], [], color=PATH, marker="o", markersize=5.0, linestyle="", label="a point where it can be"),
        Line2D([], [], color=PATH, marker=">", markersize=7.0, linestyle="", label="the motion that led there"),
    ]
    motions = f"{len(sequence)} motion{'s' * (len(sequence) != 1)}"
    title, remark = f"Where a robot can be: {name}", f"at first, and after each of {motions}; at last it is in one place"
    page = BouncePage(len(sequence) + 1, shape(sequence.polygon), title, remark, keys, _PANEL_IN)
    shooter = Shooter(sequence.polygon)
    transition, state = Transition(shooter), InformationState.boundary(shooter)
    _draw(page.panels[0], shooter, state, "at first", None)
    for step, direction in enumerate(sequence.directions, 1):
        state = transition(state, direction)
        heading = math.degrees(math.atan2(direction[1], direction[0])) % 360.0
        _draw(page.panels[step], shooter, state, f"{step}: {heading:.6g}°", heading)
    page.write(path)


def _draw(axes: Axes, shooter: Shooter, state: InformationState, title: str, heading_deg: float | None) -> None:
    draw_polygon(axes, shooter.polygon)
    for piece in state.pieces:
        ends = [shooter.on_edge(piece.edge, part) for part in (piece.low, piece.high)]
        axes.plot([float(end.x) for end in ends], [float(end.y) for end in ends], color=FOUND, linewidth=2.6, zorder=4)
    x, y = [float(point.x) for point in state.points], [float(point.y) for point in state.points]
    axes.plot(x, y, "o", color=PATH, markersize=3.2, zorder=5)
    axes.set_title(title, fontsize=9, loc="left", pad=3, y=1.0)
    if heading_deg is not None:
        inset = axes.inset_axes((0.88, 1.0, 0.12, 0.12))
        inset.set_axis_off()
        inset.set_xlim(-1.0, 1.0)
        inset.set_ylim(-1.0, 1.0)
        arrow(inset, 0.0, 0.0, heading_deg, 11.0, PATH)
