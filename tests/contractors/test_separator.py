import numpy as np
import pytest

from ial.contractors import Boxes, Separator, lazy, minimal_outliers, pave, relaxed, variables
from tests.contractors.shapes import Inside, Outside, random_boxes, same, separator

BOXES = random_boxes(60, 2, seed=1)
A, B = separator((0, 4), (1, 6)), separator((2, 7), (0, 3))


def equal(a: Separator, b: Separator) -> bool:
    return all(same(x, y) for x, y in zip(a.separate(BOXES), b.separate(BOXES), strict=True))


def test_both_contractors_may_keep_the_boundary_and_one_box_may_be_undecided() -> None:
    corner = Boxes.of([(4, 4), (6, 6)])
    inner, outer = A.separate(corner)
    assert same(inner, corner)
    assert same(outer, corner)
    across = Boxes.of([(3, 5), (5, 7)])
    inner, outer = A.separate(across)
    assert same(inner, across)
    assert same(outer, Boxes.of([(3, 4), (5, 6)]))


def test_a_contractor_that_knows_its_complement_gives_a_separator() -> None:
    class Known(Inside):
        def complement(self) -> Outside:
            return Outside(*self.sides)

    bounds = ((0.0, 4.0), (1.0, 6.0))
    assert equal(Separator.of(Known(*bounds)), A)
    with pytest.raises(TypeError, match="outside of Inside"):
        Separator.of(Inside(*bounds))


def test_a_separator_of_a_family_is_one_set_on_both_sides() -> None:
    """Three strips that do not meet: no point satisfies the family, and the other set alone can be relaxed away from, or to."""
    x, y = variables("x y")
    strips = Separator.of(np.ones(3) * x == Boxes.of([(0, 1)], [(2, 3)], [(4, 5)]))
    half = Separator.of(y >= 0)
    room = Boxes.of([(-8, 8), (-8, 8)])
    for none in (strips, strips & half, lazy([strips, half])):
        assert pave(none, room, 0.5).volume().upper == 0.0
    for either in (strips | half, relaxed([strips, half], 1)):
        assert pave(either, room, 0.5).volume() == pave(half, room, 0.5).volume()
    outcome = minimal_outliers([strips, half], room, 0.5)
    assert (outcome.q_low, outcome.q_high) == (1, 1)


def test_operators_combine_separators() -> None:
    boxes = Boxes.of([(3, 3), (2, 2)], [(1, 1), (5, 5)], [(9, 9), (9, 9)])
    for made, members in ((A & B, [True, False, False]), (A | B, [True, True, False]), (~A, [False, False, True])):
        inner, outer = made.separate(boxes)
        assert inner.empty.tolist() == members
        assert (~outer.empty).tolist() == members


def test_what_is_no_separator_is_refused_with_advice() -> None:
    for combine in (Separator.__and__, Separator.__or__):
        with pytest.raises(TypeError, match=r"Inside is not a separator\. Separators combine with separators only: Separator\.of"):
            combine(A, Inside((0, 1), (0, 1)))  # type: ignore[arg-type]


def test_bad_input_is_refused() -> None:
    with pytest.raises(ValueError, match=r"dimensions \[1, 2\]"):
        Separator(Inside((0, 1)), Inside((0, 1), (0, 1)))
    with pytest.raises(ValueError, match=r"dimensions \[1, 2\]"):
        _ = A & separator((0, 1))
    with pytest.raises(ValueError, match="needs 2"):
        (A & B).separate(Boxes.of([(0, 1)]))
