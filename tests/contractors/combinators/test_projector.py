import numpy as np
import pytest

from ial.contractors import Boxes, Separator, projection
from ial.contractors.boxes import FloatArray
from tests.contractors.shapes import Inside, Mask, Points, inside, is_well_formed, lattice, random_boxes, same, separator, sides


def squares(boxes: Boxes) -> tuple[FloatArray, FloatArray]:
    """Return bounds of x² + y² for boxes with moderate integers or halves, which are exact."""
    least = np.where((boxes.lower <= 0) & (boxes.upper >= 0), 0.0, np.minimum(abs(boxes.lower), abs(boxes.upper)))
    most = np.maximum(abs(boxes.lower), abs(boxes.upper))
    return (least**2).sum(axis=1), (most**2).sum(axis=1)


class InDisk:
    """Tests whether x² + y² <= 1 is possible, without narrowing."""

    dimension = 2

    def contract(self, boxes: Boxes) -> Boxes:
        return boxes.where(squares(boxes)[0] <= 1.0)


class OutOfDisk:
    """Tests whether x² + y² >= 1 is possible, without narrowing."""

    dimension = 2

    def contract(self, boxes: Boxes) -> Boxes:
        return boxes.where(squares(boxes)[1] >= 1.0)


def cells(width: float) -> Boxes:
    lower = np.arange(-2.0, 2.0, width)[:, None]
    return Boxes(lower, lower + width)


def test_the_projection_of_a_finite_set_is_found_exactly() -> None:
    rng = np.random.default_rng(1)
    points = rng.integers(0, 8, size=(25, 3)).astype(np.float64)
    boxes, plane = random_boxes(150, 2, seed=2), lattice(2, step=1.0)
    domain = [(1.0, 6.0)]
    for onto, hidden in (((0, 1), 2), ((2, 0), 1)):
        shown = points[(points[:, hidden] >= 1) & (points[:, hidden] <= 6)][:, list(onto)]
        for precision in (0.1, 100.0):
            narrowed = projection(Points(points), onto, domain, precision).contract(boxes)
            assert same(narrowed, Points(shown).contract(boxes))  # the hull of a union of hulls
            assert is_well_formed(narrowed, boxes)
    assert inside(boxes, plane).any()


def test_several_variables_may_be_hidden() -> None:
    points = np.random.default_rng(3).integers(0, 8, size=(20, 4)).astype(np.float64)
    boxes = random_boxes(100, 2, seed=4)
    narrowed = projection(Points(points), (3, 1), [(0.0, 7.0), (0.0, 7.0)], 0.5).contract(boxes)
    assert same(narrowed, Points(points[:, [3, 1]]).contract(boxes))


def test_finer_values_give_a_closer_projection() -> None:
    class Cross:
        """Tests whether x = y and x = 1 − y are possible, each by itself."""

        dimension = 2

        def contract(self, boxes: Boxes) -> Boxes:
            (xl, yl), (xu, yu) = boxes.lower.T, boxes.upper.T
            return boxes.where((xl <= yu) & (yl <= xu) & (xl <= 1.0 - yl) & (1.0 - yu <= xu))

    left = []
    for precision in (1.0, 0.25, 0.01):
        narrowed = projection(Cross(), (0,), [(0.0, 0.9)], precision).contract(cells(1 / 64))
        assert not narrowed.empty[(cells(1 / 64).lower[:, 0] <= 0.5) & (cells(1 / 64).upper[:, 0] >= 0.5)].any()
        left.append(int((~narrowed.empty).sum()))
    assert left[0] > left[1] > left[2] <= 4


def test_a_separator_is_projected_from_both_sides() -> None:
    made = projection(Separator(inner=OutOfDisk(), outer=InDisk()), (0,), [(-2.0, 1.5)], 1 / 32)
    inner, outer = made.separate(cells(1 / 16))
    middle = abs(cells(1 / 16).lower[:, 0] + 1 / 32)
    assert inner.empty[middle < 0.9].all()
    assert not inner.empty[middle > 1.0].any()
    assert not outer.empty[middle < 1.0].any()
    assert outer.empty[middle > 1.1].all()


def test_the_inner_projection_removes_no_point_outside() -> None:
    def member(plane: FloatArray) -> Mask:
        """Return for which (x, y) the open box (1, 4) × (0, 6) × (2, 5) and the domain of z share a point: here for all inside."""
        return np.asarray(((plane > [1, 0]) & (plane < [4, 6])).all(axis=1))

    made = projection(separator((1, 4), (0, 6), (2, 5)), (0, 1), [(0.0, 3.0)], 0.5)
    boxes, plane = random_boxes(150, 2, seed=5), lattice(2)
    inner, outer = made.separate(boxes)
    there = inside(boxes, plane)
    closed = Inside((1, 4), (0, 6)).holds(plane)
    assert inside(inner, plane)[there & ~member(plane)].all()
    assert inside(outer, plane)[there & closed].all()
    points = Boxes(plane, plane)
    inner, outer = made.separate(points)
    assert (inner.empty == member(plane)).all()
    assert (~outer.empty == closed).all()
    assert is_well_formed(made.inner.contract(boxes), boxes)
    # Nothing is inside if the domain only meets what lies outside.
    apart = projection(separator((1, 4), (0, 6), (2, 5)), (0, 1), [(6.0, 7.0)], 0.5)
    assert same(apart.inner.contract(boxes), boxes)
    assert apart.outer.contract(boxes).empty.all()


def test_what_several_values_remove_adds_up() -> None:
    made = projection(separator((-1, 1.2), (-1, 0.5)) | separator((0.8, 3), (0.5, 2)), (0,), [(0.0, 1.0)], 0.1, max_boxes=3)
    boxes = Boxes.of([(0, 2)], [(-2, 2)], [(0, 4)], [(-2, 4)])
    assert sides(made.inner.contract(boxes)) == [[(np.inf, -np.inf)], [(-2, 0.8)], [(1.2, 4)], [(-2, 4)]]


def test_the_number_of_boxes_is_limited_for_each_row() -> None:
    class Watched(InDisk):
        rows = 0

        def contract(self, boxes: Boxes) -> Boxes:
            self.rows += len(boxes)
            return super().contract(boxes)

    contractor = Watched()
    narrowed = projection(contractor, (0,), [(0.9, 2.0)], 1e-9, max_boxes=20).contract(Boxes.of([(0.5, 0.6)], [(0.51, 0.6)]))
    assert contractor.rows <= 2 * 2 * 20
    assert len(narrowed) == 2
    # Adjacent doubles cannot be bisected: the limit ends the search.
    far = projection(Inside((0, 1), (1e20, 1e20 + 2**14)), (0,), [(1e20, 1e20 + 2**14)], 1.0, max_boxes=50)
    assert sides(far.contract(Boxes.of([(0, 2)]))) == [[(0, 1)]]


def test_large_batches_are_divided_and_none_stay_none() -> None:
    lower = np.random.default_rng(6).uniform(-2, 2, size=(20000, 1))
    boxes = Boxes(lower, lower + 0.01)
    made = projection(Separator(inner=OutOfDisk(), outer=InDisk()), (0,), [(-0.5, 0.5)], 0.25)
    inner, outer = made.separate(boxes)
    some = slice(12345, 12355)
    assert same(inner[some], made.inner.contract(boxes[some]))
    assert same(outer[some], made.outer.contract(boxes[some]))
    assert len(made.inner.contract(Boxes.none(1))) == len(made.outer.contract(Boxes.none(1))) == 0


def test_bad_arguments_are_refused() -> None:
    shape = Inside((0, 1), (0, 1), (0, 1))
    for onto, domain in (((0, 1, 2), []), ((), [(0, 1)] * 3)):
        with pytest.raises(ValueError, match="keep at least one and hide at least one"):
            projection(shape, onto, domain, 0.1)
    with pytest.raises(ValueError, match="different numbers from 0 to 2"):
        projection(shape, (0, 3), [(0, 1)], 0.1)
    for domain in ([(0, 1), (0, 1)], [(1, 0)], [(0, np.inf)], [(np.nan, 1)], []):
        with pytest.raises(ValueError, match=r"finite bounds \(lower, upper\) for each of the hidden variables \[2\]"):
            projection(shape, (0, 1), domain, 0.1)
    for precision in (0.0, -1.0, np.nan):
        with pytest.raises(ValueError, match=r"the precision is .* give a positive number"):
            projection(shape, (0, 1), [(0, 1)], precision)
    with pytest.raises(ValueError, match="number of boxes is 0"):
        projection(shape, (0, 1), [(0, 1)], 0.1, max_boxes=0)
    with pytest.raises(ValueError, match="needs 2"):
        projection(shape, (0, 1), [(0, 1)], 0.1).contract(Boxes.none(3))
