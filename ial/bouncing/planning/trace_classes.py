"""Vertices with the same observations for ever, and the graph that takes them together.

This is the coarsest quotient of a labelled graph. Its automaton accepts the same streams and is never larger, but its sets are sets of
classes: how many configurations the robot can be in is lost. `HeadingClasses` is the quotient that keeps it.
"""

import numpy as np
import numpy.typing as npt

from ial.bouncing.automata.partition import coarsest_partition
from ial.bouncing.cells.graph import LabelledGraph


def trace_classes(graph: LabelledGraph) -> npt.NDArray[np.int32]:
    """Return the class of each vertex, int32 of shape (vertices,): two are in one class if they emit the same labels for ever."""
    return coarsest_partition(graph.successors[:, None], graph.labels.astype(np.int32))


def trace_quotient(graph: LabelledGraph) -> tuple[LabelledGraph, npt.NDArray[np.int32]]:
    """Return the graph of the trace classes, and the class of each vertex. The environments are taken together."""
    classes = trace_classes(graph)
    _, first = np.unique(classes, return_index=True)
    return LabelledGraph.of(classes[graph.successors[first]], graph.labels[first]), classes
