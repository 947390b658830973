"""`TreePicture`: the tree of an exploration's decisions as a picture."""

import math
from contextlib import AbstractContextManager
from pathlib import Path
from types import TracebackType

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ial.results.active.decision_tree import Branching, DecisionTree
from ial.results.active.leg import Leg
from ial.results.palette import EDGE, FREE, HYPOTHESES, OCCUPIED, STATUS_COLOURS, VANISHING

_DPI = 120
_NODE_IN, _LANE_IN = 0.62, 0.8  # the room that a node takes, and a row of them
_LEAST_IN, _MOST_IN = 8.0, 60.0
_MOST_LEAVES = 4  # that are drawn at one node; of more, their number is
_STAGES = {
    "first look": EDGE,
    "direction": HYPOTHESES[0],
    "frontier": HYPOTHESES[2],
    "backtrack": HYPOTHESES[1],
    "view": HYPOTHESES[3],
    "exhausted": HYPOTHESES[4],
}


class TreePicture(AbstractContextManager["TreePicture"]):
    """``tree.png``: decisions in the order of time from left to right, each with its stage and the hypotheses that it has left.

    Where the robot goes back to a frontier, a new row begins, and a line leads there from the node where that frontier was first known.
    Frontiers that are left at the end hang as pale leaves at the nodes where they were first known.

    Parameters
    ----------
    path
        The PNG file.
    name
        The title.
    """

    def __init__(self, path: Path, name: str) -> None:
        self._path, self._name = path, name
        self._tree = DecisionTree()

    def __repr__(self) -> str:
        return f"<TreePicture of {len(self._tree.nodes)} nodes: {self._path}>"

    def add(self, leg: Leg) -> None:
        """Take the next decision."""
        self._tree.add(leg)

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        if kind is None:
            self._figure().savefig(self._path, dpi=_DPI, format="png")

    def _figure(self) -> Figure:
        nodes = self._tree.nodes
        lanes = 1 + max((each.lane for each in nodes), default=0)
        width = min(max(_LEAST_IN, 1.0 + _NODE_IN * len(nodes)), _MOST_IN)
        height = 1.5 + _LANE_IN * lanes
        figure = Figure(figsize=(width, height), facecolor="white")
        FigureCanvasAgg(figure)
        axes = figure.add_axes((0.0, 0.0, 1.0, 1.0 - 0.85 / height))
        axes.set_axis_off()
        room = max(len(nodes), math.floor((width - 1.0) / _NODE_IN))
        axes.set(xlim=(-0.8, room - 0.2), ylim=(lanes - 0.1, -0.6))
        for at, node in enumerate(nodes):
            if node.parent is not None:
                self._draw_edge(axes, node.parent, at)
        for at, node in enumerate(nodes):
            _draw_leaves(axes, at, node)
            _draw_node(axes, at, node, last=at == len(nodes) - 1)
        self._write(figure, width, height)
        return figure

    def _draw_edge(self, axes: Axes, parent: int, at: int) -> None:
        one, other = self._tree.nodes[parent], self._tree.nodes[at]
        if one.lane == other.lane:
            axes.plot([parent, at], [one.lane, other.lane], color=OCCUPIED, linewidth=1.5, zorder=1)
            return
        corner = parent + 0.5
        axes.plot([parent, corner, corner, at], [one.lane, one.lane, other.lane, other.lane], color=OCCUPIED, linewidth=1.5, zorder=1)
        before = self._tree.nodes[at - 1]
        axes.plot([at - 1, at], [before.lane, other.lane], color=EDGE, linewidth=0.9, linestyle=(0, (2, 2)), zorder=0)

    def _write(self, figure: Figure, width: float, height: float) -> None:
        nodes = self._tree.nodes
        left = 0.25 / width
        drives, open_ones = sum(each.drives for each in nodes), sum(each.left for each in nodes)
        figure.text(left, 1.0 - 0.1 / height, self._name, ha="left", va="top", fontsize=12, fontweight="bold")
        end = f"{nodes[-1].status} after {drives} drive{'s' * (drives != 1)}" if nodes else "no decision"
        remark = (
            f"{end}; {open_ones} frontier{'s' * (open_ones != 1)} left. In a node: hypotheses after it; below: its first decision, drives"
        )
        figure.text(left, 1.0 - 0.36 / height, remark, ha="left", va="top", fontsize=8.5, color="#444444")
        present = {each.stage for each in nodes}
        keys = [Line2D([], [], color=colour, marker="o", markersize=8, linestyle="none", label=stage) for stage, colour in _STAGES.items()]
        keys = [key for key in keys if key.get_label() in present]
        others = sorted(present - _STAGES.keys())
        keys += [Line2D([], [], color=OCCUPIED, marker="o", markersize=8, linestyle="none", label=each) for each in others]
        if open_ones:
            keys.append(Line2D([], [], color=EDGE, marker="o", markersize=6, fillstyle="none", linestyle="none", label="frontier left"))
        if any(each.lane for each in nodes):
            keys.append(Line2D([], [], color=EDGE, linewidth=0.9, linestyle=(0, (2, 2)), label="way back"))
        if any(each.collisions for each in nodes):
            keys.append(Line2D([], [], color=VANISHING, marker="x", markersize=6, markeredgewidth=1.6, linestyle="none", label="collided"))
        corner = left, 1.0 - 0.5 / height
        figure.legend(handles=keys, loc="upper left", bbox_to_anchor=corner, ncols=8, fontsize=8, frameon=False, borderaxespad=0.1)


def _draw_node(axes: Axes, at: int, node: Branching, *, last: bool) -> None:
    colour = _STAGES.get(node.stage, OCCUPIED)
    axes.plot([at], [node.lane], "o", markersize=19, color=colour, markeredgecolor="white", zorder=3)
    if last:
        ring = STATUS_COLOURS[node.status]
        axes.plot([at], [node.lane], "o", markersize=24, fillstyle="none", color=ring, markeredgewidth=2.0, zorder=4)
    axes.text(at, node.lane, str(node.hypotheses), ha="center", va="center", fontsize=8, color=FREE, fontweight="bold", zorder=5)
    times = "" if node.drives < 2 else f" ×{node.drives}"
    axes.text(at, node.lane + 0.27, f"{node.first}{times}", ha="center", va="top", fontsize=7, color="#444444", zorder=5)
    if node.collisions:
        axes.plot([at], [node.lane - 0.3], "x", color=VANISHING, markersize=6, markeredgewidth=1.6, zorder=5)


def _draw_leaves(axes: Axes, at: int, node: Branching) -> None:
    """Draw the frontiers that are left at a node, side by side above it."""
    count = min(node.left, _MOST_LEAVES)
    for number in range(count):
        x, y = at + 0.17 * (number - 0.5 * (count - 1)), node.lane - 0.42
        axes.plot([at, x], [node.lane, y], color=EDGE, linewidth=0.8, alpha=0.7, zorder=0)
        axes.plot([x], [y], "o", color=EDGE, markerfacecolor=FREE, markersize=5, zorder=2)
    if node.left > count:
        axes.text(at, node.lane - 0.47, str(node.left), ha="center", va="bottom", fontsize=6.5, color=EDGE)
