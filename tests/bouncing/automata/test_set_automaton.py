import random
from fractions import Fraction

import numpy as np
import pytest

from ial.bouncing.automata.set_automaton import SetAutomaton, determinize_sets
from ial.bouncing.cells.headings import Headings
from ial.bouncing.cells.noisy_map import NoisyMap
from ial.bouncing.cells.noisy_model import NoisyModel
from ial.errors import FilterError
from tests.bouncing.rays.test_real_robot import ROOM

MADE = NoisyMap(ROOM, Fraction(1, 2), Headings.of_angle(Fraction(90), 12, Fraction(3)))


def walks(automaton: SetAutomaton, growth: Fraction) -> int:
    """Compare the states with the sets of the filter along random streams; return how many sets are larger."""
    model, chooser, larger = NoisyModel(MADE.graph), random.Random(2), 0
    for _ in range(60):
        state, states = 0, model.universe()
        for _ in range(30):
            label = chooser.randrange(2)
            state, states = int(automaton.successors[state, label]), model.step(states, None, label)
            if model.empty(states):
                assert growth > 0 or state < 0
                break
            assert state >= 0
            held = automaton.members[automaton.starts[state] : automaton.starts[state + 1]]
            assert np.isin(states, held).all()
            assert automaton.sizes[state] == len(held)
            assert automaton.colours[state] == 2
            larger += len(held) > len(states)
    return larger


def test_the_automaton_is_that_of_the_filter() -> None:
    automaton = determinize_sets(MADE.graph, colour_of=lambda vertices: 2)
    assert walks(automaton, Fraction(0)) == 0
    assert (automaton.parts == 1).all()
    with pytest.raises(FilterError, match="more than 3 states"):
        determinize_sets(MADE.graph, 3)


@pytest.mark.many
def test_a_larger_set_may_stand_for_another_one() -> None:
    sizes = []
    for growth in map(Fraction, ("0", "1/4", "1", "3")):
        automaton = determinize_sets(MADE.graph, colour_of=lambda vertices: 2, growth=growth)
        sizes.append(len(automaton))
        assert (walks(automaton, growth) > 0) == (growth > 0)
    assert sizes == sorted(sizes, reverse=True)
    assert sizes[-1] < sizes[0] / 4


def test_only_sets_of_states_with_a_colour_are_kept_and_parts_are_told() -> None:
    middle = len(MADE.graph) // 2
    part_of = (np.arange(len(MADE.graph)) >= middle).astype(np.uint8)
    automaton = determinize_sets(MADE.graph, colour_of=lambda vertices: 1 + (len(vertices) < 40), part_of=part_of)
    counts = np.diff(automaton.starts)
    assert ((automaton.colours == 2) == (automaton.sizes < 40)).all()
    assert np.array_equal(counts > 0, automaton.colours == 2)
    for state in np.flatnonzero(counts):
        held = automaton.members[automaton.starts[state] : automaton.starts[state + 1]]
        assert automaton.parts[state] == (held < middle).any() + 2 * (held >= middle).any()
