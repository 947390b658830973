"""`BouncingModel`: the sparse set filter: all vertices in which the robot can be, without any automaton.

On a computer it is all that is needed; the automaton is its compiled form, for devices that cannot hold the map.
"""

import numpy as np
import numpy.typing as npt

from ial.bouncing.cells.graph import LabelledGraph
from ial.contractors.kernels import kernel
from ial.membership.model import Model

Vertices = npt.NDArray[np.int32]


@kernel
def _advance(arcs, held, bump, either, seen, out):  # type: ignore[no-untyped-def]
    """Write where the vertices lead whose arc has the label, each once; return how many. `seen` is False everywhere, before and after."""
    count = 0
    for i in range(len(held)):
        arc = arcs[held[i]]
        if either or (arc < 0) == bump:
            to = arc if arc >= 0 else ~arc
            if not seen[to]:
                seen[to] = True
                out[count] = to
                count += 1
    for i in range(count):
        seen[out[i]] = False
    return count


class BouncingModel(Model[Vertices, None, int]):
    """Sets of vertices of a labelled graph, int32 in any order without repeats. The robot moves by itself, so a motion is always None.

    The observation belongs to the step itself and not to the place where it ends. Not for several threads at once.

    Parameters
    ----------
    graph
        The cells and where they lead, of one or several environments.

    Examples
    --------
    >>> from ial.bouncing import BouncingModel, LabelledGraph
    >>> from ial.membership import SetMembershipFilter
    >>> model = BouncingModel(LabelledGraph.of([1, 2, 0], [0, 0, 1]))
    >>> filter = SetMembershipFilter(model, "restart")
    >>> [filter.update(None, reading) for reading in (0, 1, 1)]
    [None, None, Rejection(step=2)]
    """

    def __init__(self, graph: LabelledGraph) -> None:
        self.graph = graph
        self._seen = np.zeros(len(graph), dtype=np.bool_)

    def __repr__(self) -> str:
        return f"<BouncingModel on {self.graph!r}>"

    def universe(self) -> Vertices:
        """Return all vertices."""
        return np.arange(len(self.graph), dtype=np.int32)

    def predict(self, states: Vertices, motion: None) -> Vertices:
        """Return where the robot can be after a step of which nothing was observed."""
        return self._advanced(states, 0, True)

    def step(self, states: Vertices, motion: None, reading: int) -> Vertices:
        """Return where the robot can be after a step with a bump (1) or without one (0)."""
        return self._advanced(states, reading, False)

    def _advanced(self, states: Vertices, reading: int, either: bool) -> Vertices:
        out = np.empty(len(states), dtype=np.int32)
        return out[: _advance(self.graph.arcs, states, bool(reading), either, self._seen, out)].copy()

    def unite(self, allowed: Vertices, predicted: Vertices) -> Vertices:
        """Return the vertices of either set."""
        return np.union1d(allowed, predicted)

    def empty(self, states: Vertices) -> bool:
        """Return whether no vertex is left: the trap, if the filter absorbs."""
        return len(states) == 0
