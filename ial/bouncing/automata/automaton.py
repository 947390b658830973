"""`Automaton`: the deterministic I-state automaton (definition 7 of Alam et al. 2017): its states are sets of places the robot can be in.

The paper bounds its states by O(N²) (proposition 1). For labelled graphs in general that is false: five cycles of 2·3, 2·5, … 2·13 vertices
with labels that repeat 01 give one knowledge cycle of 30,030 states, the least common multiple. Cell maps are invariant under translation,
which rules this out; the number of states is limited all the same.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from ial.bouncing.automata.cycle_walk import walk_cycles
from ial.bouncing.cells.graph import LabelledGraph
from ial.errors import FilterError

IN_NO_CYCLE = 1


@dataclass(frozen=True, eq=False)
class KnowledgeCycles:
    """The closed paths that the automaton never leaves; cycle i has the colour i + 2.

    Parameters
    ----------
    anchors
        One state of each cycle, int32 of shape (cycles,).
    lengths
        How many states each has, int64 of shape (cycles,).
    uncertainty
        How many configurations the robot can be in, the same for all states of a cycle, int64 of shape (cycles,).
    starts, members
        The set of the anchor of cycle i is ``members[starts[i] : starts[i + 1]]``: vertices, int32.
    """

    anchors: npt.NDArray[np.int32]
    lengths: npt.NDArray[np.int64]
    uncertainty: npt.NDArray[np.int64]
    starts: npt.NDArray[np.int64]
    members: npt.NDArray[np.int32]

    def __len__(self) -> int:
        return len(self.anchors)

    def __repr__(self) -> str:
        return f"<KnowledgeCycles: {len(self)}, of {self.lengths.sum()} states>"


@dataclass(frozen=True, eq=False)
class Automaton:
    """A deterministic automaton over bumps; state 0 is the start, where nothing is known.

    Parameters
    ----------
    graph
        What it was made from.
    successors
        The state after each observation, int32 of shape (states, 2), −1 where no vertex of the set can make it.
    sizes
        How many vertices the set of each state has, int32 of shape (states,).
    uncertainty
        How many configurations they stand for, int64 of shape (states,).
    environments
        In which environments the robot can be, as bits, uint64 of shape (states,).
    colours
        1 outside of knowledge cycles, else 2 + number of the cycle, int32 of shape (states,).
    cycles
        The knowledge cycles.
    depth
        After so many observations every robot is in a knowledge cycle, and some need as many.
    """

    graph: LabelledGraph
    successors: npt.NDArray[np.int32]
    sizes: npt.NDArray[np.int32]
    uncertainty: npt.NDArray[np.int64]
    environments: npt.NDArray[np.uint64]
    colours: npt.NDArray[np.int32]
    cycles: KnowledgeCycles
    depth: int

    def __len__(self) -> int:
        return len(self.successors)

    def __repr__(self) -> str:
        return f"<Automaton of {len(self)} states, {len(self.cycles)} knowledge cycles, depth {self.depth}>"

    @cached_property
    def _steps(self) -> npt.NDArray[np.int64]:
        """How many steps each state stands past the anchor of its cycle."""
        return walk_cycles(self.successors, self.cycles.anchors)[1]

    def cells(self, state: int) -> npt.NDArray[np.int32]:
        """Return the vertices of a state of a knowledge cycle, in increasing order.

        Raises
        ------
        FilterError
            If the state is on no knowledge cycle; only those sets are kept.
        """
        cycle = int(self.colours[state]) - 2
        if cycle < 0:
            raise FilterError(f"state {state} is on no knowledge cycle, so its set is not kept; use `BouncingModel` for all sets")
        places = self.cycles.members[self.cycles.starts[cycle] : self.cycles.starts[cycle + 1]]
        for _ in range(int(self._steps[state])):
            arcs = self.graph.arcs[places]
            places = np.where(arcs < 0, ~arcs, arcs)
        return np.sort(places)
