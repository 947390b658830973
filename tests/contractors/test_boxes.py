import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.contractors import Boxes

TWO = Boxes.of([(0, 1), (2, 4)], [(5, 7), (0, 1)])
EMPTY = (np.inf, -np.inf)


def test_rows_are_given_as_pairs_of_bounds() -> None:
    assert TWO.lower.tolist() == [[0, 2], [5, 0]]
    assert TWO.upper.tolist() == [[1, 4], [7, 1]]
    assert len(TWO) == TWO.dimension == 2


def test_shapes_that_do_not_fit_are_refused() -> None:
    with pytest.raises(ValueError, match=r"both must be \(n, d\)"):
        Boxes(np.zeros((2, 2)), np.zeros((2, 3)))
    with pytest.raises(ValueError, match=r"both must be \(n, d\)"):
        Boxes(np.zeros(2), np.zeros(2))


def test_bounds_become_contiguous_doubles() -> None:
    boxes = Boxes(np.zeros((3, 4), dtype=np.float32).T, np.ones((3, 4), dtype=np.int64).T)
    assert boxes.lower.dtype == boxes.upper.dtype == np.float64
    assert boxes.lower.flags.c_contiguous


def test_rows_are_selected() -> None:
    assert TWO[1:].lower.tolist() == [[5, 0]]
    assert TWO[np.array([True, False])].upper.tolist() == [[1, 4]]
    assert TWO[np.array([1, 0, 1])].lower.tolist() == [[5, 0], [0, 2], [5, 0]]


def test_width_and_volume() -> None:
    assert TWO.width().tolist() == [[1, 2], [2, 1]]
    assert TWO.volume() == 4.0
    assert Boxes.of([EMPTY, EMPTY], [(0, 2), (0, 3)]).volume() == 6.0
    assert Boxes.none(3).volume() == 0.0


def test_hull() -> None:
    hull = Boxes.concatenate([TWO, Boxes.of([EMPTY, EMPTY])]).hull()
    assert (hull.lower.tolist(), hull.upper.tolist()) == ([[0, 0]], [[7, 4]])
    assert Boxes.none(2).hull().empty.tolist() == [True]
    assert Boxes.of([EMPTY]).hull().empty.tolist() == [True]


def test_points_on_the_boundary_are_contained() -> None:
    assert TWO.contain([1.0, 4.0]).tolist() == [True, False]
    assert TWO.contain([5.0, 0.0]).tolist() == [False, True]
    assert TWO.contain([np.nan, 0.0]).tolist() == [False, False]


def test_halves_stay_side_by_side() -> None:
    halves = TWO.bisect(np.array([0, 1]))
    assert halves.lower.tolist() == [[0, 2], [0.5, 2], [5, 0], [5, 0.5]]
    assert halves.upper.tolist() == [[0.5, 4], [1, 4], [7, 0.5], [7, 1]]


BOUND = st.floats(-1e300, 1e300)


@given(st.lists(st.tuples(BOUND, BOUND, BOUND, BOUND), min_size=1, max_size=5), st.floats(0, 1), st.floats(0, 1))
def test_the_halves_of_a_bisection_cover_the_box(rows: list[tuple[float, float, float, float]], s: float, t: float) -> None:
    bounds = np.sort(np.array(rows).reshape(-1, 2, 2), axis=2)
    boxes = Boxes(bounds[:, :, 0], bounds[:, :, 1])
    halves = boxes.bisect(np.arange(len(boxes)) % 2)
    lower, upper = np.repeat(boxes.lower, 2, axis=0), np.repeat(boxes.upper, 2, axis=0)
    inside = np.clip(lower + np.array([s, t]) * (upper - lower), lower, upper)
    held = ((halves.lower <= inside) & (inside <= halves.upper)).all(axis=1)
    assert held.reshape(-1, 2).any(axis=1).all()
    assert (halves.lower >= lower).all()
    assert (halves.upper <= upper).all()
