"""A picture of a filter as an automaton: from the start at the left to the knowledge cycles at the right."""

import math
from pathlib import Path

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D

from ial.bouncing.automata.cycle_walk import walk_cycles
from ial.bouncing.automata.table import FilterTable
from ial.errors import FilterError
from ial.results.bouncing.ground import BRIGHT
from ial.results.bouncing.page import BouncePage

MOST_STATES = 400
_SMALLEST = 6.0  # points; a smaller state has no room for its label
_WIDTH_IN = 13.0
_LOWEST = 0.5  # the height as a part of the width, for the tree before the cycles
_STEP, _BUMP = "#5b6b7f", "#c1121f"
_NOT_YET = "#dfe5ec"

FloatArray = npt.NDArray[np.float64]


def draw_automaton(path: Path, table: FilterTable, name: str) -> None:
    """Write a picture of all states but the trap; the number at a state is its uncertainty.

    Parameters
    ----------
    path
        The PNG file.
    table
        The filter.
    name
        What it is a filter of.

    Raises
    ------
    FilterError
        If there are too many states to tell them apart.
    OutputError
        If the picture cannot be written.
    """
    states = table.trap
    if states > MOST_STATES:
        raise FilterError(
            f"the automaton has {states} states, and at most {MOST_STATES} can be told apart in a picture; use larger cells or fewer "
            "headings, or look at its cycles: --what cycles"
        )
    places, depth = _places(table)
    left, right = float(places[:, 0].min()), float(places[:, 0].max())
    low, high = float(places[:, 1].min()), float(places[:, 1].max())
    keys = [
        Line2D([], [], color=_STEP, linewidth=1.4, label="0: a step"),
        Line2D([], [], color=_BUMP, linewidth=1.4, linestyle=(0, (3, 1.5)), label="1: a bump"),
        Line2D([], [], color=_NOT_YET, markeredgecolor=_STEP, marker="o", markersize=8, linestyle="none", label="not localized yet"),
    ]
    keys += [
        Line2D([], [], color=BRIGHT[cycle % len(BRIGHT)], marker="o", markersize=8, linestyle="none", label=_words(table, cycle + 2))
        for cycle in range(min(table.cycles, len(BRIGHT)))
    ]
    title = f"{name[:70]}: {states} states, {table.cycles} knowledge cycle{'s' * (table.cycles != 1)}"
    across, up = right - left + 3.0, high - low + 2.0
    size = min(16.0, 0.62 * 72.0 * _WIDTH_IN / across)  # a state is a little narrower than the distance between two, in points
    labelled = size >= _SMALLEST
    remark = "at a state: in how many configurations the robot can be; " if labelled else ""
    remark += f"localized after at most {depth} observations; the trap is left out"
    page = BouncePage(1, up / across, title, remark, keys, _WIDTH_IN)
    (axes,) = page.panels
    _draw_arcs(axes, table, places)
    colours = [_NOT_YET if colour == 1 else BRIGHT[(colour - 2) % len(BRIGHT)] for colour in table.colours[:states].tolist()]
    axes.scatter(places[:, 0], places[:, 1], s=size**2, c=colours, edgecolors=_STEP, linewidths=0.6, zorder=3)
    if labelled:
        for state in range(states):
            text = "white" if table.colours[state] > 1 else "#22262b"
            label = str(int(table.uncertainty[state]))
            font = min(8.0, 1.15 * size / max(len(label), 1.6))
            x, y = places[state]
            axes.text(x, y, label, ha="center", va="center_baseline", fontsize=font, color=text, zorder=4)
    axes.annotate("start", places[0], (-0.7 * size, 0.0), textcoords="offset points", ha="right", va="center", fontsize=9)
    axes.set(xlim=(left - 2.0, right + 1.0), ylim=(low - 1.0, high + 1.0), aspect="equal")
    axes.axis("off")
    page.write(path)


def _words(table: FilterTable, colour: int) -> str:
    on = np.flatnonzero(table.colours == colour)
    size = int(table.uncertainty[on[0]])
    return f"colour {colour}: {size} configuration{'s' * (size != 1)}, {len(on)} states"


def _places(table: FilterTable) -> tuple[FloatArray, int]:
    """Return where each state stands, float64 of shape (states, 2), and how many observations it takes at most until a cycle is reached.

    What comes before the cycles is nearly a tree: a state stands as far right as the longest way to it, at the middle of its successors.
    Cycles are rings at the right, one above the other in the order in which the tree reaches them.
    """
    states, colours = table.trap, table.colours
    arcs = [[int(to) for to in row if to != table.trap] for row in table.successors[:states]]
    order = _topological(arcs, colours.tolist())
    depth = dict.fromkeys(order, 0)
    deepest = 0
    for state in order:
        for to in arcs[state]:
            if colours[to] > 1:
                deepest = max(deepest, depth[state] + 1)
            else:
                depth[to] = max(depth[to], depth[state] + 1)

    places = np.zeros((states, 2))
    row, visited = 0.0, set()
    reached: dict[int, list[float]] = {}

    def settle(state: int) -> None:
        nonlocal row
        begun = row
        visited.add(state)
        for to in arcs[state]:
            if colours[to] == 1 and to not in visited:
                settle(to)
        if row == begun:
            row += 1.0
        places[state] = depth[state], 0.5 * (begun + row - 1.0)
        for to in arcs[state]:
            if colours[to] > 1:
                reached.setdefault(int(colours[to]), []).append(float(places[state, 1]))

    if order:
        settle(0)
    lengths = np.bincount(colours[:states], minlength=table.cycles + 2)
    width = float(max(depth.values(), default=0))
    radius = {colour: max(1.0, 0.5 * lengths[colour] / math.pi) for colour in range(2, table.cycles + 2)}
    total = sum(2.0 * each + 2.0 for each in radius.values())
    stretch = max(1.0, _LOWEST * width / max(row, 1.0))
    places[:, 1] *= stretch
    tall = max((row - 1.0) * stretch, total)
    places[:, 1] += 0.5 * (tall - (row - 1.0) * stretch)
    top, widest = 0.5 * (tall - total), max(radius.values())
    for colour in sorted(radius, key=lambda each: float(np.mean(reached.get(each, [0.0])))):
        _ring(table, colour, places, (width + 3.0 + widest, top + radius[colour] + 1.0), radius[colour])
        top += 2.0 * radius[colour] + 2.0
    return places, deepest


def _topological(arcs: list[list[int]], colours: list[int]) -> list[int]:
    """Return the states that are on no cycle, each after all that lead to it."""
    waiting = [0] * len(arcs)
    for state, row in enumerate(arcs):
        if colours[state] == 1:
            for to in row:
                waiting[to] += 1
    ready = [0] if colours[0] == 1 else []
    for state in ready:
        for to in arcs[state]:
            waiting[to] -= 1
            if colours[to] == 1 and waiting[to] == 0:
                ready.append(to)
    return ready


def _ring(table: FilterTable, colour: int, places: FloatArray, centre: tuple[float, float], radius: float) -> None:
    """Place the states of a cycle around a centre, the first one at the left."""
    first = np.flatnonzero(table.colours == colour)[:1].astype(np.int32)
    cycle, steps = walk_cycles(table.successors, first, table.trap)
    ring = np.argsort(steps)[np.count_nonzero(cycle < 0) :]
    angles = math.pi - 2.0 * math.pi * np.arange(len(ring)) / len(ring)
    places[ring] = np.column_stack([centre[0] + radius * np.cos(angles), centre[1] + radius * np.sin(angles)])


def _draw_arcs(axes: Axes, table: FilterTable, places: FloatArray) -> None:
    """Draw an arc for each observation, thinner where it comes in at a cycle."""
    for label, colour, dashes in ((0, _STEP, "solid"), (1, _BUMP, (0, (3, 1.5)))):
        for entering in (False, True):
            arcs = [
                (places[state], places[to])
                for state, to in enumerate(table.successors[: table.trap, label].tolist())
                if to != table.trap and bool(table.colours[state] == 1 and table.colours[to] > 1) is entering
            ]
            look = {"linewidths": 0.6, "alpha": 0.55} if entering else {"linewidths": 1.2, "alpha": 1.0}
            axes.add_collection(LineCollection(arcs, colors=colour, linestyles=[dashes], zorder=2 - entering, **look), autolim=False)
