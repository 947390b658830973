import numpy as np
import pytest

from ial.contractors import Boxes, relaxed, where
from ial.contractors.combinators.cylinder import Cylinder
from tests.contractors.shapes import Inside, Outside, Points, Several, inside, is_well_formed, lattice, random_boxes, same, separator, sides


def test_variables_are_taken_in_the_order_given() -> None:
    contractor = where(Inside((0, 1), (5, 6)), axes=(2, 0), dimension=3)
    narrowed = contractor.contract(Boxes.of([(-9, 9), (-7, 7), (-9, 9)], [(-9, 9), (-7, 7), (2, 3)]))
    assert sides(narrowed) == [[(5, 6), (-7, 7), (0, 1)], [(np.inf, -np.inf)] * 3]


@pytest.mark.parametrize("axes", [(0, 1), (1, 0), (2, 0), (1, 2)])
def test_no_point_is_lost(axes: tuple[int, int]) -> None:
    plane, space = lattice(2, step=1.0)[::3], lattice(3, step=1.0)
    boxes = random_boxes(150, 3, seed=1)
    narrowed = where(Points(plane), axes, 3).contract(boxes)
    member = (space[:, None, list(axes)] == plane).all(axis=2).any(axis=1)
    assert inside(narrowed, space)[inside(boxes, space) & member].all()
    assert is_well_formed(narrowed, boxes)
    kept = narrowed[~narrowed.empty]
    free = ({0, 1, 2} - set(axes)).pop()
    assert (kept.lower[:, free] == boxes.lower[~narrowed.empty, free]).all()


def test_separators_families_and_complements_follow() -> None:
    bounds, boxes = ((1, 4), (0, 6)), random_boxes(150, 3, seed=2)
    made = where(separator(*bounds), (2, 0), 3)
    assert same(made.outer.contract(boxes), Cylinder(Inside(*bounds), (2, 0), 3).contract(boxes))
    assert same(made.inner.contract(boxes), Cylinder(Outside(*bounds), (2, 0), 3).contract(boxes))

    class Known(Inside):
        def complement(self) -> Outside:
            return Outside(*self.sides)

    assert same((~Cylinder(Known(*bounds), (2, 0), 3)).contract(boxes), made.inner.contract(boxes))
    rng = np.random.default_rng(3)
    family = Several(*np.sort(rng.integers(0, 8, size=(2, 5, 2)), axis=0).astype(np.float64))
    one_by_one = [where(member, (2, 0), 3) for member in family.one_by_one()]
    for outliers in range(5):
        narrowed = relaxed(where(family, (2, 0), 3), outliers).contract(boxes)
        assert same(narrowed, relaxed(one_by_one, outliers).contract(boxes))


def test_bad_axes_are_refused() -> None:
    shape = Inside((0, 1), (0, 1))
    for axes in ((0, 0), (0, 3), (-1, 0)):
        with pytest.raises(ValueError, match="in 3 dimensions give different numbers from 0 to 2"):
            where(shape, axes, 3)
    with pytest.raises(ValueError, match="1 axes are given; Inside has 2 variables"):
        where(shape, (1,), 3)
    with pytest.raises(ValueError, match="needs 3"):
        where(shape, (0, 1), 3).contract(Boxes.none(2))
