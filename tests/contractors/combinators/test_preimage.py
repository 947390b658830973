import numpy as np
import pytest

from ial.contractors import Affine, Boxes, transform
from ial.contractors.combinators.preimage import Preimage
from tests.contractors.shapes import Inside, Mask, Outside, inside, is_well_formed, lattice, random_boxes, separator, sides

BOUNDS = ((1.0, 4.0), (0.0, 6.0))
POINTS = lattice(2)


class Known(Inside):
    def complement(self) -> Outside:
        return Outside(*self.sides)


def test_a_set_is_seen_through_a_shift_and_a_scaling() -> None:
    twice = Affine([[0.0, 2.0], [1.0, 0.0]], [1.0, 0.0])  # (x, y) -> (2 y + 1, x)
    narrowed = transform(Inside(*BOUNDS), twice, twice.inverse).contract(
        Boxes.of([(-9, 9), (-9, 9)], [(-9, -1), (-9, 9)], [(2, 3), (1, 8)])
    )
    assert sides(narrowed) == [[(0, 6), (0, 1.5)], [(np.inf, -np.inf)] * 2, [(2, 3), (1, 1.5)]]


@pytest.mark.parametrize("heading", [0.0, 0.4, 2.0])
def test_no_point_is_removed_on_the_wrong_side(heading: float) -> None:
    motion = Affine.rigid(1.5, -2.0, heading)
    made = transform(separator(*BOUNDS), motion, motion.inverse)
    c, s = np.cos(heading), np.sin(heading)
    image = POINTS @ np.array([[c, -s], [s, c]]).T + [1.5, -2.0]

    def within(slack: float) -> Mask:
        return Inside(*((a - slack, b + slack) for a, b in BOUNDS)).holds(image)

    boxes = random_boxes(200, 2, seed=1)
    inner, outer = made.separate(boxes)
    there = inside(boxes, POINTS)
    assert inside(outer, POINTS)[there & within(-1e-9)].all()
    assert inside(inner, POINTS)[there & ~within(1e-9)].all()
    assert is_well_formed(inner, boxes)
    assert is_well_formed(outer, boxes)
    inner, outer = made.separate(Boxes(POINTS, POINTS))
    assert outer.empty[~within(1e-9)].all()
    assert inner.empty[within(-1e-9)].all()
    assert within(-1e-9).any()


def test_a_function_may_be_any_object_with_images() -> None:
    class Cube:
        def image(self, boxes: Boxes) -> Boxes:
            return Boxes(boxes.lower**3, boxes.upper**3)

    class Root:
        def image(self, boxes: Boxes) -> Boxes:
            return Boxes(np.cbrt(boxes.lower) - 1e-9, np.cbrt(boxes.upper) + 1e-9)

    narrowed = transform(Inside((8, 27)), Cube(), Root()).contract(Boxes.of([(-5, 5)], [(2.5, 5)], [(4, 5)]))
    np.testing.assert_allclose(narrowed.lower[:2, 0], [2, 2.5], atol=1e-8)
    np.testing.assert_allclose(narrowed.upper[:2, 0], [3, 3], atol=1e-8)
    assert narrowed.lower[1, 0] == 2.5
    assert narrowed.empty.tolist() == [False, False, True]


def test_a_row_without_values_is_empty_even_if_the_inverse_forgets_it() -> None:
    class Careless:
        def image(self, boxes: Boxes) -> Boxes:
            return Boxes(np.full(boxes.lower.shape, -99.0), np.full(boxes.upper.shape, 99.0))

    shift = Affine([[1.0]], [1.0])
    assert transform(Inside((8, 27)), shift, Careless()).contract(Boxes.of([(0, 1)], [(7, 8)])).empty.tolist() == [True, False]


def test_the_complement_is_the_preimage_of_the_complement() -> None:
    motion = Affine.rigid(1.5, -2.0, 0.4)
    boxes = random_boxes(100, 2, seed=2)
    complement = (~Preimage(Known(*BOUNDS), motion, motion.inverse)).contract(boxes)
    assert sides(complement) == sides(transform(separator(*BOUNDS), motion, motion.inverse).inner.contract(boxes))


def test_boxes_of_another_dimension_are_refused() -> None:
    motion = Affine.rigid(0.0, 0.0, 1.0)
    with pytest.raises(ValueError, match="needs 2"):
        transform(Inside(*BOUNDS), motion, motion.inverse).contract(Boxes.none(3))
