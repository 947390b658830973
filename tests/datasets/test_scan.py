"""Tests of the laser scan: classes, bearings, and what is refused."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.datasets.scan import BeamClass, LaserScan, Mounting
from ial.errors import RecordingError

H, N, T, I = BeamClass.HIT, BeamClass.NO_RETURN, BeamClass.TOO_NEAR, BeamClass.INVALID  # noqa: E741


def _scan(ranges: list[float], **changes: float) -> LaserScan:
    return LaserScan(0, np.array(ranges, dtype=np.float32), **{"angle_min": 0.0, "angle_increment": 0.1, **changes})


def test_classes_follow_rep_117() -> None:
    scan = _scan([math.nan, math.inf, -math.inf, 0.05, 0.1, 5.0, 10.0, 24.0, -1.0], range_min=0.1, range_max=10.0)
    assert scan.classes().tolist() == [I, N, T, T, H, H, N, N, T]


def test_a_zero_is_too_near_even_without_a_minimum() -> None:
    assert _scan([0.0, -0.0, 1e-6], range_min=0.0).classes().tolist() == [T, T, H]


def test_without_a_maximum_only_infinity_is_no_return() -> None:
    assert _scan([1e30, math.inf]).classes().tolist() == [H, N]


@pytest.mark.parametrize("limit", [80.99, 81.83, 50.0])
def test_a_limit_equals_itself_in_float32(limit: float) -> None:
    assert _scan([limit, 81.91], range_max=limit).classes().tolist() == [N, N]


@given(st.floats(-7.0, 7.0), st.floats(-0.1, 0.1).filter(lambda step: abs(step) > 1e-3), st.integers(1, 400))
def test_bearings_enclose_every_decimal_angle(start: float, step: float, beams: int) -> None:
    lower, upper = LaserScan(0, np.ones(beams), start, step).bearings()
    for beam in (0, beams // 2, beams - 1):
        exact = Fraction(start) + beam * Fraction(step)
        assert Fraction(lower[beam]) <= exact <= Fraction(upper[beam])
        assert upper[beam] - lower[beam] < 1e-4


@given(st.floats(-7.0, 7.0), st.floats(-0.1, 0.1).filter(lambda step: abs(step) > 1e-3), st.booleans(), st.booleans())
def test_bearings_enclose_the_ends_of_the_float32_cells(start: float, step: float, first_up: bool, step_up: bool) -> None:
    scan = LaserScan(0, np.ones(200), start, step)

    def half_way(value: float, up: bool) -> Fraction:
        neighbour = np.nextafter(np.float32(value), np.float32(np.inf if up else -np.inf))
        return (Fraction(float(value)) + Fraction(float(neighbour))) / 2

    lower, upper = scan.bearings()
    for beam in (0, 1, 199):
        exact = half_way(scan.angle_min, first_up) + beam * half_way(scan.angle_increment, step_up)
        assert Fraction(lower[beam]) <= exact <= Fraction(upper[beam])


def test_upside_down_reverses_bearings() -> None:
    lower, upper = LaserScan(0, np.ones(5), -0.2, 0.1).bearings()
    below, above = LaserScan(0, np.ones(5), -0.2, 0.1, mounting=Mounting(upside_down=True)).bearings()
    assert (below == -upper).all()
    assert (above == -lower).all()


def test_a_negative_increment_turns_clockwise() -> None:
    lower, upper = LaserScan(0, np.ones(3), 1.0, -0.5, time_increment=-1e-3).bearings()
    assert 0.5 * (lower + upper) == pytest.approx([1.0, 0.5, 0.0])


@given(st.floats(1e-3, 1e5))
def test_range_slack_covers_the_rounding_of_a_decimal(distance: float) -> None:
    scan = _scan([distance])
    assert abs(Fraction(distance) - Fraction(float(scan.ranges[0]))) <= Fraction(float(scan.range_slack()[0]))


def test_numbers_are_kept_as_float32() -> None:
    scan = _scan([1.1], range_max=80.99)
    assert scan.range_max == float(np.float32(80.99))
    assert scan.ranges.dtype == np.float32
    assert not scan.ranges.flags.writeable


@pytest.mark.parametrize(
    ("ranges", "changes", "message"),
    [
        ([], {}, "without beams"),
        ([1.0, 2.0], {"angle_increment": 0.0}, "increment of zero"),
        ([1.0], {"angle_min": math.nan}, "not finite"),
        ([1.0], {"angle_increment": math.inf}, "not finite"),
        ([1.0], {"range_max": math.nan}, "range_max"),
        ([1.0], {"range_max": 0.0}, "range_max"),
        ([1.0], {"range_min": 2.0, "range_max": 1.0}, "range_max"),
    ],
)
def test_scans_that_make_no_sense_are_refused(ranges: list[float], changes: dict[str, float], message: str) -> None:
    with pytest.raises(RecordingError, match=message):
        _scan(ranges, **changes)


def test_one_beam_needs_no_increment() -> None:
    assert len(_scan([1.0], angle_increment=0.0)) == 1


def test_a_mounting_must_be_finite() -> None:
    with pytest.raises(RecordingError, match="--laser-pose"):
        Mounting(math.nan, 0.0, 0.0)
