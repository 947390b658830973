from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from ial.contractors import Boxes, Contractor, Intersection, Union, intersection, relaxed, union
from tests.contractors.shapes import Inside, Points, Several, inside, is_well_formed, lattice, random_boxes, same, separator, sides

PLANE = Boxes.of([(-10, 10), (-10, 10)], [(1.5, 2.5), (0, 1)], [(7, 8), (7, 8)])
LEFT, RIGHT = Inside((0, 2), (0, 5)), Inside((1, 3), (-1, 4))
EMPTY = (np.inf, -np.inf)


class Sloppy:
    """Empties a row in one dimension only."""

    dimension = 2

    def contract(self, boxes: Boxes) -> Boxes:
        upper = boxes.upper.copy()
        upper[:, 1] = boxes.lower[:, 1] - 1.0
        return Boxes(boxes.lower, upper)


class Counting:
    """Counts the rows it is given."""

    def __init__(self, contractor: Inside) -> None:
        self.contractor, self.dimension = contractor, contractor.dimension
        self.rows: list[int] = []

    def contract(self, boxes: Boxes) -> Boxes:
        self.rows.append(len(boxes))
        return self.contractor.contract(boxes)


def several(count: int, seed: int, dimension: int = 2) -> Several:
    rng = np.random.default_rng(seed)
    bounds = np.sort(rng.integers(0, 8, size=(2, count, dimension)), axis=0).astype(np.float64)
    return Several(*bounds)


def test_an_intersection_narrows_by_all() -> None:
    assert sides(intersection([LEFT, RIGHT]).contract(PLANE)) == [[(1, 2), (0, 4)], [(1.5, 2), (0, 1)], [EMPTY, EMPTY]]


def test_a_union_is_the_hull_of_all() -> None:
    assert sides(union([LEFT, RIGHT]).contract(PLANE)) == [[(0, 3), (-1, 5)], [(1.5, 2.5), (0, 1)], [EMPTY, EMPTY]]


def test_a_union_ignores_what_is_empty() -> None:
    assert sides(union([LEFT, Inside((7, 9), (7, 9))]).contract(PLANE))[2] == [(7, 8), (7, 8)]
    assert sides(union([Sloppy(), LEFT]).contract(PLANE)) == sides(LEFT.contract(PLANE))


def test_a_row_empty_in_one_dimension_comes_out_empty_in_all() -> None:
    for combined in (intersection([LEFT, Sloppy()]), intersection([Sloppy()]), union([Sloppy()]), relaxed([Sloppy()], 0)):
        assert sides(combined.contract(PLANE)) == [[EMPTY, EMPTY]] * 3


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_no_point_of_all_or_of_one_of_several_sets_is_lost(dimension: int) -> None:
    boxes, points = random_boxes(300, dimension, seed=3), lattice(dimension, step=1.0)
    rng = np.random.default_rng(4)
    chosen = [rng.random(len(points)) < 0.8 for _ in range(4)]
    sets = [Points(points[mask]) for mask in chosen]
    for combined, member in ((intersection(sets), np.all(chosen, axis=0)), (union(sets), np.any(chosen, axis=0))):
        narrowed = combined.contract(boxes)
        wanted = inside(boxes, points) & member
        assert wanted.any()
        assert inside(narrowed, points)[wanted].all()
        assert is_well_formed(narrowed, boxes)
    # The hull of a union of hulls is the hull of the union.
    assert same(union(sets).contract(boxes), Points(points[np.any(chosen, axis=0)]).contract(boxes))


def test_operators_and_functions_give_one_flat_combination() -> None:
    a, b, c = (Points(np.full((1, 2), float(k))) for k in range(3))
    assert (a & b & c).contractors == (a, b, c)  # type: ignore[attr-defined]
    assert (a & (b & c)).contractors == (a, b, c)  # type: ignore[attr-defined]
    assert (a | (b | c)).contractors == (a, b, c)  # type: ignore[attr-defined]
    mixed = a | (b & c)
    assert isinstance(mixed, Union)
    assert mixed.contractors[0] is a
    assert isinstance(mixed.contractors[1], Intersection)
    assert isinstance(union(part for part in (a, b)), Union)


@pytest.mark.parametrize(("combine", "alone"), [(intersection, 0), (union, 4), (lambda family: relaxed(family, 2), 2)])
def test_a_family_gives_what_its_members_give(combine: Callable[[Any], Contractor], alone: int) -> None:
    family, boxes = several(5, seed=5), random_boxes(300, 2, seed=6)
    narrowed = combine(family).contract(boxes)
    assert same(narrowed, relaxed(family.one_by_one(), alone).contract(boxes))
    assert same(combine([family]).contract(boxes), narrowed)
    assert is_well_formed(narrowed, boxes)


def test_families_and_contractors_mix() -> None:
    family, boxes = several(3, seed=7), random_boxes(300, 2, seed=8)
    assert same(intersection([LEFT, family]).contract(boxes), intersection([LEFT, *family.one_by_one()]).contract(boxes))
    assert same(union([family, LEFT]).contract(boxes), union([LEFT, *family.one_by_one()]).contract(boxes))
    for outliers in range(5):
        assert same(relaxed([LEFT, family], outliers).contract(boxes), relaxed([LEFT, *family.one_by_one()], outliers).contract(boxes))


def test_a_row_that_is_decided_is_not_passed_on() -> None:
    boxes = Boxes.concatenate([PLANE[1:2]] * 90 + [PLANE[2:3]] * 10 + [PLANE[1:2]] * 300)
    first, second = Counting(Inside((0, 2), (7, 8))), Counting(RIGHT)
    assert intersection([first, second]).contract(boxes).empty.all()
    assert (first.rows, second.rows) == ([400], [])
    first, second = Counting(Inside((7, 8), (7, 8))), Counting(RIGHT)
    narrowed = union([Counting(LEFT), first, second]).contract(boxes)
    assert same(narrowed, Union(LEFT, first.contractor, RIGHT).contract(boxes))
    assert first.rows == [400]
    first, second = Counting(Inside((-20, 20), (0, 5))), Counting(RIGHT)
    narrowed = union([first, second]).contract(boxes)
    assert second.rows == [10]
    assert same(narrowed, Union(RIGHT, first.contractor).contract(boxes))


def test_input_is_left_alone_and_no_boxes_stay_no_boxes() -> None:
    boxes = random_boxes(100, 2, seed=9)
    before = sides(boxes)
    for combined in (intersection([LEFT, RIGHT]), union([LEFT, RIGHT]), union([LEFT & Points(np.ones((1, 2))), RIGHT])):
        combined.contract(boxes)
        assert sides(boxes) == before
        assert len(combined.contract(Boxes.none(2))) == 0


def test_bad_input_is_refused() -> None:
    for combine in (intersection, union):
        with pytest.raises(ValueError, match=r"dimensions \[1, 2\]"):
            combine([LEFT, Inside((0, 1))])
        with pytest.raises(ValueError, match="at least one contractor"):
            combine([])
        with pytest.raises(ValueError, match="needs 2"):
            combine([LEFT]).contract(Boxes.of([(0, 1)]))
        with pytest.raises(TypeError, match="Separators combine with separators only"):
            combine([LEFT, separator((0, 1), (0, 1))])
        with pytest.raises(TypeError, match="put them into a list"):
            combine(LEFT)
        with pytest.raises(ValueError, match="holds 0 constraints"):
            combine(Several(np.empty((0, 2)), np.empty((0, 2))))
