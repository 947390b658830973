import math

import mpmath
import numpy as np
import pytest

from ial.contractors import Affine, Boxes
from ial.contractors.boxes import FloatArray

MATRIX = np.array([[2.0, 0.1, -1.0], [0.3, 1.7, 0.0], [-0.7, 0.2, 3.1]])
OFFSET = np.array([0.1, -5.0, 1e-9])


def boxes_around(points: FloatArray, seed: int) -> Boxes:
    rng = np.random.default_rng(seed)
    return Boxes(points - rng.uniform(0, 1, points.shape), points + rng.uniform(0, 1, points.shape))


def exact(matrix: mpmath.matrix, point: FloatArray, offset: FloatArray) -> list[mpmath.mpf]:
    return list(matrix * mpmath.matrix(point.tolist()) + mpmath.matrix(offset.tolist()))


def encloses(boxes: Boxes, row: int, point: list[mpmath.mpf]) -> bool:
    return all(low <= number <= high for low, number, high in zip(boxes.lower[row], point, boxes.upper[row], strict=True))


def test_images_of_points_are_enclosed_to_a_few_bits() -> None:
    points = np.random.default_rng(1).normal(size=(200, 3)) * 10.0 ** np.random.default_rng(2).integers(-12, 12, size=(200, 1))
    image = Affine(MATRIX, OFFSET).image(Boxes(points, points))
    back = Affine(MATRIX, OFFSET).inverse.image(Boxes(points, points))
    with mpmath.workdps(60):
        matrix = mpmath.matrix(MATRIX.tolist())
        for row, point in enumerate(points):
            assert encloses(image, row, exact(matrix, point, OFFSET))
            solved = mpmath.lu_solve(matrix, mpmath.matrix(point.tolist()) - mpmath.matrix(OFFSET.tolist()))
            assert encloses(back, row, list(solved))
    scale = abs(points).max(axis=1, keepdims=True) + 5.0
    assert (image.width() <= 1e-14 * scale).all()
    assert (back.width() <= 1e-14 * scale).all()


def test_images_of_boxes_hold_the_images_of_their_corners_and_no_more() -> None:
    points = np.random.default_rng(3).normal(size=(50, 3))
    boxes = boxes_around(points, seed=4)
    image = Affine(MATRIX, OFFSET).image(boxes)
    ends = np.stack([boxes.lower, boxes.upper])
    corners = np.array([[ends[(i, j, k), row, (0, 1, 2)] for i in (0, 1) for j in (0, 1) for k in (0, 1)] for row in range(50)])
    images = corners @ MATRIX.T + OFFSET
    np.testing.assert_allclose(image.lower, images.min(axis=1), atol=1e-13)
    np.testing.assert_allclose(image.upper, images.max(axis=1), atol=1e-13)


@pytest.mark.parametrize("heading", [0.0, 0.3, -2.0, math.pi / 2, 100.0])
def test_a_rigid_motion_and_its_inverse(heading: float) -> None:
    motion = Affine.rigid(3.0, -0.1, heading)
    points = np.random.default_rng(5).normal(size=(50, 2))
    image, back = motion.image(Boxes(points, points)), motion.inverse.image(Boxes(points, points))
    with mpmath.workdps(60):
        c, s = mpmath.cos(heading), mpmath.sin(heading)
        turn, turn_back = mpmath.matrix([[c, -s], [s, c]]), mpmath.matrix([[c, s], [-s, c]])
        for row, point in enumerate(points):
            assert encloses(image, row, exact(turn, point, np.array([3.0, -0.1])))
            shifted = mpmath.matrix(point.tolist()) - mpmath.matrix([3.0, -0.1])
            assert encloses(back, row, list(turn_back * shifted))
    assert (image.width() < 1e-14).all()


def test_the_inverse_of_the_inverse_is_the_map_itself() -> None:
    boxes = boxes_around(np.zeros((5, 3)), seed=6)
    again = Affine(MATRIX, OFFSET).inverse.inverse
    assert (again.image(boxes).lower == Affine(MATRIX, OFFSET).image(boxes).lower).all()


def test_empty_and_unbounded_rows() -> None:
    shift = Affine([[0.0, 1.0], [2.0, 0.0]], [1.0, 1.0])
    image = shift.image(Boxes.of([(0, np.inf), (0, 1)], [(np.inf, -np.inf), (np.inf, -np.inf)], [(0, 1), (np.inf, -np.inf)]))
    assert image.lower.tolist()[0] == [1.0, 1.0]
    assert image.upper.tolist()[0] == [2.0, np.inf]
    assert (image.lower[1:] == np.inf).all()
    assert (image.upper[1:] == -np.inf).all()
    assert len(shift.image(Boxes.none(2))) == 0


def test_pivots_are_exchanged() -> None:
    inverse = Affine([[0.0, 0.0, 2.0], [4.0, 0.0, 0.0], [0.0, 8.0, 0.0]], [0.0, 0.0, 0.0]).inverse
    image = inverse.image(Boxes.of([(2, 2), (4, 4), (8, 8)]))
    assert image.lower.tolist() == image.upper.tolist() == [[1.0, 1.0, 1.0]]


def test_bad_input_is_refused() -> None:
    for matrix in ([[1.0, 2.0], [2.0, 4.0]], [[0.0, 0.0], [0.0, 0.0]], [[3.0, 1.0], [1.0, 1.0 / 3.0]]):
        with pytest.raises(ValueError, match="cannot be proved to be invertible"):
            Affine(matrix, [0.0, 0.0])
    for matrix, offset in (([[1.0, 2.0]], [0.0]), ([[1.0]], [0.0, 1.0]), ([], []), (np.eye(2), [[0.0, 0.0]])):
        with pytest.raises(ValueError, match=r"must be \(d, d\) and \(d,\)"):
            Affine(matrix, offset)
    for matrix, offset in (([[np.nan]], [0.0]), ([[1.0]], [np.inf])):
        with pytest.raises(ValueError, match="not finite"):
            Affine(matrix, offset)
    with pytest.raises(ValueError, match="must be finite"):
        Affine.rigid(0.0, 0.0, np.inf)
    with pytest.raises(ValueError, match="the map is of 2"):
        Affine.rigid(0.0, 0.0, 0.0).image(Boxes.none(3))
