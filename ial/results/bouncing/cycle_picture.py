"""A picture of knowledge cycles: along which paths a robot goes that is localized as well as it can be."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D

from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.results.bouncing.ground import BRIGHT, BounceGround
from ial.results.bouncing.page import BouncePage, arrow
from ial.results.palette import PATH

_MOST_PANELS = 12
_MOST_ROBOTS = 60  # places of one set that get a wedge
_BUMP = "#c1121f"

IntArray = npt.NDArray[np.int32]


def draw_cycles(path: Path, made: BounceFilter, grounds: Sequence[BounceGround]) -> None:
    """Write a picture with a panel for each knowledge cycle and each environment that it can be in, those of the least uncertainty first.

    Parameters
    ----------
    path
        The PNG file.
    made
        The filter.
    grounds
        Its environments, in their order.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    places = made.places
    cycles = len(places.anchors)
    sizes = made.table.uncertainty[places.anchors]
    lengths = np.bincount(made.table.colours, minlength=cycles + 2)[2 : cycles + 2]
    panels: list[tuple[int, int]] = []
    for cycle in np.lexsort((np.arange(cycles), sizes)).tolist():
        held = places.at(cycle, 0)
        panels += [(cycle, int(number)) for number in np.unique(places.environment[held])]
    shown = panels[:_MOST_PANELS]
    chosen = len({cycle for cycle, _ in shown})
    count = f"{cycles} knowledge cycle{'s' * (cycles != 1)}" if chosen == cycles else f"{chosen} of {cycles} knowledge cycles"
    headings = made.setting.headings
    remark = (
        f"bouncing angle {float(headings.bounce_deg):g}°, {headings.count} headings, cells of {float(made.setting.cell):g} m; axes in m"
    )
    remark += "" if grounds[0].whole else "; white: cells of periodic groups, the filter holds no others"
    keys = [
        Line2D([], [], color=BRIGHT[0], linewidth=2.0, label="path, one colour per closed path"),
        Line2D([], [], color=_BUMP, marker="o", markersize=5, linestyle="none", label="bump"),
        Line2D([], [], color=PATH, marker=">", markersize=8, linestyle="none", label="where it can be at one moment"),
    ]
    shape = float(np.median([grounds[number].shape for _, number in shown]))
    page = BouncePage(len(shown), shape, f"{', '.join(made.setting.names)[:70]}: {count}", remark, keys)
    for axes, (cycle, number) in zip(page.panels, shown, strict=True):
        grounds[number].draw(axes)
        _draw_paths(axes, made, grounds[number], cycle, number)
        where = f" in {grounds[number].name[:14]}" if len(grounds) > 1 else ""
        size, length = int(sizes[cycle]), int(lengths[cycle])
        axes.set_title(
            f"colour {cycle + 2}{where}: {size} configuration{'s' * (size != 1)}, {length} observations round", loc="left", fontsize=8.5
        )
    page.write(path)


def _draw_paths(axes: Axes, made: BounceFilter, ground: BounceGround, cycle: int, number: int) -> None:
    """Draw the closed paths of a cycle in one environment, its bumps, and the set of its anchor."""
    places = made.places
    held = places.at(cycle, 0)
    held = held[places.environment[held] == number]
    left = set(held.tolist())
    paths = 0
    while left:
        first = min(left)
        ring = [first]
        while (following := int(places.following[ring[-1]])) != first:
            ring.append(following)
        left -= set(ring)
        _draw_path(axes, made, ground, np.array(ring, dtype=np.int32), BRIGHT[paths % len(BRIGHT)])
        paths += 1
    x, y = ground.centres(places.row[held], places.column[held])
    for at in range(0, len(held), max(1, -(-len(held) // _MOST_ROBOTS))):
        heading = _heading(made, int(places.heading_class[held[at]]))
        arrow(axes, float(x[at]), float(y[at]), heading, 11.0 if len(held) <= 12 else 7.0, PATH)


def _draw_path(axes: Axes, made: BounceFilter, ground: BounceGround, ring: IntArray, colour: str) -> None:
    places = made.places
    x, y = ground.centres(places.row[ring], places.column[ring])
    line = np.column_stack([np.append(x, x[0]), np.append(y, y[0])])
    axes.add_collection(LineCollection([line], colors=colour, linewidths=1.7, alpha=0.9, zorder=4, capstyle="round"), autolim=False)
    ahead = places.following[ring]
    bumps = (places.row[ahead] == places.row[ring]) & (places.column[ahead] == places.column[ring])
    axes.plot(x[bumps], y[bumps], "o", markersize=3.6, color=_BUMP, markeredgewidth=0, zorder=6)


def _heading(made: BounceFilter, heading_class: int) -> float:
    """Return the middle of the headings of a class, in degrees."""
    x, y = made.step_of(heading_class)
    return float(np.degrees(np.arctan2(y, x)))
