import itertools

import numpy as np
import pytest

from ial.contractors import Boxes, relaxed_intersection
from ial.contractors.boxes import FloatArray
from ial.contractors.combinators.exact_relaxation import require_affordable
from tests.contractors.shapes import Several, same


def random_bounds(rows: int, count: int, dimension: int, seed: int) -> tuple[FloatArray, FloatArray]:
    """Return boxes on a lattice; some are points, some empty in one dimension, some unbounded."""
    rng = np.random.default_rng(seed)
    lower, upper = np.sort(rng.integers(0, 10, size=(2, rows, count, dimension)), axis=0).astype(np.float64)
    lower[rng.random(lower.shape) < 0.03] = -np.inf
    upper[rng.random(upper.shape) < 0.03] = np.inf
    empty = rng.random((rows, count)) < 0.08
    lower[empty, 0], upper[empty, 0] = np.inf, -np.inf
    return lower, upper


def enumerated(lower: FloatArray, upper: FloatArray, outliers: int) -> Boxes:
    """The slow, obvious twin: the hull of the intersections of all choices of enough boxes."""
    rows, count, dimension = lower.shape
    hull_lower, hull_upper = np.full((rows, dimension), np.inf), np.full((rows, dimension), -np.inf)
    for choice in itertools.combinations(range(count), count - outliers):
        low, high = lower[:, choice].max(axis=1), upper[:, choice].min(axis=1)
        here = (low <= high).all(axis=1, keepdims=True)
        hull_lower = np.where(here, np.minimum(hull_lower, low), hull_lower)
        hull_upper = np.where(here, np.maximum(hull_upper, high), hull_upper)
    return Boxes(hull_lower, hull_upper)


@pytest.mark.slow
@pytest.mark.parametrize(("count", "dimension"), [(1, 2), (3, 2), (7, 1), (7, 2), (6, 3), (9, 3), (5, 4), (6, 5)])
def test_the_exact_hull_is_that_of_all_choices_of_enough_boxes(count: int, dimension: int) -> None:
    lower, upper = random_bounds(120, count, dimension, seed=count)
    for outliers in range(count):
        enclosure = relaxed_intersection(lower, upper, outliers, exact=True)
        assert same(enclosure, enumerated(lower, upper, outliers))
        by_axis = relaxed_intersection(lower, upper, outliers)
        assert (enclosure.empty | ((enclosure.lower >= by_axis.lower) & (enclosure.upper <= by_axis.upper)).all(axis=1)).all()


def test_boxes_that_overlap_on_each_axis_only_are_told_apart() -> None:
    # Two of three boxes share each axis, but no two share a point, save for the last pair.
    family = Several(np.array([[0.0, 0.0], [0.0, 5.0], [5.0, 0.0], [0.5, 0.0]]), np.array([[1.0, 1.0], [1.0, 6.0], [6.0, 1.0], [0.7, 0.2]]))
    lower, upper = family.contract_each(Boxes.of([(-9, 9), (-9, 9)]))
    assert relaxed_intersection(lower[:, :3], upper[:, :3], 1).empty.tolist() == [False]
    assert relaxed_intersection(lower[:, :3], upper[:, :3], 1, exact=True).empty.tolist() == [True]
    assert same(relaxed_intersection(lower, upper, 2, exact=True), Boxes.of([(0.5, 0.7), (0.0, 0.2)]))


def test_what_could_take_minutes_is_refused() -> None:
    for count, dimension in ((4096, 2), (223, 3), (53, 4), (13, 6)):
        require_affordable(count, dimension)
        with pytest.raises(ValueError, match=r"may take .* steps a row, above the limit .*; use exact=False"):
            require_affordable(count + 1, dimension)
    lower = np.zeros((1, 60, 4))
    with pytest.raises(ValueError, match="60 boxes in 4 dimensions"):
        relaxed_intersection(lower, lower, 1, exact=True)
    assert not relaxed_intersection(lower, lower, 0, exact=True).empty.any()
    assert not relaxed_intersection(lower, lower, 59, exact=True).empty.any()
