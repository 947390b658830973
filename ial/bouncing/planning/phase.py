"""`Phase`: a robot bounces at one angle until it is on a knowledge cycle; what is known then, from what was known before.

A set of vertices is on a knowledge cycle exactly if all of them are periodic and give the same observations for ever: then the cell map
permutes them in a circle, and nothing more is ever learnt. Both are properties of the graph, computed once; so a phase begins in any set.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.bouncing.cells.graph import LabelledGraph
from ial.bouncing.cells.groups import periodic_groups
from ial.bouncing.planning.information_sets import InformationSets
from ial.bouncing.planning.trace_classes import trace_classes
from ial.contractors.kernels import kernel


@kernel
def _settle(arcs, final, starts, members, weights, elapsed):  # type: ignore[no-untyped-def]
    """Follow each set, divided by what is observed, until it is on a knowledge cycle.

    `final` holds the class of the observations of each periodic vertex, −1 for the others. The images of the two halves of a set take no
    more room than the set, so all work is done where it stands: `members` and `weights` are overwritten.

    Returns
    -------
    tuple
        Number of sets, where they start, their members, the weights of these, the observations until then; arrays longer than filled.
    """
    room = len(members)
    settled, settled_starts = 0, np.empty(room + 1, dtype=np.int64)
    settled_members, settled_weights = np.empty(room, dtype=np.int32), np.empty(room, dtype=np.int64)
    settled_elapsed = np.empty(room, dtype=np.int64)
    bumped, bumped_weights = np.empty(room, dtype=np.int32), np.empty(room, dtype=np.int64)
    stamps, places = np.full(len(arcs), -1, dtype=np.int64), np.empty(len(arcs), dtype=np.int64)
    waiting = np.empty((room + 1, 3), dtype=np.int64)  # first, end, observations
    stamp = 0
    settled_starts[0] = 0
    for number in range(len(starts) - 1):
        waiting[0, 0], waiting[0, 1], waiting[0, 2] = starts[number], starts[number + 1], elapsed[number]
        count = 1
        while count > 0:
            count -= 1
            first, stop, observed = waiting[count, 0], waiting[count, 1], waiting[count, 2]
            while True:
                trace = final[members[first]]
                done = trace >= 0
                for i in range(first + 1, stop):
                    if final[members[i]] != trace:
                        done = False
                        break
                if done:
                    at = settled_starts[settled]
                    for i in range(first, stop):
                        settled_members[at], settled_weights[at] = members[i], weights[i]
                        at += 1
                    settled_elapsed[settled] = observed
                    settled += 1
                    settled_starts[settled] = at
                    break
                still, bumps = first, 0
                for i in range(first, stop):
                    arc, weight = arcs[members[i]], weights[i]
                    if arc >= 0:
                        if stamps[arc] == stamp:
                            weights[places[arc]] += weight
                        else:
                            stamps[arc], places[arc] = stamp, still
                            members[still], weights[still] = arc, weight
                            still += 1
                    else:
                        arc = ~arc
                        if stamps[arc] == stamp + 1:
                            bumped_weights[places[arc]] += weight
                        else:
                            stamps[arc], places[arc] = stamp + 1, bumps
                            bumped[bumps], bumped_weights[bumps] = arc, weight
                            bumps += 1
                stamp += 2
                observed += 1
                for i in range(bumps):
                    members[still + i], weights[still + i] = bumped[i], bumped_weights[i]
                stop = still + bumps
                if still > first and bumps > 0:
                    waiting[count, 0], waiting[count, 1], waiting[count, 2] = still, stop, observed
                    count += 1
                    stop = still
    return settled, settled_starts, settled_members, settled_weights, settled_elapsed


@dataclass(frozen=True, eq=False)
class Phase:
    """Bouncing at one angle.

    Parameters
    ----------
    graph
        The cell map for the angle.
    final
        A number for each periodic vertex, the same for two of them if they give the same observations for ever; −1 for other vertices.
        int32 of shape (vertices,).
    """

    graph: LabelledGraph
    final: npt.NDArray[np.int32]

    def __repr__(self) -> str:
        return f"<Phase on {self.graph!r}>"

    @classmethod
    def of(cls, graph: LabelledGraph) -> "Phase":
        """Return the phase of a cell map."""
        periodic = periodic_groups(graph).step == 0
        return cls(graph, np.where(periodic, trace_classes(graph), -1).astype(np.int32))

    def after(self, known: InformationSets) -> InformationSets:
        """Return what is known at the end, when each set has become one or several sets on knowledge cycles.

        Parameters
        ----------
        known
            Sets of vertices of this graph, as they are when the phase begins.
        """
        settled, starts, members, weights, elapsed = _settle(
            self.graph.arcs, self.final, known.starts, known.members.copy(), known.weights.copy(), known.elapsed
        )
        return InformationSets.united(starts[: settled + 1], members, weights, elapsed[:settled])
