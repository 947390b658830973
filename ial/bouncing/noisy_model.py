"""`NoisyModel`: the sparse set filter on a set-valued map; and `determinize_sets`, which shows what its automaton would cost."""

from collections import deque
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.bouncing.set_graph import SetGraph
from ial.contractors.kernels import kernel
from ial.errors import FilterError
from ial.membership import Model

Vertices = npt.NDArray[np.int32]


@kernel
def _spread(starts, ends, held, seen, out):  # type: ignore[no-untyped-def]
    """Write where the vertices can lead, each once; return how many. `seen` is False everywhere, before and after."""
    count = 0
    for i in range(len(held)):
        for at in range(starts[held[i]], starts[held[i] + 1]):
            to = ends[at]
            if not seen[to]:
                seen[to] = True
                out[count] = to
                count += 1
    for i in range(count):
        seen[out[i]] = False
    return count


class NoisyModel(Model[Vertices, None, int]):
    """Sets of vertices of a set-valued graph, int32 in any order without repeats; a reading is 1 for a bump, 0 for a step without one.

    Not for several threads at once.

    Parameters
    ----------
    graph
        The vertices and where they can lead.
    """

    def __init__(self, graph: SetGraph) -> None:
        self.graph = graph
        self._seen = np.zeros(len(graph), dtype=np.bool_)
        self._out = np.empty(len(graph), dtype=np.int32)

    def universe(self) -> Vertices:
        """Return all vertices in which a robot can start."""
        return np.arange(self.graph.first, dtype=np.int32)

    def predict(self, states: Vertices, motion: None) -> Vertices:
        """Return where the robot can be after a step of which nothing was observed."""
        return np.union1d(self.step(states, None, 0), self.step(states, None, 1))

    def contract(self, states: Vertices, reading: int) -> Vertices:
        """Return the same vertices: behind a step, nothing tells any more how it was made."""
        return states

    def step(self, states: Vertices, motion: None, reading: int) -> Vertices:
        """Return where the robot can be after a step with a bump (1) or without one (0)."""
        return self._out[: _spread(self.graph.starts[reading], self.graph.ends[reading], states, self._seen, self._out)].copy()

    def empty(self, states: Vertices) -> bool:
        """Return whether no vertex is left."""
        return len(states) == 0

    def restart(self, states: Vertices, motion: None, reading: int) -> Vertices:
        """Return every vertex in which a robot can start, to begin anew after a rejection."""
        return self.universe()


@dataclass(frozen=True, eq=False)
class SetAutomaton:
    """The deterministic automaton of a set-valued graph; state 0 is the start.

    Parameters
    ----------
    successors
        The state behind each observation, int32 of shape (states, 2), −1 where there is none.
    sizes
        How many vertices the robot can be in, int64 of shape (states,).
    """

    successors: npt.NDArray[np.int32]
    sizes: npt.NDArray[np.int64]

    def __len__(self) -> int:
        return len(self.sizes)


def determinize_sets(graph: SetGraph, most_states: int = 100_000) -> SetAutomaton:
    """Return the deterministic automaton of a set-valued graph. Sets may overlap in every way, so there may be very many.

    Raises
    ------
    FilterError
        If there would be more states than allowed.
    """
    model = NoisyModel(graph)
    start = model.universe()
    numbers = {start.tobytes(): 0}
    waiting, successors, sizes = deque([start]), [], [len(start)]
    while waiting:
        held, row = waiting.popleft(), []
        for label in (0, 1):
            found = np.sort(model.step(held, None, label))
            if not len(found):
                row.append(-1)
                continue
            number = numbers.setdefault(found.tobytes(), len(numbers))
            if number == len(sizes):
                if number >= most_states:
                    raise FilterError(
                        f"the automaton has more than {most_states} states; use larger cells, smaller bounds of errors, or the filter "
                        "of sets, which needs no automaton"
                    )
                sizes.append(len(found))
                waiting.append(found)
            row.append(number)
        successors.append(row)
    return SetAutomaton(np.array(successors, dtype=np.int32), np.array(sizes, dtype=np.int64))
