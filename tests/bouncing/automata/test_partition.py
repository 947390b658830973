import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.bouncing.automata.determinization import determinize
from ial.bouncing.automata.minimal import minimize
from ial.bouncing.automata.partition import coarsest_partition
from ial.bouncing.automata.table import FilterTable
from ial.bouncing.cells.graph import LabelledGraph
from ial.bouncing.planning.trace_classes import trace_classes, trace_quotient
from tests.bouncing.worlds import cell_map, observations, random_mask, worlds


def twin(successors: list[list[int]], initial: list[int]) -> list[int]:
    """Moore's rounds: split by the blocks of successors until nothing changes."""
    blocks, count = list(initial), 0
    while len(set(blocks)) != count:
        count = len(set(blocks))
        signatures = [(block, *(blocks[to] for to in row)) for block, row in zip(blocks, successors, strict=True)]
        names: dict[tuple[int, ...], int] = {}
        blocks = [names.setdefault(each, len(names)) for each in signatures]
    return blocks


@given(st.data())
def test_the_partition_is_that_of_moore(data: st.DataObject) -> None:
    count, letters = data.draw(st.integers(1, 14)), data.draw(st.integers(1, 3))
    row = st.lists(st.integers(0, count - 1), min_size=letters, max_size=letters)
    successors = data.draw(st.lists(row, min_size=count, max_size=count))
    initial = data.draw(st.lists(st.integers(0, 2), min_size=count, max_size=count))
    blocks = coarsest_partition(np.array(successors, dtype=np.int32), np.array(initial, dtype=np.int32))
    assert blocks.tolist() == twin(successors, initial)  # both number blocks by their first states


@pytest.mark.parametrize("made", list(worlds(6)))
def test_minimal_filters_answer_like_the_whole_one(made) -> None:  # type: ignore[no-untyped-def]
    table = FilterTable.of(determinize(made.graph))
    by_colour, by_end = minimize(table), minimize(table, "localized")
    assert len(by_end) <= len(by_colour) <= len(table)
    assert len(by_colour) == len(set(twin(table.successors.tolist(), table.colours.tolist())))
    chooser = np.random.default_rng(0)
    streams = [chooser.integers(0, 2, 60).tolist() for _ in range(20)]
    streams += [observations(made.graph, start, 80)[0] for start in range(0, len(made.graph), 7)]
    for stream in streams:
        whole, small, end = (each.run(stream) for each in (table, by_colour, by_end))
        assert by_colour.colours[small].tolist() == table.colours[whole].tolist()
        assert [by_end.is_localized(state) for state in end] == [table.is_localized(state) for state in whole]
        assert [state == by_end.trap for state in end] == [state == table.trap for state in whole]
        assert (by_colour.uncertainty[small] >= table.uncertainty[whole]).all()
        on_cycle = table.colours[whole] > 1
        assert np.array_equal(by_colour.uncertainty[small][on_cycle], table.uncertainty[whole][on_cycle])


def test_trace_classes_are_those_of_equal_observations() -> None:
    graph = cell_map(random_mask(2, 5, 5), 90, 8).graph
    traces = [tuple(observations(graph, vertex, 2 * len(graph))[0]) for vertex in range(len(graph))]
    names: dict[tuple[int, ...], int] = {}
    assert trace_classes(graph).tolist() == [names.setdefault(trace, len(names)) for trace in traces]


def test_the_quotient_accepts_the_same_streams() -> None:
    graph = cell_map(random_mask(2, 6, 6), 90, 24).graph
    quotient, classes = trace_quotient(graph)
    assert isinstance(quotient, LabelledGraph)
    assert len(quotient) < len(graph)
    whole, small = FilterTable.of(determinize(graph)), FilterTable.of(determinize(quotient))
    assert len(small) <= len(whole)
    assert (minimize(whole, "localized").successors == minimize(small, "localized").successors).all()
    assert quotient.labels[classes].tolist() == graph.labels.tolist()
