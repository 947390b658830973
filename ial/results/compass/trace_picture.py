"""`draw_traces`: the ways of robots that carry out one sequence from several starts, as in figure 3.7 of O'Kane 2005."""

from collections.abc import Sequence as Several
from itertools import pairwise
from pathlib import Path

from matplotlib.lines import Line2D

from ial.compass.robot import CompassRobot
from ial.compass.sequence import Sequence
from ial.maps.polygons.polygon import ExactPoint
from ial.results.bouncing.page import BouncePage
from ial.results.compass.ground import draw_polygon, shape
from ial.results.palette import FOUND, PATH, TRUTH


def draw_traces(path: Path, sequence: Sequence, starts: Several[ExactPoint], name: str) -> None:
    """Draw how robots get to the end of a sequence.

    Parameters
    ----------
    path
        The PNG file to write.
    sequence
        What is carried out.
    starts
        Where the robots start, in metres.
    name
        What the title calls it.

    Raises
    ------
    MapError
        If a start lies outside of the environment.
    OutputError
        If the picture cannot be written.
    """
    keys = [
        Line2D([], [], color=FOUND, marker="o", markersize=6.0, linestyle="", label="start"),
        Line2D([], [], color=PATH, linewidth=1.2, label="the way of the robot"),
        Line2D([], [], color=TRUTH, marker="*", markersize=10.0, linestyle="", label="the end, the same from everywhere"),
    ]
    remark = f"one sequence of {len(sequence)} motions, carried out exactly; where a wall is ahead at once, a robot stays"
    page = BouncePage(len(starts), shape(sequence.polygon), f"From several starts to one place: {name}", remark, keys)
    for axes, start in zip(page.panels, starts, strict=True):
        robot = CompassRobot(sequence.polygon, start)
        places = [robot.place, *(robot.drive(*direction) for direction in sequence.directions)]
        x, y = [float(place[0]) for place in places], [float(place[1]) for place in places]
        moved = sum(one != other for one, other in pairwise(places))
        draw_polygon(axes, sequence.polygon)
        axes.plot(x, y, color=PATH, linewidth=1.1, zorder=4)
        axes.plot(x[:1], y[:1], "o", color=FOUND, markersize=5.5, zorder=6)
        axes.plot([float(sequence.end[0])], [float(sequence.end[1])], "*", color=TRUTH, markersize=11.0, zorder=5)
        axes.set_title(f"from x {x[0]:.4g} m, y {y[0]:.4g} m: {moved} motions lead on", fontsize=9, loc="left", pad=3)
    page.write(path)
