"""Boxes seen from another frame: containment, checked with 60 digits."""

import math

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ial.contractors.boxes import Boxes
from ial.contractors.intervals.trigonometric import PI_UPPER
from ial.maps.grids.rigid_transform import boxes_from_frame, boxes_into_frame
from ial.pose import Pose

mp = mpmath.mp.clone()
mp.dps = 60

coordinates = st.floats(-1e6, 1e6) | st.floats(-10, 10) | st.sampled_from([0.0, 1e-320, 0.1])
yaws = st.floats(-math.pi, math.pi) | st.sampled_from(
    [0.0, math.pi / 2, -math.pi / 2, math.pi, -math.pi, 1e-300, math.pi / 4, 1e4, -1e4, 99_999.0]
)
pairs = st.tuples(coordinates, coordinates).map(sorted).map(tuple)


def moved(pose: Pose, x: float, y: float, inverse: bool) -> tuple[mpmath.mpf, mpmath.mpf]:
    c, s = mp.cos(mp.mpf(pose.theta)), mp.sin(mp.mpf(pose.theta))
    if inverse:
        u, v = mp.mpf(x) - mp.mpf(pose.x), mp.mpf(y) - mp.mpf(pose.y)
        return c * u + s * v, c * v - s * u
    return mp.mpf(pose.x) + c * x - s * y, mp.mpf(pose.y) + s * x + c * y


def contains_modulo_turn(lower: float, upper: float, angle: mpmath.mpf) -> bool:
    near = int(mp.nint((lower - angle) / (2 * mp.pi)))
    return any(lower <= angle + turns * 2 * mp.pi <= upper for turns in range(near - 2, near + 3))


@pytest.mark.slow
@settings(max_examples=300)
@given(coordinates, coordinates, yaws, pairs, pairs, st.floats(-math.pi, math.pi), st.floats(0, 3), st.booleans())
def test_the_corners_stay_inside(
    x: float, y: float, yaw: float, xs: tuple[float, float], ys: tuple[float, float], start: float, width: float, inverse: bool
) -> None:
    pose = Pose(x, y, yaw)
    box = Boxes.of([xs, ys, (start, start + width)])
    image = (boxes_into_frame if inverse else boxes_from_frame)(box, pose)
    (xl, yl, tl), (xu, yu, tu) = image.lower[0], image.upper[0]
    for corner_x in xs:
        for corner_y in ys:
            u, v = moved(pose, corner_x, corner_y, inverse)
            assert xl <= u <= xu
            assert yl <= v <= yu
    for angle in (box.lower[0, 2], box.upper[0, 2]):
        assert contains_modulo_turn(tl, tu, mp.mpf(angle) + (-mp.mpf(yaw) if inverse else mp.mpf(yaw)))


def test_a_rotated_box_is_as_small_as_can_be() -> None:
    image = boxes_from_frame(Boxes.of([(0, 1), (0, 1), (0, 0.1)]), Pose(0, 0, math.pi / 4))
    root = math.sqrt(0.5)
    assert np.allclose(image.lower, [[-root, 0, math.pi / 4]], atol=1e-14)
    assert np.allclose(image.upper, [[root, 2 * root, math.pi / 4 + 0.1]], atol=1e-14)


def test_without_rotation_the_angle_is_untouched_and_sums_are_tight() -> None:
    box = Boxes.of([(0.1, 0.2), (0.3, 0.4), (3.0, 3.5)])
    image = boxes_from_frame(box, Pose(0.7, 0.0, 0.0))
    assert (image.lower[0, 2], image.upper[0, 2]) == (3.0, 3.5)
    assert (image.lower[0, 1], image.upper[0, 1]) == (0.3, 0.4)
    assert math.nextafter(image.lower[0, 0], 1) >= 0.1 + 0.7 >= image.lower[0, 0]


def test_the_full_circle_stays_the_full_circle() -> None:
    image = boxes_from_frame(Boxes.of([(0, 1), (0, 1), (-PI_UPPER, PI_UPPER)]), Pose(1, 2, 0.7))
    assert (image.lower[0, 2], image.upper[0, 2]) == (-PI_UPPER, PI_UPPER)


def test_an_interval_over_the_cut_is_written_in_the_agreed_form() -> None:
    image = boxes_from_frame(Boxes.of([(0, 1), (0, 1), (3.0, 3.1)]), Pose(0, 0, 1.0))
    assert -PI_UPPER <= image.lower[0, 2] <= PI_UPPER
    assert image.lower[0, 2] == pytest.approx(4.0 - 2 * math.pi)


def test_empty_and_endless_rows() -> None:
    box = Boxes(np.array([[np.inf] * 3, [-np.inf, 0, 0]]), np.array([[-np.inf] * 3, [np.inf, 1, 0.5]]))
    for yaw in (0.0, 0.5):
        image = boxes_from_frame(box, Pose(1, 2, yaw))
        assert image.empty.tolist() == [True, False]
        assert (image.lower[0] == np.inf).all()
        assert (image.upper[0] == -np.inf).all()
        assert (image.lower[1, 0], image.upper[1, 0]) == (-np.inf, np.inf)


def test_boxes_of_another_dimension_are_refused() -> None:
    with pytest.raises(ValueError, match="2 dimensions"):
        boxes_from_frame(Boxes.of([(0, 1), (0, 1)]), Pose())
