"""`NoisyModel`: the sparse set filter on a set-valued map."""

import numpy as np
import numpy.typing as npt

from ial.bouncing.cells.set_graph import SetGraph
from ial.contractors.kernels import kernel
from ial.membership.model import Model

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

    def __repr__(self) -> str:
        return f"<NoisyModel on {self.graph!r}>"

    def universe(self) -> Vertices:
        """Return all vertices in which a robot can start."""
        return np.arange(self.graph.first, dtype=np.int32)

    def predict(self, states: Vertices, motion: None) -> Vertices:
        """Return where the robot can be after a step of which nothing was observed."""
        return np.union1d(self.step(states, None, 0), self.step(states, None, 1))

    def step(self, states: Vertices, motion: None, reading: int) -> Vertices:
        """Return where the robot can be after a step with a bump (1) or without one (0)."""
        return self._out[: _spread(self.graph.starts[reading], self.graph.ends[reading], states, self._seen, self._out)].copy()

    def unite(self, allowed: Vertices, predicted: Vertices) -> Vertices:
        """Return the vertices of either set."""
        return np.union1d(allowed, predicted)

    def empty(self, states: Vertices) -> bool:
        """Return whether no vertex is left."""
        return len(states) == 0
