import numpy as np
import pytest

from ial.contractors.geometry.box_tree import BoxTree, along_curve, following


@pytest.mark.parametrize("leaves", [1, 2, 8, 64])
def test_a_walk_that_never_skips_visits_every_node_once(leaves: int) -> None:
    visited, node = [], 1
    while True:
        visited.append(node)
        node = 2 * node if node < leaves else following(node)
        if node == 1:
            break
    assert sorted(visited) == list(range(1, 2 * leaves))


def test_following_skips_all_that_is_below() -> None:
    assert [following(node) for node in (1, 2, 3, 4, 5, 6, 7)] == [1, 3, 1, 5, 3, 7, 1]


@pytest.mark.parametrize("count", [1, 2, 3, 100, 128, 129])
@pytest.mark.parametrize("dimension", [1, 2, 3, 31])
def test_each_node_is_the_hull_of_the_boxes_below_it(count: int, dimension: int) -> None:
    lower = np.random.default_rng(count).normal(size=(count, dimension))
    upper = lower + 0.5
    tree = BoxTree(lower, upper)
    assert sorted(tree.order.tolist()) == list(range(count))
    assert tree.leaves >= count > tree.leaves // 2
    for node in range(1, 2 * tree.leaves):
        first, last = node, node
        while first < tree.leaves:
            first, last = 2 * first, 2 * last + 1
        below = tree.order[first - tree.leaves : last + 1 - tree.leaves]
        assert (tree.lower[node] == lower[below].min(axis=0, initial=np.inf)).all()
        assert (tree.upper[node] == upper[below].max(axis=0, initial=-np.inf)).all()


def test_near_points_are_near_along_the_curve() -> None:
    points = np.stack(np.meshgrid(np.arange(64.0), np.arange(64.0)), axis=-1).reshape(-1, 2)
    steps = np.abs(np.diff(points[along_curve(points)], axis=0)).sum(axis=1)
    assert steps.mean() < 2.0  # row by row, it would be 2.0 as well as long as a row; at random, 42
    assert np.median(steps) == 1.0


def test_places_of_any_size_can_be_ordered() -> None:
    largest = np.finfo(np.float64).max
    assert along_curve(np.array([[largest], [-largest], [0.0]])).tolist() == [1, 2, 0]
    assert along_curve(np.array([[5.0, 5.0], [5.0, 5.0]])).tolist() == [0, 1]
