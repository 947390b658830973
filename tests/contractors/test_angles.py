import math

import mpmath
import numpy as np
import pytest

from ial.contractors.angles import wrapped
from ial.contractors.boxes import Boxes
from ial.contractors.intervals.trigonometric import PI_UPPER

mpmath.mp.prec = 200
TURN = 2 * mpmath.pi


def test_no_angle_is_lost_and_all_come_out_in_the_form() -> None:
    random = np.random.default_rng(0)
    lower = random.uniform(-50.0, 50.0, (500, 2)) * random.choice([0.0, 1.0, 1e3], (500, 1))
    boxes = Boxes(lower, lower + random.choice([0.0, 0.1, 3.0, 6.2], (500, 2)))
    angles = wrapped(boxes, 1)
    assert (angles.lower[:, 0] == boxes.lower[:, 0]).all()
    assert (angles.upper[:, 0] == boxes.upper[:, 0]).all()
    assert (np.abs(angles.lower[:, 1]) <= PI_UPPER).all()
    for low, high, before, after in zip(angles.lower[:, 1], angles.upper[:, 1], boxes.lower[:, 1], boxes.upper[:, 1], strict=True):
        shift = mpmath.nint((mpmath.mpf(low) - before) / TURN) * TURN
        assert low <= before + shift
        assert after + shift <= high <= after + shift + 1e-10


def test_rows_stay_rows_and_empty_ones_are_empty_in_every_dimension() -> None:
    boxes = Boxes(
        np.array([[0.0, 7.0], [1.0, 7.0], [0.0, 1.0], [np.inf, np.inf], [0.0, -np.inf]]),
        np.array([[1.0, 7.5], [0.0, 7.5], [1.0, 0.0], [-np.inf, -np.inf], [1.0, np.inf]]),
    )
    lower, upper = boxes.lower.copy(), boxes.upper.copy()
    angles = wrapped(boxes, 1)
    assert angles.empty.tolist() == [False, True, True, True, False]
    assert (angles.lower[angles.empty] == np.inf).all()
    assert (angles.upper[angles.empty] == -np.inf).all()
    assert angles.lower[0, 1] == pytest.approx(7.0 - 2.0 * math.pi)
    assert (angles.lower[4, 1], angles.upper[4, 1]) == (-PI_UPPER, PI_UPPER)
    assert (boxes.lower == lower).all()
    assert (boxes.upper == upper).all()


def test_boxes_in_the_form_are_returned_as_they_are() -> None:
    boxes = Boxes.of([(7, 8), (3.0, 9.0)], [(7, 8), (-PI_UPPER, PI_UPPER)])
    assert wrapped(boxes, 1) is boxes
    assert wrapped(boxes) is boxes
    assert wrapped(Boxes.none(2), 0, 1).lower.shape == (0, 2)


def test_what_is_no_number_or_no_axis_is_refused() -> None:
    for lower, upper in (([[0.0, np.nan]], [[1.0, 1.0]]), ([[0.0, 0.0]], [[np.nan, 1.0]])):
        with pytest.raises(ValueError, match="box 0 of 1 has a bound that is NaN"):
            wrapped(Boxes(np.array(lower), np.array(upper)), 1)
    for axis in (-1, 2):
        with pytest.raises(ValueError, match=f"axis {axis} was said to be circular"):
            wrapped(Boxes.none(2), axis)
