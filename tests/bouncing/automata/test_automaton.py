import math
from dataclasses import replace

import numpy as np
import pytest

from ial.bouncing.automata.automaton import Automaton
from ial.bouncing.automata.determinization import determinize
from ial.bouncing.automata.nondeterministic import NondeterministicAutomaton
from ial.bouncing.automata.verification import compare_sets
from ial.bouncing.cells.graph import LabelledGraph, disjoint_union
from ial.bouncing.cells.groups import periodic_groups
from ial.errors import FilterError
from tests.bouncing.worlds import cell_map, drawn, observations, random_mask, twin_information_states, worlds

WORLDS = list(worlds(24))


@pytest.fixture(scope="module")
def automata() -> list[Automaton]:
    return [determinize(made.graph, verify=True) for made in WORLDS]


def cycles_of_length(lengths: list[int]) -> LabelledGraph:
    """Cycles along which labels repeat 01."""
    base = np.concatenate([np.arange(length) for length in lengths])
    starts = np.repeat(np.cumsum([0, *lengths[:-1]]), lengths)
    return LabelledGraph.of(starts + (base + 1) % np.repeat(lengths, lengths), base % 2)


def lcm_graph() -> LabelledGraph:
    """Five cycles of 2·3 … 2·13 vertices, and two lead-in vertices to each that give every cycle one known place."""
    lengths = [2 * prime for prime in (3, 5, 7, 11, 13)]
    graph = cycles_of_length(lengths)
    successors, labels = graph.successors.tolist(), graph.labels.tolist()
    for start in np.cumsum([0, *lengths[:-1]]).tolist():
        # 11 is seen nowhere on the cycles: whoever emits it is known to enter its cycle at the first vertex.
        successors += [len(successors) + 1, start]
        labels += [True, True]
    return LabelledGraph.of(successors, labels)


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


@pytest.mark.many
def test_the_lcm_counterexample_to_proposition_1_hits_the_cap_cleanly() -> None:
    graph = lcm_graph()
    with pytest.raises(FilterError, match="more than 7744 states; use larger cells"):
        determinize(graph, most_states=len(graph) ** 2)
    automaton = determinize(graph, verify=True)
    assert len(automaton) > len(graph) ** 2
    assert automaton.cycles.lengths.max() == math.lcm(6, 10, 14, 22, 26) == 30_030


def test_a_rotated_map_has_the_same_automaton() -> None:
    for seed, angle, headings in ((1, 90, 4), (2, 45, 8), (3, 90, 12)):
        free = random_mask(seed, 9, 6)
        one, other = (determinize(cell_map(mask, angle, headings).graph) for mask in (free, np.rot90(free)))
        # States are numbered breadth first, so automata that are alike up to their names are equal.
        assert np.array_equal(one.successors, other.successors)
        assert np.array_equal(one.uncertainty, other.uncertainty)
        mirrored = determinize(cell_map(free[:, ::-1], angle, headings).graph)
        assert not np.array_equal(one.successors, mirrored.successors), "a mirrored one turns the other way"


def test_merged_headings_keep_states_and_uncertainties() -> None:
    free = random_mask(5)
    whole, merged = (determinize(cell_map(free, 90, 24, merge=merge).graph) for merge in (False, True))
    assert len(merged.graph) < len(whole.graph)
    assert np.array_equal(whole.successors, merged.successors)
    assert np.array_equal(whole.uncertainty, merged.uncertainty)
    assert np.array_equal(whole.cycles.uncertainty, merged.cycles.uncertainty)
    assert merged.cycles.uncertainty.min() == 3


def test_environments_of_a_union_are_those_whose_cells_are_held() -> None:
    graphs = [cell_map(random_mask(seed)).graph for seed in range(3)]
    union = determinize(disjoint_union(graphs), verify=True)
    _, sets = twin_information_states(union.graph)
    for state, held in enumerate(sets):
        assert {i for i in range(3) if int(union.environments[state]) >> i & 1} == set(union.graph.part_of(sorted(held)).tolist())


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


def test_a_wrong_arc_does_not_pass_verification() -> None:
    automaton = determinize(cell_map(random_mask(6)).graph)
    wrong = automaton.successors.copy()
    state = int(np.flatnonzero((wrong >= 0).all(axis=1))[3])
    wrong[state] = wrong[state, ::-1]
    with pytest.raises(FilterError, match=r"stands for another set|another size"):
        compare_sets(replace(automaton, successors=wrong))


def test_only_the_sets_of_cycles_are_kept() -> None:
    automaton = determinize(cell_map(drawn("... .#. ...")).graph)
    with pytest.raises(FilterError, match="state 0 is on no knowledge cycle"):
        automaton.cells(0)


def test_a_robot_that_only_turns_is_in_a_cycle_at_once() -> None:
    automaton = determinize(cell_map(drawn(".")).graph)
    assert (len(automaton), automaton.depth, automaton.successors.tolist()) == (1, 0, [[-1, 0]])
    assert automaton.cycles.uncertainty.tolist() == [4]
