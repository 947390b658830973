"""`CyclePlaces`: where a robot can be in each state of the knowledge cycles, in little memory.

A set is kept for one state of each cycle. The others follow from it, since the sets of a cycle are moved into each other by the cell map,
which is kept for the periodic vertices only: no others are in such sets.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.bouncing.automata.automaton import Automaton
from ial.bouncing.cells.cell_map import CellMap
from ial.bouncing.cells.groups import periodic_groups

IntArray = npt.NDArray[np.int32]


@dataclass(frozen=True, eq=False)
class CyclePlaces:
    """The periodic vertices of several environments, and the sets of the knowledge cycles.

    Parameters
    ----------
    environment, row, column, heading_class
        What each periodic vertex stands for, int32 of shape (periodic,).
    following
        Where each leads, among the periodic ones, int32 of shape (periodic,).
    anchors
        One state of each cycle, int32 of shape (cycles,).
    starts, members
        The set of the anchor of cycle i is ``members[starts[i] : starts[i + 1]]``, among the periodic ones; int64 and int32.
    """

    environment: IntArray
    row: IntArray
    column: IntArray
    heading_class: IntArray
    following: IntArray
    anchors: IntArray
    starts: npt.NDArray[np.int64]
    members: IntArray

    def __repr__(self) -> str:
        return f"<CyclePlaces: {len(self.row)} periodic vertices, {len(self.anchors)} knowledge cycles>"

    @classmethod
    def of(cls, automaton: Automaton, maps: Sequence[CellMap]) -> "CyclePlaces":
        """Return the places of an automaton that was made from the union of these maps."""
        graph, cycles = automaton.graph, automaton.cycles
        periodic = np.flatnonzero(periodic_groups(graph).step == 0)
        local = np.full(len(graph), -1, dtype=np.int32)
        local[periodic] = np.arange(len(periodic), dtype=np.int32)
        environment = graph.part_of(periodic).astype(np.int32)
        parts = [maps[number].configurations(periodic[environment == number] - graph.starts[number]) for number in range(len(maps))]
        row, column, heading_class = (np.concatenate(each) for each in zip(*parts, strict=True))
        arcs = graph.arcs[periodic]
        following = local[np.where(arcs < 0, ~arcs, arcs)]
        return cls(environment, row, column, heading_class, following, cycles.anchors, cycles.starts, local[cycles.members])

    def at(self, cycle: int, steps: int) -> IntArray:
        """Return the periodic vertices of the state so many steps past the anchor of a cycle, in increasing order."""
        vertices = self.members[self.starts[cycle] : self.starts[cycle + 1]]
        for _ in range(steps):
            vertices = self.following[vertices]
        return np.sort(vertices)
