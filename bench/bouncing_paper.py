"""The experiments of Alam et al. 2017: figures 6 and 7, tables I and II, and the rejection of streams from elsewhere."""

from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import numpy as np
import numpy.typing as npt
from bouncing_worlds import KINDS, figure_6, lab
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from report import Report, options
from timing import timed

from ial.bouncing.automata.determinization import determinize
from ial.bouncing.automata.table import FilterTable
from ial.bouncing.cells.cell_map import CellMap
from ial.bouncing.cells.corner import Corner
from ial.bouncing.cells.graph import LabelledGraph
from ial.bouncing.cells.groups import periodic_groups
from ial.bouncing.cells.headings import Headings
from ial.maps.polygons.raster import Raster

ABOUT = """\
The experiments of Alam, Bobadilla and Shell 2017. **The paper's maps are not available**: its figures are missing from the text at hand,
and obstacle sizes are not given. The environments here are drawn from seeds (`bouncing_worlds.py`), so numbers can agree in kind only."""

RUNS, LABS = 100, 1000
FIGURE_7 = {"E1": (3919, 499), "E2": (4787, 602), "E3": (5112, 764), "E4": (3562, 577)}
"""Medians of r and of the longest transient in the specification of issue 5, over 12 runs on environments of its own."""

PAPER = {
    ("figure 8", 45): (129, 1, 4, "1"),
    ("figure 8", 135): (124, 1, 2, "–"),
    ("figure 9", 45): (147, 1, 2, "–"),
    ("figure 9", 135): (202, 1, 1, "2"),
}
"""States of the deterministic automaton (table I), least and greatest number of configurations (table II), r where section V-B says it."""

IntArray = npt.NDArray[np.int64]


def mapped(raster: Raster, angle: int, headings: int, corner: Corner = "segment", merge: bool = False) -> LabelledGraph:
    """Return the graph of a cell map."""
    return CellMap(raster, Headings.of_angle(Fraction(angle), headings), corner, merge).graph


def groups_and_transient(graph: LabelledGraph) -> tuple[int, int]:
    """Return r and the longest transient. In a merged graph, one cycle stands for as many groups as its headings are alike."""
    groups = periodic_groups(graph)
    if graph.weights is None:
        return groups.count, groups.longest_transient
    alike = np.zeros(groups.count + 1, dtype=np.int64)
    alike[groups.group] = graph.weights
    return int(alike.sum()), groups.longest_transient


def figure_7(corner: Corner) -> dict[str, IntArray]:
    """Return r and the longest transient of 100 runs for each kind, int64 of shape (runs, 2)."""
    groups = {}
    for number, kind in enumerate(KINDS):
        rasters = [figure_6(kind, 1000 * number + run) for run in range(RUNS)]
        groups[kind] = np.array([groups_and_transient(mapped(raster, 90, 360, corner, merge=True)) for raster in rasters])
        direct = groups_and_transient(mapped(rasters[0], 90, 360, corner))
        if direct != tuple(groups[kind][0]):
            raise AssertionError(f"{kind}: merged headings gave {groups[kind][0]}, all 360 headings {direct}")
    return groups


def spread(values: IntArray) -> str:
    """Return the least, the quartiles and the greatest in words."""
    least, low, middle, high, most = np.quantile(values, [0.0, 0.25, 0.5, 0.75, 1.0])
    return f"**{middle:.0f}** ({least:.0f}, {low:.0f}–{high:.0f}, {most:.0f})"


def rows_of_figure_7(groups: dict[str, dict[str, IntArray]]) -> Iterator[tuple[str, ...]]:
    """Yield a row for each kind and corner policy."""
    for corner, kinds in groups.items():
        for kind, values in kinds.items():
            r, transient = FIGURE_7[kind]
            yield f"{kind}: {KINDS[kind]}", corner, spread(values[:, 0]), str(r), spread(values[:, 1]), str(transient)


def draw(groups: dict[str, IntArray], path: Path) -> None:
    """Write the two box plots of figure 7."""
    figure = Figure(figsize=(9.0, 3.8), facecolor="white", layout="constrained")
    FigureCanvasAgg(figure)
    titles = ("number of periodic groups r", "length of the longest transient, steps")
    for column, (axes, title) in enumerate(zip(figure.subplots(1, 2), titles, strict=True)):
        axes.boxplot(
            [values[:, column] for values in groups.values()],
            widths=0.55,
            patch_artist=True,
            boxprops={"facecolor": "#cfe0ee", "edgecolor": "#1b6ca8"},
            medianprops={"color": "#c1121f", "linewidth": 1.6},
            whiskerprops={"color": "#1b6ca8"},
            capprops={"color": "#1b6ca8"},
            flierprops={"marker": "o", "markersize": 3.5, "markerfacecolor": "#e8a33d", "markeredgecolor": "none"},
        )
        axes.set_xticks(range(1, len(groups) + 1), list(groups))
        axes.set_title(title, loc="left", fontsize=10)
        axes.grid(axis="y", color="#e6e9ed", linewidth=0.8)
        axes.set_axisbelow(True)
        axes.set_ylim(bottom=0)
        axes.spines[["top", "right"]].set_visible(False)
        axes.tick_params(labelsize=9, colors="#444444")
    figure.suptitle(f"200 × 125 cells, 360 headings, bouncing angle 90°, {RUNS} random environments of each kind", fontsize=10.5)
    figure.savefig(path, dpi=130, format="png")


def tables_1_and_2() -> Iterator[tuple[str, ...]]:
    """Yield the paper's rows beside what random environments of as many cells give."""
    rasters = [lab(seed) for seed in range(LABS)]
    ours = {}
    for angle in (45, 135):
        rows = []
        for raster in rasters:
            graph = mapped(raster, angle, 8)
            automaton = determinize(graph)
            sizes = automaton.cycles.uncertainty
            rows.append((len(automaton), sizes.min(), sizes.max(), periodic_groups(graph).count))
        ours[angle] = np.array(rows)
    for (name, angle), (states, least, most, r) in PAPER.items():
        values = ours[angle]
        below = np.count_nonzero(values[:, 0] <= states)
        same = np.count_nonzero((values[:, 1:3] == (least, most)).all(axis=1))
        seconds, _ = timed(determinize, mapped(rasters[0], angle, 8), runs=200)
        yield (
            f"{name}, {angle}°",
            str(states),
            spread(values[:, 0]),
            f"{below / LABS:.0%}",
            f"{least} to {most}",
            f"{same / LABS:.0%}",
            spread(values[:, 2]),
            r,
            spread(values[:, 3]),
            f"{1e3 * seconds:.3f}",
        )


def rejections(table: FilterTable, graph: LabelledGraph, limit: int) -> IntArray:
    """Return after how many observations a filter rejects the stream of a robot from each vertex; 0 for never within the limit."""
    successors, labels = graph.successors, graph.labels.astype(np.int64)
    rejected = np.zeros(len(graph), dtype=np.int64)
    start = np.arange(len(graph))
    vertex, state = start.copy(), np.zeros(len(graph), dtype=np.int64)
    for observation in range(1, limit + 1):
        state, vertex = table.successors[state, labels[vertex]].astype(np.int64), successors[vertex]
        out = state == table.trap
        if out.any():
            rejected[start[out]] = observation
            start, vertex, state = start[~out], vertex[~out], state[~out]
            if not len(start):
                break
    return rejected


def open_world(rasters: list[Raster], angle: int, limit: int) -> tuple[str, ...]:
    """Return how the filter of each environment meets the streams of the next one, and its own."""
    graphs = [mapped(raster, angle, 8) for raster in rasters]
    foreign, own = [], 0
    for here, elsewhere in pairwise(graphs):
        table = FilterTable.of(determinize(here))
        foreign.append(rejections(table, elsewhere, limit))
        own += np.count_nonzero(rejections(table, here, limit))
    counts = np.concatenate(foreign)
    hits = counts[counts > 0]
    return f"{len(counts):,}", f"{len(hits) / len(counts):.2%}", f"{np.median(hits):.0f}", str(hits.max()), str(own)


def rejection_rows() -> Iterator[tuple[str, ...]]:
    """Yield a row for each size of environments."""
    labs = [lab(seed) for seed in range(101)]
    for angle in (45, 135):
        yield f"100 pairs of 19 cells, {angle}°", *open_world(labs, angle, 2000)
    yield "figure 6 (E3), 3 pairs, 90°", *open_world([figure_6("E3", seed) for seed in range(4)], 90, 4000)


def main() -> None:
    """Measure, print, draw, and write."""
    parser = options(__doc__ or "")
    parser.add_argument("--picture", type=Path, metavar="PNG", help="also draw the box plots of figure 7")
    chosen = parser.parse_args()
    report = Report("The paper's experiments with bouncing robots", ABOUT)
    report.say(
        f"Figure 7, {RUNS} runs each. Ours: median (least, quartiles, greatest). The paper prints box plots without numbers; it says that "
        "r grows with the number of obstacles. *Corner*: may a diagonal step slip between two blocked cells (`endpoint`, as in the paper)? "
        "The median in the specification is that of 12 runs.\n"
    )
    corners: tuple[Corner, ...] = ("endpoint", "segment")
    groups = {corner: figure_7(corner) for corner in corners}
    head = ("inside", "corner", "groups r", "specification", "longest transient", "specification")
    report.table(head, rows_of_figure_7(groups))
    if chosen.picture is not None:
        draw(groups["endpoint"], chosen.picture)
    report.say(
        f"Tables I and II, 152 configurations: 19 cells with 8 headings. Ours: {LABS} random environments, median (least, quartiles, "
        "greatest). The paper's conversion took 20 to 71 s in JFLAP.\n"
    )
    report.table(
        ("paper", "states", "our states", "of ours as small", "configurations", "ours equal", "our worst", "groups r", "our r", "ms"),
        tables_1_and_2(),
    )
    report.say(
        "Open world: the filter of one environment, streams of all robots in another. Own streams must never be rejected. Foreign ones "
        "that are not rejected within 2000 observations (E3: 4000) can be observed in both; E3 rooms share their outer walls and one "
        "obstacle.\n"
    )
    report.table(("environments", "streams", "rejected", "median observations", "most", "own rejected"), rejection_rows())
    report.write(chosen.out)


if __name__ == "__main__":
    main()
