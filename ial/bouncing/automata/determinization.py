"""`determinize`: from a labelled graph to its deterministic automaton."""

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from ial.bouncing.automata.automaton import IN_NO_CYCLE, Automaton, KnowledgeCycles
from ial.bouncing.automata.cycle_walk import walk_cycles
from ial.bouncing.automata.subset import PAUSED, TOO_MANY, begun, construct, depth_of
from ial.bouncing.automata.verification import compare_sets
from ial.bouncing.cells.graph import MOST_PARTS, LabelledGraph
from ial.errors import ConfigError, FilterError

MOST_STATES, LARGEST_LIMIT = 2**24, 2**30
_VISITS = 2**24  # of vertices between two reports; some tenths of a second


class TooManyStatesError(FilterError):
    """The automaton has more states than it may have, or than can be found with the work that is allowed.

    Parameters
    ----------
    message
        What to do about it.
    states
        It has more than so many.
    """

    def __init__(self, message: str, states: int) -> None:
        super().__init__(message)
        self.states = states


def determinize(
    graph: LabelledGraph,
    most_states: int = MOST_STATES,
    verify: bool = False,
    begins: npt.NDArray[np.int32] | None = None,
    progress: Callable[[int], object] | None = None,
    most_visits: int | None = None,
) -> Automaton:
    """Return the deterministic automaton of a graph, by subset construction.

    Parameters
    ----------
    graph
        The cells and where they lead.
    most_states
        The number of states at which to give up, at most 2³⁰.
    verify
        Also compare the sets that all arcs lead to, element by element. Sets are otherwise recognized by 128 bits and their size, which
        confuses two of them with a probability below 10⁻²⁰ for as many states as fit into a memory.
    begins
        The vertices in which the robot can start, each once; any of them by default.
    progress
        Called with the number of states that were found so far, each time that some millions of vertices were visited.
    most_visits
        After about so many visits of vertices give up, too: a measure of work that is the same on every machine. Not limited by default.

    Raises
    ------
    ConfigError
        If it can start nowhere.
    TooManyStatesError
        If there would be more states, or more visits.
    FilterError
        If there are too many environments, or `verify` finds two sets that were confused.
    """
    none = np.empty(0, dtype=np.int32)
    many = len(graph.starts) > 2
    if len(graph.starts) > MOST_PARTS + 1:
        raise FilterError(f"the graph has {len(graph.starts) - 1} environments; at most {MOST_PARTS} are supported")
    parts = np.repeat(np.arange(len(graph.starts) - 1, dtype=np.uint8), np.diff(graph.starts)) if many else np.empty(0, dtype=np.uint8)
    begins = np.arange(len(graph), dtype=np.int32) if begins is None else begins
    if not len(begins):
        raise ConfigError("the robot can start in no configuration; check the region and the heading at the start")
    arrays = graph.arcs, none if graph.weights is None else graph.weights, parts
    limit = min(most_states, LARGEST_LIMIT)
    outcome, visits, work = PAUSED, 0, begun(begins, *arrays)
    while outcome == PAUSED:
        more = _VISITS if most_visits is None else min(_VISITS, most_visits - visits)
        if more <= 0:
            states = int(work[0][0]) - 1
            raise TooManyStatesError(f"the automaton has more than {states} states, and the work that was allowed for it is done", states)
        outcome, work = construct(*arrays, limit, more, work)
        visits += more
        if progress is not None:
            progress(int(work[0][0]))
    (states, _, _, cycles), successors, counts, sums, anchors, starts, members = work[:7]
    if outcome == TOO_MANY:
        raise TooManyStatesError(
            f"the automaton has more than {limit} states; use larger cells, fewer headings or another angle, or allow more states; "
            "ial bounce advise shows what other choices come to",
            limit,
        )
    successors, sizes = successors[:states].copy(), counts[:states, 0].astype(np.int32)
    uncertainty = counts[:states, 0 if graph.weights is None else 1].copy()
    environments = sums[:states, 2].copy() if many else np.ones(states, dtype=np.uint64)
    anchors = anchors[:cycles].copy()
    colours = walk_cycles(successors, anchors)[0] + np.int32(IN_NO_CYCLE + 1)
    depth = depth_of(successors, colours)
    lengths = np.bincount(colours, minlength=cycles + 2)[2:]
    starts = starts[: cycles + 1].copy()
    knowledge = KnowledgeCycles(anchors, lengths, uncertainty[anchors], starts, members[: starts[-1]].copy())
    automaton = Automaton(graph, successors, sizes, uncertainty, environments, colours, knowledge, int(depth))
    if verify:
        compare_sets(automaton, begins)
    return automaton
