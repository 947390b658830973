"""`PeriodicGroups`: the limit cycles of a cell map, and how each vertex gets to one (Algorithm 1 of Alam et al. 2017, corrected).

Every vertex is walked through once, and a path remembers the way: no recursion, and time in O(vertices). The paper's algorithm as printed
overwrites its own loop variable, leaves the index d undefined (it is that of the first visit of the repeated vertex), and in definition 3
counts its exponents from the wrong cell.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from ial.bouncing.cells.graph import LabelledGraph
from ial.contractors.kernels import kernel

_ON_PATH = -1


@kernel
def _find_groups(arcs, group, step, path):  # type: ignore[no-untyped-def]
    """Write the group, from 1 in the order of discovery, and the step number of each vertex; return the number of groups."""
    groups = 0
    for first in range(len(arcs)):
        vertex, length = first, 0
        while group[vertex] == 0:
            group[vertex] = _ON_PATH
            step[vertex] = length  # for now: where it stands on the path
            path[length] = vertex
            length += 1
            vertex = arcs[vertex] if arcs[vertex] >= 0 else ~arcs[vertex]
        if length == 0:
            continue
        if group[vertex] == _ON_PATH:
            groups += 1
            cycle = step[vertex]
            for at in range(cycle, length):
                group[path[at]] = groups
                step[path[at]] = 0
            length = cycle
        number, distance = group[vertex], step[vertex]
        for at in range(length - 1, -1, -1):
            distance += 1
            group[path[at]] = number
            step[path[at]] = distance
    return groups


@dataclass(frozen=True, eq=False)
class PeriodicGroups:
    """The periodic groups of a graph; they are numbered from 1.

    Parameters
    ----------
    group
        The group in which each vertex ends, int32 of shape (vertices,).
    step
        How many steps it takes to get there, int32 of shape (vertices,); 0 for periodic vertices.
    count
        r: how many groups there are.
    bumping
        Which groups consist of bumps only, bool of shape (count,): there the robot turns on the spot for ever, trapped between walls.
    """

    group: npt.NDArray[np.int32]
    step: npt.NDArray[np.int32]
    count: int
    bumping: npt.NDArray[np.bool_]

    def __repr__(self) -> str:
        return f"<PeriodicGroups: {self.count} of {len(self.group)} vertices>"

    @cached_property
    def periods(self) -> npt.NDArray[np.int64]:
        """The period of each group, int64 of shape (count,)."""
        return np.bincount(self.group[self.step == 0], minlength=self.count + 1)[1:]

    @cached_property
    def basins(self) -> npt.NDArray[np.int64]:
        """How many vertices end in each group, its own included, int64 of shape (count,)."""
        return np.bincount(self.group, minlength=self.count + 1)[1:]

    @property
    def longest_transient(self) -> int:
        """The largest number of steps to a periodic group."""
        return int(self.step.max())


def periodic_groups(graph: LabelledGraph) -> PeriodicGroups:
    """Return the periodic groups of a graph with the group and step number of each vertex."""
    group, step, path = np.zeros(len(graph), dtype=np.int32), np.empty(len(graph), dtype=np.int32), np.empty(len(graph), dtype=np.int32)
    count = _find_groups(graph.arcs, group, step, path)
    moving = np.zeros(count + 1, dtype=np.bool_)
    moving[group[(step == 0) & (graph.arcs >= 0)]] = True
    return PeriodicGroups(group, step, count, ~moving[1:])
