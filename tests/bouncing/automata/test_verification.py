from dataclasses import replace

import numpy as np
import pytest

from ial.bouncing.automata.determinization import determinize
from ial.bouncing.automata.verification import compare_sets
from ial.errors import FilterError
from tests.bouncing.worlds import cell_map, random_mask


def test_a_wrong_arc_does_not_pass_verification() -> None:
    automaton = determinize(cell_map(random_mask(6)).graph)
    wrong = automaton.successors.copy()
    state = int(np.flatnonzero((wrong >= 0).all(axis=1))[3])
    wrong[state] = wrong[state, ::-1]
    with pytest.raises(FilterError, match=r"stands for another set|another size"):
        compare_sets(replace(automaton, successors=wrong), np.arange(len(automaton.graph), dtype=np.int32))
