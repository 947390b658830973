import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.contractors.paving.search import check_boxes, check_limits, checked_precision


def test_a_precision_is_spread_over_the_axes() -> None:
    assert checked_precision(0.5, 3).tolist() == [0.5, 0.5, 0.5]
    assert checked_precision([1, np.inf], 2).tolist() == [1.0, np.inf]


@pytest.mark.parametrize("precision", [0.0, -1.0, np.nan, [1.0, 0.0], [1.0, np.nan], [1.0], [[1.0, 1.0]], [1.0, 1.0, 1.0]])
def test_a_precision_that_cannot_be_reached_is_refused(precision: object) -> None:
    with pytest.raises(ValueError, match="the precision"):
        checked_precision(precision, 2)  # type: ignore[arg-type]


def test_boxes_may_be_empty_and_unbounded_but_not_nan() -> None:
    check_boxes(Boxes(np.array([[np.inf, np.inf], [-np.inf, 0.0]]), np.array([[-np.inf, -np.inf], [np.inf, 1.0]])))
    check_boxes(Boxes.none(2))
    with pytest.raises(ValueError, match="box 1 of 2 has a bound that is NaN"):
        check_boxes(Boxes(np.zeros((2, 1)), np.array([[0.0], [np.nan]])))


def test_limits() -> None:
    check_limits(max_boxes=1, max_bytes=None, max_seconds=0.0)
    for options in ({"max_boxes": 0}, {"batch": -1}, {"max_seconds": -0.1}, {"max_seconds": np.nan}):
        with pytest.raises(ValueError, match=next(iter(options))):
            check_limits(**options)  # type: ignore[arg-type]
