import numpy as np
import pytest

from ial.contractors import Boxes, Contractor, Intersection, Relaxed, Union


class Inside:
    """Narrows to one fixed box: the simplest contractor."""

    def __init__(self, *sides: tuple[float, float]) -> None:
        self.sides = np.array(sides)
        self.dimension = len(sides)

    def contract(self, boxes: Boxes) -> Boxes:
        lower, upper = np.maximum(boxes.lower, self.sides[:, 0]), np.minimum(boxes.upper, self.sides[:, 1])
        empty = (lower > upper).any(axis=1, keepdims=True)
        return Boxes(np.where(empty, np.inf, lower), np.where(empty, -np.inf, upper))


PLANE = Boxes.of([(-10, 10), (-10, 10)], [(1.5, 2.5), (0, 1)], [(7, 8), (7, 8)])
LEFT, RIGHT = Inside((0, 2), (0, 5)), Inside((1, 3), (-1, 4))
EMPTY = (np.inf, -np.inf)


def sides(boxes: Boxes) -> list[list[tuple[float, float]]]:
    return [list(zip(low, high, strict=True)) for low, high in zip(boxes.lower.tolist(), boxes.upper.tolist(), strict=True)]


def test_an_intersection_narrows_by_all() -> None:
    assert sides(Intersection(LEFT, RIGHT).contract(PLANE)) == [[(1, 2), (0, 4)], [(1.5, 2), (0, 1)], [EMPTY, EMPTY]]


def test_a_union_is_the_hull_of_all() -> None:
    assert sides(Union(LEFT, RIGHT).contract(PLANE)) == [[(0, 3), (-1, 5)], [(1.5, 2.5), (0, 1)], [EMPTY, EMPTY]]


def test_a_union_ignores_what_is_empty() -> None:
    assert sides(Union(LEFT, Inside((7, 9), (7, 9))).contract(PLANE))[2] == [(7, 8), (7, 8)]


def test_combinators_nest_and_leave_their_input_alone() -> None:
    before = sides(PLANE)
    nested: Contractor = Intersection(Union(LEFT, RIGHT), Relaxed(LEFT, RIGHT, outliers=1))
    assert sides(nested.contract(PLANE))[0] == [(0, 3), (-1, 5)]
    assert sides(PLANE) == before


@pytest.mark.parametrize("combine", [Intersection, Union, lambda *parts: Relaxed(*parts, outliers=0)])
def test_contractors_of_different_dimension_are_refused(combine: type[Intersection]) -> None:
    with pytest.raises(ValueError, match=r"dimensions \[1, 2\]"):
        combine(LEFT, Inside((0, 1)))
    with pytest.raises(ValueError, match="at least one contractor"):
        combine()
    with pytest.raises(ValueError, match="needs 2"):
        combine(LEFT).contract(Boxes.of([(0, 1)]))


def test_no_boxes_stay_no_boxes() -> None:
    for combined in (Intersection(LEFT, RIGHT), Union(LEFT, RIGHT), Relaxed(LEFT, RIGHT, outliers=1)):
        assert len(combined.contract(Boxes.none(2))) == 0
