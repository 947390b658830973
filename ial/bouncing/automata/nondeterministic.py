"""`NondeterministicAutomaton`: the nondeterministic I-state automaton (definition 6 of Alam et al. 2017)."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.bouncing.cells.graph import LabelledGraph
from ial.bouncing.cells.groups import periodic_groups


@dataclass(frozen=True, eq=False)
class NondeterministicAutomaton:
    """The vertices of a graph and a state before them, from which the robot silently becomes any of them.

    State 0 is the start; state v + 1 is vertex v.

    Parameters
    ----------
    graph
        The labelled graph.
    final
        Whether each state is final: those of periodic vertices, bool of shape (vertices + 1,).
    """

    graph: LabelledGraph
    final: npt.NDArray[np.bool_]

    def __repr__(self) -> str:
        return f"<NondeterministicAutomaton on {self.graph!r}>"

    @classmethod
    def of(cls, graph: LabelledGraph) -> "NondeterministicAutomaton":
        """Return the automaton of a graph."""
        return cls(graph, np.concatenate([[False], periodic_groups(graph).step == 0]))

    def __len__(self) -> int:
        return len(self.graph) + 1

    def transitions(self) -> Iterator[tuple[int, str, int]]:
        """Yield (from, read, to) for each arc, first the silent ones, which read an empty text."""
        for state in range(1, len(self)):
            yield 0, "", state
        arcs = zip(self.graph.successors.tolist(), self.graph.labels.tolist(), strict=True)
        for state, (successor, label) in enumerate(arcs, 1):
            yield state, "1" if label else "0", successor + 1

    def reach(self, word: str) -> npt.NDArray[np.int64]:
        """Return the states in which a word of 0 and 1 can end, in increasing order; all but the start for the empty word."""
        successors, labels = self.graph.successors, self.graph.labels
        held = np.arange(len(self.graph))
        for letter in word:
            held = np.unique(successors[held[labels[held] == (letter == "1")]])
        return held + 1
