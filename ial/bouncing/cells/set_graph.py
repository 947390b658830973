"""`SetGraph`: where a robot can go from each vertex if it can go to several: successors as compressed rows, for each label."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.errors import FilterError

Rows = tuple[npt.NDArray[np.int64], npt.NDArray[np.int32]]

MOST_ARCS = 2**30


@dataclass(frozen=True, eq=False)
class SetGraph:
    """A graph with any number of arcs from each vertex, labelled 0 for a step without a bump and 1 for a bump.

    Parameters
    ----------
    starts
        For each label, where the successors of each vertex begin, and their number at the end: int64 of shape (vertices + 1,).
    ends
        For each label, the successors, int32 of shape (arcs,).
    first
        How many of the vertices, from 0 on, a robot can start in.

    Raises
    ------
    FilterError
        If an arc leads to no vertex.
    """

    starts: tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]
    ends: tuple[npt.NDArray[np.int32], npt.NDArray[np.int32]]
    first: int

    def __post_init__(self) -> None:
        for ends in self.ends:
            if len(ends) and not 0 <= ends.min() <= ends.max() < len(self):
                raise FilterError(f"an arc leads to vertex {ends.max()}, and there are {len(self)}; correct the arcs")

    def __len__(self) -> int:
        return len(self.starts[0]) - 1

    def __repr__(self) -> str:
        return f"<SetGraph of {len(self)} vertices and {self.arcs} arcs>"

    @property
    def arcs(self) -> int:
        """How many arcs there are."""
        return sum(map(len, self.ends))

    def successors(self, vertex: int, label: int) -> npt.NDArray[np.int32]:
        """Return where a vertex can lead with a label."""
        return self.ends[label][self.starts[label][vertex] : self.starts[label][vertex + 1]]


def rows_of(begins: npt.NDArray[np.int64], ends: npt.NDArray[np.int64], count: int) -> Rows:
    """Return compressed rows of arcs in any order; repeated arcs are kept once.

    Raises
    ------
    FilterError
        If there are too many.
    """
    if len(begins) > MOST_ARCS:
        raise FilterError(f"the graph would have {len(begins)} arcs; use larger cells, fewer headings or smaller bounds of errors")
    keys = np.unique(begins * count + ends)
    row, to = np.divmod(keys, count)
    starts = np.zeros(count + 1, dtype=np.int64)
    np.cumsum(np.bincount(row, minlength=count), out=starts[1:])
    return starts, to.astype(np.int32)


def disjoint_set_union(graphs: Sequence[SetGraph]) -> tuple[SetGraph, npt.NDArray[np.int32]]:
    """Return one graph with the vertices of several environments, and which start each of its vertices is at the place of.

    The starts of all graphs come first, one graph after the other; what else they have follows in the same order.

    Raises
    ------
    FilterError
        If there is no graph.
    """
    if not graphs:
        raise FilterError("no environment to be in; give at least one")
    firsts, others = [graph.first for graph in graphs], [len(graph) - graph.first for graph in graphs]
    bases, more = np.cumsum([0, *firsts]), np.cumsum([sum(firsts), *others])
    renumbered = [
        np.concatenate([np.arange(graph.first) + base, np.arange(other) + after]).astype(np.int32)
        for graph, base, after, other in zip(graphs, bases, more, others, strict=False)
    ]
    starts, ends = [], []
    for label in (0, 1):
        cuts = [np.split(graph.ends[label], graph.starts[label][graph.first : graph.first + 1]) for graph in graphs]
        ordered = [numbers[each[part]] for part in (0, 1) for numbers, each in zip(renumbered, cuts, strict=True)]
        counts = [np.diff(graph.starts[label]) for graph in graphs]
        sizes = [each[: graph.first] for graph, each in zip(graphs, counts, strict=True)]
        sizes += [each[graph.first :] for graph, each in zip(graphs, counts, strict=True)]
        starts.append(np.concatenate([[0], np.cumsum(np.concatenate(sizes))]).astype(np.int64))
        ends.append(np.concatenate(ordered))
    places = [np.arange(graph.first, dtype=np.int32) + np.int32(base) for graph, base in zip(graphs, bases, strict=False)]
    places += [(np.arange(other) % graph.first + base).astype(np.int32) for graph, base, other in zip(graphs, bases, others, strict=False)]
    return SetGraph((starts[0], starts[1]), (ends[0], ends[1]), sum(firsts)), np.concatenate(places)
