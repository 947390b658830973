import numpy as np
import pytest

from ial.contractors import Boxes, Relaxed, relaxed_intersection
from ial.contractors.boxes import FloatArray


class Fixed:
    """Narrows to one fixed box, or empties."""

    def __init__(self, lower: FloatArray, upper: FloatArray) -> None:
        self.lower, self.upper = lower, upper
        self.dimension = len(lower)

    def contract(self, boxes: Boxes) -> Boxes:
        lower, upper = np.maximum(boxes.lower, self.lower), np.minimum(boxes.upper, self.upper)
        empty = ~(lower <= upper).all(axis=1, keepdims=True)
        return Boxes(np.where(empty, np.inf, lower), np.where(empty, -np.inf, upper))


def random_bounds(rows: int, count: int, dimension: int, seed: int) -> tuple[FloatArray, FloatArray]:
    """Return boxes on a coarse lattice, so that bounds often coincide; some are points, some empty."""
    rng = np.random.default_rng(seed)
    bounds = np.sort(rng.integers(0, 8, size=(2, rows, count, dimension)), axis=0).astype(np.float64)
    empty = rng.random((rows, count, 1)) < 0.15
    return np.where(empty, np.inf, bounds[0]), np.where(empty, -np.inf, bounds[1])


def brute_force(lower: FloatArray, upper: FloatArray, outliers: int) -> list[tuple[float, float]]:
    """The slow, obvious twin for one row: try every bound of an axis as a point of the answer."""
    answer = []
    valid = [j for j in range(len(lower)) if (lower[j] <= upper[j]).all()]
    for axis in range(lower.shape[1]):
        tried = {bound[j, axis] for j in valid for bound in (lower, upper)}
        points = [p for p in tried if sum(lower[j, axis] <= p <= upper[j, axis] for j in valid) >= len(lower) - outliers]
        if not points:
            return [(np.inf, -np.inf)] * lower.shape[1]
        answer.append((min(points), max(points)))
    return answer


@pytest.mark.parametrize(("count", "dimension"), [(1, 1), (2, 1), (5, 2), (7, 3), (12, 2)])
def test_each_axis_is_what_brute_force_finds(count: int, dimension: int) -> None:
    lower, upper = random_bounds(150, count, dimension, seed=count)
    for outliers in range(count):
        found = relaxed_intersection(lower, upper, outliers)
        for row in range(len(lower)):
            expected = brute_force(lower[row], upper[row], outliers)
            assert list(zip(found.lower[row], found.upper[row], strict=True)) == expected


def test_a_point_of_enough_boxes_is_never_lost() -> None:
    rng = np.random.default_rng(8)
    lower, upper = random_bounds(400, 9, 3, seed=9)
    points = rng.integers(0, 8, size=(400, 3)).astype(np.float64)
    inside = ((lower <= points[:, None]) & (points[:, None] <= upper)).all(axis=2).sum(axis=1)
    for outliers in range(9):
        found = relaxed_intersection(lower, upper, outliers)
        enough = inside >= 9 - outliers
        assert ((found.lower <= points) & (points <= found.upper)).all(axis=1)[enough].all()


def test_intervals_that_only_touch_meet() -> None:
    touching = np.array([[[0.0], [1.0]]]), np.array([[[1.0], [2.0]]])
    assert relaxed_intersection(*touching, 0).lower.tolist() == [[1.0]]
    assert relaxed_intersection(*touching, 0).upper.tolist() == [[1.0]]


def test_a_box_empty_in_one_dimension_counts_as_failed() -> None:
    lower, upper = np.array([[[5.0, np.inf], [0.0, 0.0]]]), np.array([[[6.0, -np.inf], [1.0, 1.0]]])
    assert relaxed_intersection(lower, upper, 0).empty.tolist() == [True]
    assert relaxed_intersection(lower, upper, 1).upper.tolist() == [[1.0, 1.0]]


def test_as_many_outliers_as_boxes_require_nothing() -> None:
    lower, upper = random_bounds(3, 4, 2, seed=1)
    for outliers in (4, 5):
        assert np.isneginf(relaxed_intersection(lower, upper, outliers).lower).all()
        contractors = [Fixed(lower[0, j], upper[0, j]) for j in range(4)]
        boxes = Boxes.of([(0, 3), (-1, 5)])
        same = Relaxed(*contractors, outliers=outliers).contract(boxes)
        assert (same.lower == boxes.lower).all()
        assert (same.upper == boxes.upper).all()


def test_the_contractor_relaxes_what_its_parts_leave() -> None:
    lower, upper = random_bounds(1, 6, 2, seed=3)
    boxes = Boxes.of([(1, 6), (0, 7)], [(2.5, 2.5), (3.0, 4.0)], [(20, 30), (20, 30)])
    for outliers in range(6):
        found = Relaxed(*(Fixed(lower[0, j], upper[0, j]) for j in range(6)), outliers=outliers).contract(boxes)
        for row in range(3):
            parts = [Fixed(lower[0, j], upper[0, j]).contract(boxes[row : row + 1]) for j in range(6)]
            stacked = np.concatenate([part.lower for part in parts]), np.concatenate([part.upper for part in parts])
            assert list(zip(found.lower[row], found.upper[row], strict=True)) == brute_force(*stacked, outliers)


def test_bad_arguments_are_refused() -> None:
    lower, upper = random_bounds(2, 3, 2, seed=4)
    with pytest.raises(ValueError, match="at least 0"):
        relaxed_intersection(lower, upper, -1)
    with pytest.raises(ValueError, match=r"must be \(n, m, d\)"):
        relaxed_intersection(lower, upper[:, :2], 1)
    with pytest.raises(ValueError, match="at least 0"):
        Relaxed(Fixed(lower[0, 0], upper[0, 0]), outliers=-1)
