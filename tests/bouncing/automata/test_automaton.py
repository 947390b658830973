import numpy as np
import pytest

from ial.bouncing.automata.automaton import Automaton
from ial.bouncing.automata.determinization import determinize
from ial.bouncing.cells.groups import periodic_groups
from ial.errors import FilterError
from tests.bouncing.worlds import cell_map, drawn, observations, twin_information_states, worlds

WORLDS = list(worlds(24))


@pytest.fixture(scope="module")
def automata() -> list[Automaton]:
    return [determinize(made.graph, verify=True) for made in WORLDS]


@pytest.mark.parametrize("index", range(len(WORLDS)))
def test_the_automaton_is_that_of_brute_force(index: int, automata: list[Automaton]) -> None:
    automaton = automata[index]
    arcs, sets = twin_information_states(WORLDS[index].graph)
    assert [tuple(None if to < 0 else to for to in row) for row in automaton.successors.tolist()] == arcs
    assert automaton.sizes.tolist() == [len(held) for held in sets]
    weights = WORLDS[index].graph.weights
    ones = np.ones(len(WORLDS[index].graph), dtype=np.int32) if weights is None else weights
    assert automaton.uncertainty.tolist() == [int(ones[list(held)].sum()) for held in sets]
    for state in np.flatnonzero(automaton.colours > 1).tolist():
        assert set(automaton.cells(state).tolist()) == sets[state]


@pytest.mark.parametrize("index", range(len(WORLDS)))
def test_the_truth_is_in_every_set_from_every_start_until_a_cycle(index: int, automata: list[Automaton]) -> None:
    automaton, graph = automata[index], WORLDS[index].graph
    _, sets = twin_information_states(graph)
    latest = 0
    for start in range(len(graph)):
        stream, passed = observations(graph, start, automaton.depth + 5)
        state, reached = 0, None
        for step, (letter, truth) in enumerate(zip(stream, passed[1:], strict=True), 1):
            if automaton.colours[state] > 1 and reached is None:
                reached = step - 1
            state = int(automaton.successors[state, letter])
            assert truth in sets[state]
        assert reached is not None
        assert reached <= automaton.depth
        latest = max(latest, reached)
    assert latest == automaton.depth, "and some start needs as long"


@pytest.mark.parametrize("index", range(len(WORLDS)))
def test_the_lemma_of_knowledge_cycles(index: int, automata: list[Automaton]) -> None:
    automaton, groups = automata[index], periodic_groups(WORLDS[index].graph)
    on_cycle = np.flatnonzero(automaton.colours > 1)
    assert ((automaton.successors[on_cycle] >= 0).sum(axis=1) == 1).all(), "one way on, and it stays on the cycle"
    targets = automaton.successors[on_cycle].max(axis=1)
    assert (automaton.colours[targets] == automaton.colours[on_cycle]).all()
    assert automaton.cycles.lengths.sum() == len(on_cycle)
    for cycle, anchor in enumerate(automaton.cycles.anchors.tolist()):
        members = automaton.colours == cycle + 2
        assert set(automaton.uncertainty[members].tolist()) == {automaton.cycles.uncertainty[cycle]}
        assert (groups.step[automaton.cells(anchor)] == 0).all(), "all its vertices are periodic"
    assert automaton.cycles.lengths.max() <= (groups.step == 0).sum()
    rest = np.flatnonzero(automaton.colours == 1)
    depth_first = {int(state) for state in rest}
    for _ in range(automaton.depth + 1):  # outside of the cycles there is none: states without successors can be taken away for ever
        depth_first = {state for state in depth_first if any(int(to) in depth_first for to in automaton.successors[state])}
    assert depth_first == set()


def test_only_the_sets_of_cycles_are_kept() -> None:
    automaton = determinize(cell_map(drawn("... .#. ...")).graph)
    with pytest.raises(FilterError, match="state 0 is on no knowledge cycle"):
        automaton.cells(0)
