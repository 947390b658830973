import numpy as np
import pytest

from ial.contractors import Boxes, fixpoint
from ial.contractors.combinators.fixed_point import FixedPoint
from tests.contractors.shapes import Inside, Outside, Points, lattice, random_boxes, same, sides


class Halving:
    """Removes the upper half of every bounded side, and a unit from the lower end of an unbounded one."""

    def __init__(self, dimension: int = 1) -> None:
        self.dimension = dimension
        self.rows: list[int] = []

    def contract(self, boxes: Boxes) -> Boxes:
        self.rows.append(len(boxes))
        bounded = np.isfinite(boxes.width())
        upper = np.where(bounded, boxes.lower + 0.5 * np.where(bounded, boxes.width(), 0.0), boxes.upper)
        return Boxes(np.where(bounded, boxes.lower, boxes.lower + 1.0), upper)


class Slow(Halving):
    """Removes a hundredth of the side."""

    def contract(self, boxes: Boxes) -> Boxes:
        self.rows.append(len(boxes))
        return Boxes(boxes.lower, boxes.upper - 0.01 * boxes.width())


def test_it_repeats_until_the_last_round() -> None:
    contractor = Halving()
    assert sides(fixpoint(contractor, max_rounds=5).contract(Boxes.of([(0, 32)]))) == [[(0, 1)]]
    assert contractor.rows == [1] * 5


def test_only_rows_that_still_shrink_are_repeated() -> None:
    class Once(Halving):
        def contract(self, boxes: Boxes) -> Boxes:
            self.rows.append(len(boxes))
            return Boxes(boxes.lower, np.where(boxes.upper > 8, 0.5 * boxes.upper, boxes.upper))

    contractor = Once()
    boxes = Boxes.of([(0, 64)], [(0, 8)], [(0, 16)], [(3, 3)])
    assert sides(fixpoint(contractor).contract(boxes)) == [[(0, 8)], [(0, 8)], [(0, 8)], [(3, 3)]]
    assert contractor.rows == [4, 2, 1, 1]


def test_a_change_below_the_ratio_does_not_count() -> None:
    contractor = Slow()
    fixpoint(contractor, ratio=0.05).contract(Boxes.of([(0, 1)]))
    assert contractor.rows == [1]
    fixpoint(contractor, ratio=0.005, max_rounds=20).contract(Boxes.of([(0, 1)]))
    assert len(contractor.rows) == 21


def test_a_bound_that_moves_on_an_unbounded_side_does_not_count() -> None:
    contractor = Halving(2)
    narrowed = fixpoint(contractor).contract(Boxes.of([(0, np.inf), (-np.inf, np.inf)]))
    assert sides(narrowed) == [[(1, np.inf), (-np.inf, np.inf)]]
    assert contractor.rows == [1]


def test_a_side_that_becomes_bounded_counts() -> None:
    class Bounding(Halving):
        def contract(self, boxes: Boxes) -> Boxes:
            self.rows.append(len(boxes))
            return Boxes(boxes.lower, np.minimum(boxes.upper, 1e308))

    contractor = Bounding()
    fixpoint(contractor).contract(Boxes.of([(-1e308, np.inf)]))  # the width itself overflows
    assert contractor.rows == [1, 1]


@pytest.mark.parametrize("dimension", [1, 2])
def test_points_stay_and_rows_empty_in_place(dimension: int) -> None:
    points = lattice(dimension, step=1.0)[::3]
    boxes = random_boxes(200, dimension, seed=1)
    before = sides(boxes)
    assert same(fixpoint(Points(points)).contract(boxes), Points(points).contract(boxes))
    assert sides(boxes) == before
    assert len(fixpoint(Points(points)).contract(Boxes.none(dimension))) == 0


def test_the_complement_is_repeated_too() -> None:
    class Known(Inside):
        def complement(self) -> Outside:
            return Outside(*self.sides)

    boxes = random_boxes(100, 2, seed=2)
    assert same((~FixedPoint(Known((1, 4), (0, 6)))).contract(boxes), Outside((1, 4), (0, 6)).contract(boxes))


def test_bad_arguments_are_refused() -> None:
    for ratio in (-0.1, 1.0, np.nan):
        with pytest.raises(ValueError, match="from 0 to less than 1"):
            fixpoint(Halving(), ratio=ratio)
    with pytest.raises(ValueError, match="rounds is 0; give at least 1"):
        fixpoint(Halving(), max_rounds=0)
    with pytest.raises(ValueError, match="needs 1"):
        fixpoint(Halving()).contract(Boxes.of([(0, 1), (0, 1)]))
