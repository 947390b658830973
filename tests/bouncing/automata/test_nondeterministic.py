from ial.bouncing.automata.nondeterministic import NondeterministicAutomaton
from ial.bouncing.cells.groups import periodic_groups
from tests.bouncing.worlds import cell_map, random_mask, twin_information_states


def test_the_nondeterministic_automaton_reaches_what_the_deterministic_one_stands_for() -> None:
    graph = cell_map(random_mask(4)).graph
    nondeterministic, (arcs, sets) = NondeterministicAutomaton.of(graph), twin_information_states(graph)
    assert len(nondeterministic) == len(graph) + 1
    for word in ("", "0", "1", "0010001", "1101", "0001000100010001"):
        state: int | None = 0
        for letter in word:
            state = None if state is None else arcs[state][int(letter)]
        expected = sets[state] if state is not None else frozenset()
        assert set(nondeterministic.reach(word)) == {v + 1 for v in expected}
    transitions = list(nondeterministic.transitions())
    assert len(transitions) == 2 * len(graph)
    assert transitions[0] == (0, "", 1)
    letters = [(start, read) for start, read, _ in transitions if read]
    assert letters == [(v + 1, "1" if label else "0") for v, label in enumerate(graph.labels)]
    assert nondeterministic.final.sum() == (periodic_groups(graph).step == 0).sum()
