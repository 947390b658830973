import numpy as np
import pytest

from ial.contractors import Boxes, Contractor, Intersection, Union
from ial.contractors.contractor import common_dimension, complement, require_dimension
from tests.contractors.shapes import Inside, Outside, Points, random_boxes, same, separator, sides


class Shape(Contractor):
    """A box that inherits the operators and knows its complement."""

    def __init__(self, *bounds: tuple[float, float]) -> None:
        self.bounds = bounds
        self.dimension = len(bounds)

    def contract(self, boxes: Boxes) -> Boxes:
        return Inside(*self.bounds).contract(boxes)

    def complement(self) -> Outside:
        return Outside(*self.bounds)


LEFT, RIGHT = ((0, 2), (0, 5)), ((1, 3), (-1, 4))
PLANE = Boxes.of([(-10, 10), (-10, 10)], [(1.5, 2.5), (0, 1)], [(7, 8), (7, 8)])
EMPTY = (np.inf, -np.inf)


def test_and_is_the_intersection_also_with_a_stranger_on_either_side() -> None:
    for both in (Shape(*LEFT) & Shape(*RIGHT), Shape(*LEFT) & Inside(*RIGHT), Inside(*LEFT) & Shape(*RIGHT)):
        assert isinstance(both, Intersection)
        assert sides(both.contract(PLANE)) == [[(1, 2), (0, 4)], [(1.5, 2), (0, 1)], [EMPTY, EMPTY]]


def test_or_is_the_union_also_with_a_stranger_on_either_side() -> None:
    for either in (Shape(*LEFT) | Shape(*RIGHT), Shape(*LEFT) | Inside(*RIGHT), Inside(*LEFT) | Shape(*RIGHT)):
        assert isinstance(either, Union)
        assert sides(either.contract(PLANE)) == [[(0, 3), (-1, 5)], [(1.5, 2.5), (0, 1)], [EMPTY, EMPTY]]


def test_not_is_the_complement_where_one_is_known() -> None:
    boxes = random_boxes(200, 2, seed=1)
    assert same((~Shape(*LEFT)).contract(boxes), Outside(*LEFT).contract(boxes))
    for unknown in (Points(np.zeros((1, 2))), Points(np.zeros((1, 2))) & Shape(*LEFT), Inside(*LEFT) | Shape(*LEFT)):
        with pytest.raises(TypeError, match=r"no contractor is known for the points outside of (Points|Inside); .* Separator"):
            _ = ~unknown
    with pytest.raises(TypeError, match="outside of Inside"):
        complement(Inside(*LEFT))


def test_what_cannot_be_combined_is_refused_with_advice() -> None:
    with pytest.raises(TypeError, match=r"int is not a contractor"):
        Shape(*LEFT) & 3  # type: ignore[operator]
    with pytest.raises(TypeError, match=r"Separators combine with separators only: Separator\.of"):
        Shape(*LEFT) | separator(*RIGHT)  # type: ignore[operator]


def test_dimensions_are_compared() -> None:
    assert common_dimension([Inside(*LEFT), Inside(*RIGHT)]) == 2
    with pytest.raises(ValueError, match=r"dimensions \[1, 2\]"):
        common_dimension([Inside(*LEFT), Inside((0, 1))])
    with pytest.raises(ValueError, match="at least one contractor"):
        common_dimension([])
    with pytest.raises(ValueError, match="the boxes have 2 dimensions; Inside needs 1"):
        require_dimension(Inside((0, 1)), PLANE)
