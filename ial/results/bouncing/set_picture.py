"""A picture of what a bouncing robot with errors knows: the pieces of walls that are left after some of its bumps."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import to_rgba
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, PathPatch
from matplotlib.path import Path as Outline

from ial.bouncing.filters.piece_filter import PieceFilter
from ial.bouncing.rays.piece_model import NOT_BUMPED, PieceSet
from ial.bouncing.rays.real_robot import RealPose
from ial.errors import StreamError
from ial.maps.polygons.environment import Environment
from ial.results.bouncing.ground import BRIGHT, NO_CELL, frame
from ial.results.bouncing.page import BouncePage, arrow
from ial.results.palette import EDGE, FREE, TRUTH

_MOST_WEDGES = 40  # pieces of one set that get one
_PALEST = 0.3
_LEFT = BRIGHT[0]
_FULL_DEG = 360.0


def moments(bumps: int) -> list[int]:
    """Return after which bumps a set is shown: 1, 2, 4, 8 and so on, and the last one."""
    return sorted({1 << power for power in range(bumps.bit_length())} | {bumps})


def draw_sets(
    path: Path, made: PieceFilter, environment: Environment, sets: Sequence[PieceSet], truth: Sequence[RealPose] | None = None
) -> None:
    """Write a picture with a panel for each moment.

    Parameters
    ----------
    path
        The PNG file.
    made
        The filter.
    environment
        The environment it was built from.
    sets
        What is left after each bump of the robot.
    truth
        Where it was after each observation, if that is known.

    Raises
    ------
    StreamError
        If there is no bump, or the truth has another number of them.
    OutputError
        If the picture cannot be written.
    """
    set_page(made, environment, sets, truth).write(path)


def set_page(made: PieceFilter, environment: Environment, sets: Sequence[PieceSet], truth: Sequence[RealPose] | None = None) -> BouncePage:
    """Return the picture as a page, see `draw_sets`."""
    bumped = [at for at, pose in enumerate(truth or ()) if pose.observation]
    if truth is not None and len(bumped) != len(sets):
        raise StreamError(f"the true poses have {len(bumped)} bumps, and the robot observed {len(sets)}; give the truth of the same run")
    if not sets:
        raise StreamError("the robot has not bumped yet, so it can be anywhere; give observations with a bump")
    shown = moments(len(sets))
    what = "centre of the disk" if made.radius_m else "point"
    keys = [Line2D([], [], color=_LEFT, linewidth=4.0, label=f"where the {what} can be")]
    if truth is not None:
        keys.append(Line2D([], [], color=TRUTH, linewidth=1.3, marker=">", markersize=7, label="where it is, and its way"))
    x0, y0, x1, y1 = map(float, environment.bounds)
    bounds, step = made.bounds, f"{float(made.step_m):g} m ± {float(100 * made.bounds.step):g} %"
    remark = f"{float(made.bounce_deg):g}° ± {float(bounds.turn_deg):g}°, steps of {step}, counts ± {bounds.count}; "
    remark += "wedges: headings after the turn, where there are few; paler: fewer headings; axes in m"
    page = BouncePage(len(shown), (y1 - y0) / (x1 - x0), f"{made.name[:70]}: what is left after {len(sets)} bumps", remark, keys)
    for axes, bump in zip(page.panels, shown, strict=True):
        states = sets[bump - 1]
        _draw_ground(axes, environment)
        _draw_pieces(axes, made, states)
        if truth is not None:
            _draw_truth(axes, truth[: bumped[bump - 1] + 1], float(made.radius_m))
        axes.set_title(f"bump {bump}: {_words(made, states)}", loc="left", fontsize=8.5)
    return page


def _words(made: PieceFilter, states: PieceSet) -> str:
    if not len(states):
        return "rejected"
    known = f"localized in {made.room(states)}, " if made.room(states) else "localized, " if made.is_localized(states) else ""
    return f"{known}{len(states)} of {len(made.map)} pieces"


def _draw_ground(axes: Axes, environment: Environment) -> None:
    for polygon in environment.polygons:
        vertices, codes = [], []
        for ring in polygon.rings:
            vertices += [(float(x), float(y)) for x, y in (*ring, ring[0])]
            codes += [Outline.MOVETO, *[Outline.LINETO] * (len(ring) - 1), Outline.CLOSEPOLY]
        axes.add_patch(PathPatch(Outline(vertices, codes), facecolor=FREE, edgecolor=EDGE, linewidth=0.8, zorder=1))
    x0, y0, x1, y1 = map(float, environment.bounds)
    frame(axes, (x0, x1, y0, y1))
    axes.set_facecolor(NO_CELL)


def _draw_pieces(axes: Axes, made: PieceFilter, states: PieceSet) -> None:
    """Draw each part of a wall from which the robot may have left, the darker, the more headings it may have there."""
    map_, walls = made.map, made.map.walls
    count = int(map_.parts.sum())
    pieces = states.pieces[states.pieces != NOT_BUMPED]
    held, headings = np.unique(pieces % count, return_counts=True)
    wall = np.repeat(np.arange(len(walls)), map_.parts)[held]
    part = held - (np.cumsum(map_.parts) - map_.parts)[wall]
    ends = np.stack([_along(made, wall, (part + more) / map_.parts[wall]) for more in (0, 1)], axis=1)
    strength = _PALEST + (1.0 - _PALEST) * np.sqrt(headings / max(int(headings.max(initial=1)), 1))
    colours = [to_rgba(_LEFT, each) for each in strength.tolist()]
    axes.add_collection(LineCollection(list(ends), colors=colours, linewidths=4.0, zorder=4), autolim=False)
    if len(pieces) <= _MOST_WEDGES:
        middles = dict(zip(held.tolist(), ends.mean(axis=1).tolist(), strict=True))
        for piece in pieces.tolist():
            x, y = middles[piece % count]
            arrow(axes, x, y, (piece // count + 0.5) * _FULL_DEG / map_.headings, 7.0, _LEFT)


def _along(made: PieceFilter, wall: npt.NDArray[np.int64], part: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Return points on walls, in the frame of the environment."""
    walls = made.map.walls
    points = [
        float(origin) + low[wall] + part * (low[walls.after] - low)[wall]
        for low, origin in zip((walls.x, walls.y), walls.origin, strict=True)
    ]
    return np.stack(points, axis=1)


def _draw_truth(axes: Axes, truth: Sequence[RealPose], radius: float) -> None:
    x, y = [float(pose.x_m) for pose in truth], [float(pose.y_m) for pose in truth]
    axes.plot(x, y, color=TRUTH, linewidth=1.3, alpha=0.8, zorder=5, label="truth")
    if radius:
        axes.add_patch(Circle((x[-1], y[-1]), radius, facecolor="none", edgecolor=TRUTH, linewidth=1.3, zorder=7))
    arrow(axes, x[-1], y[-1], _FULL_DEG * float(truth[-1].turn), 11.0, TRUTH)
