import random
from fractions import Fraction

import pytest

from ial.bouncing.automata.set_automaton import determinize_sets
from ial.bouncing.cells.headings import Headings
from ial.bouncing.cells.noisy_map import NoisyMap
from ial.bouncing.cells.noisy_model import NoisyModel
from ial.errors import FilterError
from tests.bouncing.rays.test_real_robot import ROOM


def test_the_automaton_is_that_of_the_filter_and_its_size_is_limited() -> None:
    made = NoisyMap(ROOM, Fraction(1, 2), Headings.of_angle(Fraction(90), 12, Fraction(3)))
    automaton, model = determinize_sets(made.graph), NoisyModel(made.graph)
    chooser = random.Random(2)
    for _ in range(20):
        state, states = 0, model.universe()
        for _ in range(20):
            label = chooser.randrange(2)
            state, states = int(automaton.successors[state, label]), model.step(states, None, label)
            assert (state < 0) == model.empty(states)
            if state < 0:
                break
            assert automaton.sizes[state] == len(states)
    with pytest.raises(FilterError, match="more than 3 states"):
        determinize_sets(made.graph, 3)
