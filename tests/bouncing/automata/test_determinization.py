import math

import numpy as np
import pytest

from ial.bouncing.automata import determinization
from ial.bouncing.automata.determinization import TooManyStatesError, determinize
from ial.bouncing.cells.graph import LabelledGraph, disjoint_union
from ial.errors import FilterError
from tests.bouncing.worlds import cell_map, drawn, random_mask, twin_information_states


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


@pytest.mark.slow
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


def test_a_robot_that_only_turns_is_in_a_cycle_at_once() -> None:
    automaton = determinize(cell_map(drawn(".")).graph)
    assert (len(automaton), automaton.depth, automaton.successors.tolist()) == (1, 0, [[-1, 0]])
    assert automaton.cycles.uncertainty.tolist() == [4]


@pytest.mark.parametrize("seed", range(5))
def test_a_construction_that_pauses_at_every_level_is_the_same(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    graph = cell_map(random_mask(seed, 9, 11), 135, 8).graph
    whole = determinize(graph)
    told: list[int] = []
    monkeypatch.setattr(determinization, "_VISITS", 1)
    paused = determinize(graph, verify=True, progress=told.append)
    assert len(told) > 5
    assert told == sorted(told)
    assert told[-1] == len(whole)
    for name in ("successors", "sizes", "uncertainty", "environments", "colours"):
        assert (getattr(paused, name) == getattr(whole, name)).all()
    for name in ("anchors", "lengths", "starts", "members"):
        assert (getattr(paused.cycles, name) == getattr(whole.cycles, name)).all()
    assert paused.depth == whole.depth


def test_the_number_of_states_that_is_given_up_at_is_true() -> None:
    graph = cell_map(random_mask(3, 9, 11), 135, 8).graph
    states = len(determinize(graph))
    assert len(determinize(graph, most_states=states)) == states
    for most in (1, 2, states // 2, states - 1):
        with pytest.raises(TooManyStatesError, match=rf"more than {most} states; .* or allow more states; ial bounce advise") as caught:
            determinize(graph, most_states=most)
        assert caught.value.states == most
    assert len(determinize(graph, most_states=2**40)) == states


def test_the_work_may_be_limited(monkeypatch: pytest.MonkeyPatch) -> None:
    graph = cell_map(random_mask(3, 9, 11), 135, 8).graph
    states = len(determinize(graph))
    monkeypatch.setattr(determinization, "_VISITS", 100)
    seen = []
    for visits in (1, len(graph) + 1, 2 * len(graph)):
        with pytest.raises(TooManyStatesError, match="the work that was allowed for it is done") as caught:
            determinize(graph, most_visits=visits)
        assert caught.value.states < states
        seen.append(caught.value.states)
    assert 1 <= seen[0] <= seen[1] < seen[2]
    assert len(determinize(graph, most_visits=10**9)) == states
