"""The check of an automaton, set by set: slow, and independent of how it was built."""

import numpy as np
import numpy.typing as npt

from ial.bouncing.automata.automaton import Automaton
from ial.errors import FilterError


def compare_sets(automaton: Automaton, begins: npt.NDArray[np.int32]) -> None:
    """Compare the image of the set of every state with the set of its successor, element by element.

    Parameters
    ----------
    automaton
        Its sets must fit into the memory all at once.
    begins
        The vertices in which the robot can start.

    Raises
    ------
    FilterError
        If a successor stands for another set, is missing, or leads where no vertex goes.
    """
    successors, labels = automaton.graph.successors, automaton.graph.labels
    sets: list[npt.NDArray[np.int32] | None] = [None] * len(automaton)
    sets[0] = np.sort(begins)
    for state in range(len(automaton)):
        held = sets[state]
        if held is None or len(held) != automaton.sizes[state]:
            raise FilterError(f"state {state} cannot be reached, or its set has another size; two sets may have been confused: report this")
        for label in (0, 1):
            image = np.unique(successors[held[labels[held] == bool(label)]])
            to = int(automaton.successors[state, label])
            known = sets[to] if to >= 0 else image[:0]
            if known is None:
                sets[to] = known = image
            if not np.array_equal(known, image):
                raise FilterError(f"observation {label} leads from state {state} to state {to}, which stands for another set: report this")
