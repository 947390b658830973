"""The bouncing robot: its cell map, its automaton with and without merged headings, and automata-lib on the same automaton."""

import resource
import sys
from collections.abc import Iterator
from fractions import Fraction
from importlib.metadata import version
from typing import Any

import numpy as np
from report import Report, options
from timing import timed

from ial.bouncing.automata.automaton import Automaton
from ial.bouncing.automata.determinization import determinize
from ial.bouncing.automata.minimal import minimize
from ial.bouncing.automata.nondeterministic import NondeterministicAutomaton
from ial.bouncing.automata.table import FilterTable
from ial.bouncing.cells.cell_map import CellMap
from ial.bouncing.cells.graph import LabelledGraph
from ial.bouncing.cells.groups import periodic_groups
from ial.bouncing.cells.headings import Headings
from ial.bouncing.cells.model import BouncingModel
from ial.contractors import threads
from ial.maps.polygons.raster import Raster

ABOUT = """\
The environment of figure 6 of the paper, 200 × 125 cells with a static obstacle at the wall and three placed at random inside, bouncing
angle 90°. *Merged*: headings that cannot be told apart are one vertex; states and uncertainties are the same. The small environments have
19 cells with 8 headings, as the paper's tables, whose maps are not available. Compilation is not counted."""

SMALL = {
    "room with a corner": [(0, 0), (0, 1), (0, 2), (3, 3), (4, 4), (2, 2)],
    "two niches": [(0, 2), (2, 0), (2, 1), (4, 2), (4, 3), (1, 4)],
}
"""The blocked cells, (row, column), of 5 × 5."""


def figure_6(seed: int, rows: int = 125, columns: int = 200) -> Raster:
    """Return a room with one obstacle at its wall and three inside: a square, a rectangle and an L."""
    chooser = np.random.default_rng(seed)
    free = np.ones((rows, columns), dtype=np.bool_)
    free[: rows // 5, columns // 2 - 10 : columns // 2 + 10] = False
    for shape in (np.ones((20, 20)), np.ones((15, 35)), np.pad(np.ones((12, 12)), ((0, 12), (0, 12)))):
        shape[: shape.shape[0] // 2] = 1
        row, column = chooser.integers(1, rows - shape.shape[0]), chooser.integers(1, columns - shape.shape[1])
        free[row : row + shape.shape[0], column : column + shape.shape[1]] &= shape == 0
    return Raster(free)


def mapped(raster: Raster, angle: int, headings: int, merge: bool = False) -> LabelledGraph:
    """Return the graph of a cell map."""
    return CellMap(raster, Headings.of_angle(Fraction(angle), headings), merge=merge).graph


def large(raster: Raster) -> Iterator[tuple[str, ...]]:
    """Yield what is measured on more than 8 million configurations."""
    count = 360 * int(raster.free.sum())
    seconds, whole = timed(mapped, raster, 90, 360)
    yield "cell map", f"{count:,}", f"{seconds:.3f}", f"threads: {threads.get_threads()}"
    seconds, groups = timed(periodic_groups, whole)
    yield "periodic groups", f"{count:,}", f"{seconds:.3f}", f"{groups.count} groups, longest transient {groups.longest_transient}"
    model, observed = BouncingModel(whole), observations(whole, 500)

    def follow() -> int:
        states = model.universe()
        for reading in observed:
            states = model.step(states, None, reading)
        return len(states)

    seconds, left = timed(follow)
    yield "sparse set filter, 500 observations", f"{count:,}", f"{seconds:.3f}", f"{left} configurations left"
    seconds, (merged, automaton) = timed(lambda: both(raster, True))
    yield "cell map and automaton, merged", f"{len(merged):,}", f"{seconds:.3f}", words(automaton)
    seconds, minimal = timed(minimize, FilterTable.of(automaton))
    yield "minimization, colours kept", f"{len(automaton):,} states", f"{seconds:.3f}", f"{len(minimal) - 1:,} states"
    seconds, automaton = timed(determinize, whole, runs=1)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (1e9 if sys.platform == "darwin" else 1e6)
    yield "automaton, directly", f"{count:,}", f"{seconds:.1f}", f"{words(automaton)}; the process took {peak:.2f} GB at most"


def both(raster: Raster, merge: bool) -> tuple[LabelledGraph, Automaton]:
    """Return the graph and the automaton."""
    graph = mapped(raster, 90, 360, merge)
    return graph, determinize(graph)


def words(automaton: Automaton) -> str:
    """Return what an automaton is."""
    least, most = automaton.cycles.uncertainty.min(), automaton.cycles.uncertainty.max()
    return f"{len(automaton):,} states, {len(automaton.cycles)} cycles, uncertainty {least} to {most}, depth {automaton.depth}"


def observations(graph: LabelledGraph, count: int) -> list[int]:
    """Return what a robot observes from the vertex in the middle."""
    vertex, bumps = len(graph) // 2, []
    for _ in range(count):
        arc = int(graph.arcs[vertex])
        bumps.append(int(arc < 0))
        vertex = arc if arc >= 0 else ~arc
    return bumps


def small() -> Iterator[tuple[str, ...]]:
    """Yield what is measured on 152 configurations."""
    for name, blocked in SMALL.items():
        free = np.ones((5, 5), dtype=np.bool_)
        free[tuple(np.transpose(blocked))] = False
        for angle in (45, 90, 135):
            graph = mapped(Raster(free), angle, 8)
            seconds, automaton = timed(determinize, graph, runs=200)
            yield f"{name}, {angle}°", str(len(graph)), f"{1e3 * seconds:.3f}", words(automaton)


def oracle(raster: Raster) -> Iterator[tuple[str, ...]]:
    """Yield one automaton of 10⁵ vertices here and in automata-lib."""
    graph = mapped(raster, 90, 8)
    ours, automaton = timed(determinize, graph)
    yield "ial", f"{len(graph):,}", f"{ours:.3f}", f"{len(automaton):,}", "1"
    try:
        from automata.fa.dfa import DFA
        from automata.fa.nfa import NFA
    except ImportError:
        yield "automata-lib", f"{len(graph):,}", "–", "not installed: `pip install automata-lib`", "–"
        return
    nondeterministic = NondeterministicAutomaton.of(graph)
    arcs: dict[int, dict[str, set[int]]] = {state: {} for state in range(len(nondeterministic))}
    for start, read, end in nondeterministic.transitions():
        arcs[start].setdefault(read, set()).add(end)
    final = set(np.flatnonzero(nondeterministic.final).tolist())
    theirs: Any = NFA(states=set(arcs), input_symbols={"0", "1"}, transitions=arcs, initial_state=0, final_states=final)
    seconds, dfa = timed(lambda: DFA.from_nfa(theirs, minify=False), runs=1)
    traps = [state for state, row in dfa.transitions.items() if state not in dfa.final_states and set(row.values()) == {state}]
    states = len(dfa.states) - len(traps)
    yield f"automata-lib {version('automata-lib')}", f"{len(graph):,}", f"{seconds:.1f}", f"{states:,}", f"{seconds / ours:.0f}"


def main() -> None:
    """Measure, print, and write."""
    chosen = options(__doc__ or "").parse_args()
    report = Report("The bouncing robot", ABOUT)
    raster = figure_6(1)
    report.table(("work", "vertices", "s", "result"), large(raster))
    report.table(("environment", "vertices", "ms", "result"), small())
    report.say("The same automaton in automata-lib; its trap is not counted.\n")
    report.table(("library", "vertices", "s", "states", "times as long"), oracle(figure_6(2, 100, 140)))
    report.write(chosen.out)


if __name__ == "__main__":
    main()
