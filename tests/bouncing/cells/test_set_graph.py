from fractions import Fraction

import numpy as np
import pytest

from ial.bouncing.cells.headings import Headings
from ial.bouncing.cells.noisy_map import NoisyMap
from ial.bouncing.cells.noisy_model import NoisyModel
from ial.bouncing.cells.set_graph import SetGraph, disjoint_set_union, rows_of
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.errors import FilterError
from tests.bouncing.rays.test_real_robot import PILLAR, ROOM


def test_rows_are_sorted_and_hold_each_arc_once() -> None:
    starts, ends = rows_of(np.array([2, 0, 2, 2]), np.array([1, 2, 1, 0]), 3)
    assert starts.tolist() == [0, 1, 1, 3]
    assert ends.tolist() == [2, 0, 1]
    with pytest.raises(FilterError, match="leads to vertex 2"):
        SetGraph((starts[:3], starts[:3]), (ends, ends), 2)


@pytest.mark.parametrize("count", [0, 2])
def test_a_union_runs_the_filters_of_several_environments_side_by_side(count: int) -> None:
    headings, bounds = Headings.of_angle(Fraction(90), 8, Fraction(2)), ExecutionBounds(Fraction(5), count=count)
    maps = [NoisyMap(each, Fraction(1), headings, bounds) for each in (ROOM, PILLAR, ROOM)]
    graphs = [each.graph for each in maps]
    union, place_of = disjoint_set_union(graphs)
    assert union.first == sum(graph.first for graph in graphs)
    assert len(union) == sum(map(len, graphs)) == len(place_of)
    assert union.arcs == sum(graph.arcs for graph in graphs)
    bases = np.cumsum([0, *(graph.first for graph in graphs)])
    model, models = NoisyModel(union), [NoisyModel(graph) for graph in graphs]
    chooser = np.random.default_rng(0)
    for _ in range(20):
        states, each_states = model.universe(), [each.universe() for each in models]
        for label in chooser.integers(0, 2, 15).tolist():
            states = model.step(states, None, label)
            each_states = [each.step(held, None, label) for each, held in zip(models, each_states, strict=True)]
            expected = [np.unique(held % graph.first) + base for held, graph, base in zip(each_states, graphs, bases, strict=False)]
            assert np.unique(place_of[states]).tolist() == np.concatenate(expected).tolist()
            assert len(states) == sum(map(len, each_states))


def test_a_union_of_nothing_is_refused() -> None:
    with pytest.raises(FilterError, match="no environment to be in"):
        disjoint_set_union([])
