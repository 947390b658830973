import numpy as np
import pytest

from ial.contractors import Boxes, relaxed, relaxed_intersection
from ial.contractors.boxes import FloatArray
from ial.contractors.combinators import relaxation
from tests.contractors.shapes import Inside, Outside, Points, Several, inside, is_well_formed, lattice, random_boxes, same, separator


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
        enclosure = relaxed_intersection(lower, upper, outliers)
        for row in range(len(lower)):
            expected = brute_force(lower[row], upper[row], outliers)
            assert list(zip(enclosure.lower[row], enclosure.upper[row], strict=True)) == expected


def test_a_point_of_enough_boxes_is_never_lost() -> None:
    rng = np.random.default_rng(8)
    lower, upper = random_bounds(400, 9, 3, seed=9)
    points = rng.integers(0, 8, size=(400, 3)).astype(np.float64)
    inside = ((lower <= points[:, None]) & (points[:, None] <= upper)).all(axis=2).sum(axis=1)
    for outliers in range(9):
        enclosure = relaxed_intersection(lower, upper, outliers)
        enough = inside >= 9 - outliers
        assert ((enclosure.lower <= points) & (points <= enclosure.upper)).all(axis=1)[enough].all()


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
    boxes = random_boxes(50, 2, seed=2)
    for outliers in (4, 5):
        assert np.isneginf(relaxed_intersection(lower, upper, outliers).lower).all()
        assert same(relaxed(Several(lower[0], upper[0]), outliers).contract(boxes), boxes)


@pytest.mark.parametrize("dimension", [1, 2, 3])
@pytest.mark.parametrize("exact", [False, True])
def test_the_contractor_relaxes_what_its_parts_leave(dimension: int, exact: bool) -> None:
    lower, upper = random_bounds(1, 6, dimension, seed=3)
    boxes = random_boxes(100, dimension, seed=4)
    family = Several(lower[0], upper[0])
    stacked = family.contract_each(boxes)
    for outliers in range(6):
        narrowed = relaxed(family.one_by_one(), outliers, exact=exact).contract(boxes)
        assert same(narrowed, relaxed_intersection(*stacked, outliers, exact=exact))
        assert is_well_formed(narrowed, boxes)


def test_no_point_that_enough_sets_hold_is_lost() -> None:
    boxes, points = random_boxes(300, 2, seed=5), lattice(2)
    rng = np.random.default_rng(6)
    chosen = [rng.random(len(points)) < 0.4 for _ in range(6)]
    sets = [Points(points[mask]) for mask in chosen]
    for outliers in range(6):
        for exact in (False, True):
            narrowed = relaxed(sets, outliers, exact=exact).contract(boxes)
            wanted = inside(boxes, points) & (np.sum(chosen, axis=0) >= 6 - outliers)
            assert inside(narrowed, points)[wanted].all()


def test_a_large_batch_of_a_family_is_divided(monkeypatch: pytest.MonkeyPatch) -> None:
    lower, upper = random_bounds(1, 5, 2, seed=7)
    boxes = random_boxes(1000, 2, seed=8)
    whole = relaxed(Several(lower[0], upper[0]), 2).contract(boxes)
    monkeypatch.setattr(relaxation, "_NUMBERS", 1003)
    family = Several(lower[0], upper[0])
    assert same(relaxed(family, 2).contract(boxes), whole)
    assert family.largest_batch == 100
    assert len(relaxed(family, 2).contract(Boxes.none(2))) == 0


def test_a_row_that_has_failed_too_often_is_not_passed_on() -> None:
    class Watched(Inside):
        rows = 0

        def contract(self, boxes: Boxes) -> Boxes:
            self.rows += len(boxes)
            return super().contract(boxes)

    parts = [Watched((0, 1)), Watched((4, 5)), Watched((8, 9)), Watched((0, 9))]
    boxes = Boxes.of([(0, 9)], [(0.5, 0.7)], [(7, 9)])
    assert relaxed(parts, 1).contract(boxes).empty.all()
    assert [part.rows for part in parts] == [3, 3, 2, 1]
    assert relaxed(parts, 0).contract(boxes[1:]).empty.all()
    assert [part.rows for part in parts] == [5, 4, 2, 1]


def test_the_complement_of_a_relaxed_intersection() -> None:
    shapes = [Inside((0, 3), (0, 3)), Inside((1, 4), (1, 6)), Inside((2, 5), (0, 4))]
    for shape in shapes:
        shape.complement = lambda shape=shape: Outside(*shape.sides)  # type: ignore[attr-defined]
    points = lattice(2)
    boxes = Boxes(points, points)
    failing = np.sum([shape.holds(points) for shape in shapes], axis=0)
    outside = np.sum([Outside(*shape.sides).holds(points) for shape in shapes], axis=0)
    for outliers in range(4):
        contractor = relaxed(shapes, outliers)
        assert (~contractor.contract(boxes).empty == (failing >= 3 - outliers)).all()
        assert (~(~contractor).contract(boxes).empty == (outside >= outliers + 1)).all()


def test_bad_arguments_are_refused() -> None:
    lower, upper = random_bounds(2, 3, 2, seed=4)
    a_box = Inside((0, 1), (0, 1))
    with pytest.raises(ValueError, match="at least 0"):
        relaxed_intersection(lower, upper, -1)
    with pytest.raises(ValueError, match=r"must be \(n, m, d\)"):
        relaxed_intersection(lower, upper[:, :2], 1)
    with pytest.raises(ValueError, match="at least 0"):
        relaxed([a_box], outliers=-1)
    with pytest.raises(ValueError, match="at least 0"):
        relaxed([separator((0, 1))], outliers=-1)
    with pytest.raises(TypeError, match="integer"):
        relaxed([a_box], outliers=0.5)  # type: ignore[call-overload]
    with pytest.raises(ValueError, match=r"dimensions \[1, 2\]"):
        relaxed([a_box, Inside((0, 1))], outliers=1)
    with pytest.raises(ValueError, match="at least one contractor"):
        relaxed([], outliers=1)
    with pytest.raises(ValueError, match="needs 2"):
        relaxed([a_box], outliers=0).contract(Boxes.of([(0, 1)]))

    class Wrong(Several):
        def contract_each(self, boxes: Boxes) -> tuple[FloatArray, FloatArray]:
            lower, upper = super().contract_each(boxes)
            return lower[:, 1:], upper[:, 1:]

    with pytest.raises(ValueError, match=r"Wrong.contract_each returned shapes \(1, 2, 2\) .* must be \(1, 3, 2\)"):
        relaxed(Wrong(lower[0], upper[0]), 1).contract(Boxes.of([(0, 1), (0, 1)]))
