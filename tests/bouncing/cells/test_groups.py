import numpy as np
import pytest

from ial.bouncing.cells.graph import LabelledGraph, disjoint_union
from ial.bouncing.cells.groups import periodic_groups
from ial.errors import FilterError
from tests.bouncing.worlds import cell_map, drawn, observations, worlds


def random_graph(seed: int, count: int = 40) -> LabelledGraph:
    chooser = np.random.default_rng(seed)
    return LabelledGraph.of(chooser.integers(0, count, count), chooser.integers(0, 2, count))


@pytest.mark.parametrize("graph", [*map(random_graph, range(6)), *(made.graph for made in worlds(6))])
def test_groups_and_steps_are_what_walking_shows(graph: LabelledGraph) -> None:
    groups = periodic_groups(graph)
    cycles = {}
    for vertex in range(len(graph)):
        _, passed = observations(graph, vertex, 2 * len(graph))
        cycle = frozenset(passed[len(graph) :])
        assert groups.step[vertex] == next(i for i, v in enumerate(passed) if v in cycle)
        assert cycles.setdefault(cycle, groups.group[vertex]) == groups.group[vertex]
    assert sorted(cycles.values()) == list(range(1, groups.count + 1))
    assert {number: len(cycle) for cycle, number in cycles.items()} == dict(enumerate(groups.periods.tolist(), 1))
    assert groups.basins.sum() == len(graph)
    assert groups.longest_transient == groups.step.max()


def test_a_robot_between_walls_turns_for_ever() -> None:
    groups = periodic_groups(cell_map(drawn("."), 90, 8).graph)
    assert groups.periods.tolist() == [4, 4]
    assert groups.bumping.all()
    assert not periodic_groups(cell_map(drawn("..."), 180, 4).graph).bumping.all()


@pytest.mark.many
def test_a_path_of_a_million_vertices_needs_no_recursion() -> None:
    count = 1_000_000
    groups = periodic_groups(LabelledGraph.of(np.maximum(np.arange(count) - 1, 0), np.zeros(count)))
    assert (groups.count, groups.longest_transient) == (1, count - 1)


def test_a_union_keeps_its_parts_apart() -> None:
    parts = [made.graph for made in worlds(4)]
    union = disjoint_union(parts)
    assert union.starts == tuple(np.cumsum([0, *map(len, parts)]).tolist())
    assert union.configurations == sum(part.configurations for part in parts)
    for index, part in enumerate(parts):
        mine = slice(union.starts[index], union.starts[index + 1])
        assert np.array_equal(union.successors[mine] - union.starts[index], part.successors)
        assert np.array_equal(union.labels[mine], part.labels)
        assert set(union.part_of(np.arange(mine.start, mine.stop))) == {index}
    assert disjoint_union([union, parts[0]]).starts[:-1] == (*union.starts[:-1], len(union))


def test_what_is_no_graph_is_refused() -> None:
    with pytest.raises(FilterError, match="no vertex"):
        LabelledGraph.of([], [])
    with pytest.raises(FilterError, match="leads to vertex 7, and there are 2"):
        LabelledGraph.of([0, 7], [0, 1])
    with pytest.raises(FilterError, match="65 environments"):
        disjoint_union([LabelledGraph.of([0], [0])] * 65)
