"""`LabelledGraph`: what happens next from every configuration: one arc from each vertex, labelled 1 for a bump and 0 for none."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.errors import FilterError

MOST_VERTICES = 2**31 - 1
MOST_PARTS = 64


@dataclass(frozen=True, eq=False)
class LabelledGraph:
    """The union of the paper's periodic group I-state graphs: vertices are cells, and each has exactly one arc.

    Parameters
    ----------
    arcs
        int32 of shape (vertices,): where the arc leads, as it is for label 0, and as its complement ``~successor`` (negative) for label 1.
    weights
        How many configurations each vertex stands for, int32 of shape (vertices,); None for one each.
    starts
        Where the vertices of each environment begin, and their number at the end; by default all are of one environment.

    Raises
    ------
    FilterError
        If there is no vertex, or an arc leads to none.
    """

    arcs: npt.NDArray[np.int32]
    weights: npt.NDArray[np.int32] | None = None
    starts: tuple[int, ...] = ()

    def __post_init__(self) -> None:
        count = len(self.arcs)
        if not count:
            raise FilterError("the graph has no vertex; give at least one configuration")
        least, most = int(self.arcs.min()), int(self.arcs.max())
        if most >= count or ~least >= count:
            raise FilterError(f"an arc leads to vertex {max(most, ~least)}, and there are {count}; correct the arcs")
        if not self.starts:
            object.__setattr__(self, "starts", (0, count))

    def __repr__(self) -> str:
        return f"<LabelledGraph of {len(self)} vertices in {len(self.starts)} parts>"

    @classmethod
    def of(cls, successors: npt.ArrayLike, labels: npt.ArrayLike) -> "LabelledGraph":
        """Return a graph from the successor and the label of each vertex."""
        to = np.asarray(successors, dtype=np.int32)
        return cls(np.where(np.asarray(labels, dtype=np.bool_), ~to, to))

    def __len__(self) -> int:
        return len(self.arcs)

    @property
    def successors(self) -> npt.NDArray[np.int32]:
        """C: where each arc leads, int32 of shape (vertices,)."""
        return np.where(self.arcs < 0, ~self.arcs, self.arcs)

    @property
    def labels(self) -> npt.NDArray[np.bool_]:
        """L: whether each arc is a bump, bool of shape (vertices,)."""
        return self.arcs < 0

    @property
    def configurations(self) -> int:
        """How many configurations the vertices stand for."""
        return len(self) if self.weights is None else int(self.weights.sum(dtype=np.int64))

    def part_of(self, vertices: npt.ArrayLike) -> npt.NDArray[np.int64]:
        """Return the number of the environment of each vertex."""
        return np.searchsorted(np.asarray(self.starts), vertices, side="right") - 1


def disjoint_union(graphs: Sequence[LabelledGraph]) -> LabelledGraph:
    """Return one graph with the vertices of several environments, one after the other.

    Raises
    ------
    FilterError
        If there is no graph, or there are too many graphs or vertices.
    """
    if not 1 <= len(graphs) <= MOST_PARTS:
        raise FilterError(f"{len(graphs)} environments cannot be united; give 1 to {MOST_PARTS}")
    if len(graphs) == 1:
        return graphs[0]
    bases = np.concatenate([[0], np.cumsum([len(graph) for graph in graphs])])
    if bases[-1] > MOST_VERTICES:
        raise FilterError(f"the environments have {bases[-1]} configurations together; at most {MOST_VERTICES} are supported")
    arcs = [np.where(graph.arcs < 0, graph.arcs - base, graph.arcs + base) for graph, base in zip(graphs, bases, strict=False)]
    weights = None
    if any(graph.weights is not None for graph in graphs):
        weights = np.concatenate([np.ones(len(graph), dtype=np.int32) if graph.weights is None else graph.weights for graph in graphs])
    starts = [int(base) + start for graph, base in zip(graphs, bases, strict=False) for start in graph.starts[:-1]]
    return LabelledGraph(np.concatenate(arcs).astype(np.int32), weights, (*starts, int(bases[-1])))
