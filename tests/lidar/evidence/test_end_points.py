import math

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.contractors.boxes import FloatArray
from ial.contractors.intervals.trigonometric import PI_UPPER
from ial.lidar.evidence.end_points import relative_bounds
from ial.lidar.evidence.evidence import Evidence
from ial.lidar.margins import MARGIN, NEAR, REACH

DIGITS = 50
ROUNDING = 2.0**-33  # cells, twice what one later operation may round off
ANGLES = [0.0, 1e-300, 2.0**-30, 0.25 * math.pi, 0.5 * math.pi, math.pi, 1.5 * math.pi, 2.0 * math.pi]
WIDTHS = [0.0, 5e-324, 2.0**-52, 1e-9, 0.01, 0.5 * math.pi, 2.0, 2.999999, 3.0, math.pi, 4.0]

angles = st.sampled_from([sign * angle for angle in ANGLES for sign in (1.0, -1.0)]) | st.floats(-math.pi, 2.0 * math.pi)
widths = st.sampled_from(WIDTHS) | st.floats(0.0, 3.2)
lengths = st.sampled_from([0.0, 5e-324, 1e-9, 1.0, -1.0]) | st.floats(-80.0, 80.0)
errors = st.sampled_from([0.0, 1e-9]) | st.floats(0.0, 0.5)
resolutions = st.sampled_from([0.02, 0.05, 0.1, 1.0])


def bounds_of(
    lower: float, upper: float, end: tuple[float, float], direction: float, error: tuple[float, float], **of_map: float
) -> FloatArray:
    """The four bounds of one beam, whose direction is given as an angle."""
    out = np.empty((1, 4))
    unit = np.array([[math.cos(direction), math.sin(direction)]])
    evidence = Evidence(np.array([end]), unit, np.array([error]), of_map.get("map_error", 0.0), 0)
    relative_bounds(lower, upper, evidence, of_map.get("resolution", 0.05), out)
    return out[0]


def exact_end(theta: float, end: tuple[float, float], direction: float, along: float, across: float) -> tuple[mpmath.mpf, mpmath.mpf]:
    """R(θ)·(end + along·d + across·d⊥), with the doubles that the kernel is given for d."""
    unit_x, unit_y = mpmath.mpf(math.cos(direction)), mpmath.mpf(math.sin(direction))
    x = mpmath.mpf(end[0]) + along * unit_x - across * unit_y
    y = mpmath.mpf(end[1]) + along * unit_y + across * unit_x
    c, s = mpmath.cos(mpmath.mpf(theta)), mpmath.sin(mpmath.mpf(theta))
    return c * x - s * y, s * x + c * y


def inside(lower: float, upper: float, share: float) -> list[float]:
    """Headings of an interval: both ends, one in between, and every quarter turn, where a coordinate may be largest."""
    quarters = [0.5 * math.pi * k for k in range(-4, 9)]
    return [lower, upper, min(max(lower + share * (upper - lower), lower), upper), *(q for q in quarters if lower <= q <= upper)]


@given(angles, widths, st.tuples(lengths, lengths), angles, st.tuples(errors, errors), errors, resolutions, st.floats(0.0, 1.0))
def test_bounds_enclose_every_end_point_with_the_margin_to_spare(
    lower: float,
    width: float,
    end: tuple[float, float],
    direction: float,
    error: tuple[float, float],
    map_error: float,
    resolution: float,
    share: float,
) -> None:
    upper = lower + width
    bounds = bounds_of(lower, upper, end, direction, error, map_error=map_error, resolution=resolution)
    with mpmath.workdps(DIGITS):
        for theta in inside(lower, upper, share):
            for along in (-error[0], error[0]):
                for across in (-error[1], error[1]):
                    point = exact_end(theta, end, direction, along, across)
                    for value, low, high in zip(point, bounds[:2], bounds[2:], strict=True):
                        assert (value - map_error) / resolution - low >= MARGIN - ROUNDING
                        assert high - (value + map_error) / resolution >= MARGIN - ROUNDING


@given(angles, st.floats(0.0, 2.99), st.tuples(lengths, lengths))
def test_bounds_of_a_point_are_tight(lower: float, width: float, end: tuple[float, float]) -> None:
    upper = lower + width
    bounds = bounds_of(lower, upper, end, 0.0, (0.0, 0.0), resolution=1.0)
    headings = np.concatenate([np.linspace(lower, upper, 2001), inside(lower, upper, 0.5)])
    x = np.cos(headings) * end[0] - np.sin(headings) * end[1]
    y = np.sin(headings) * end[0] + np.cos(headings) * end[1]
    between = np.hypot(*end) * (width / 2000) ** 2  # what two neighbouring headings may leave out
    assert (np.abs(bounds - [x.min(), y.min(), x.max(), y.max()]) <= 2.0 * MARGIN + between).all()


@given(angles, st.floats(0.0, 0.2), st.tuples(errors, errors))
def test_errors_widen_no_more_than_a_rectangle_that_turns(lower: float, width: float, error: tuple[float, float]) -> None:
    upper = lower + width
    bounds = bounds_of(lower, upper, (0.0, 0.0), 0.0, error, resolution=1.0)
    c, s = np.abs(np.cos([lower, upper])).max() + width, np.abs(np.sin([lower, upper])).max() + width
    along, across = error
    assert bounds[2] <= along * c + across * s + 2.0 * MARGIN
    assert bounds[3] <= along * s + across * c + 2.0 * MARGIN


@pytest.mark.parametrize("turns", range(-2, 5))
@pytest.mark.parametrize("end", [(3.0, 0.0), (0.0, 3.0), (-3.0, 0.0), (0.0, -3.0)])
def test_an_end_point_on_an_axis_keeps_its_extremum(turns: int, end: tuple[float, float]) -> None:
    at = 0.5 * math.pi * turns  # the farthest point along an axis is reached at a bound of the interval, or at rounding from it
    for lower, upper in [(at, at + 0.1), (at - 0.1, at), (at - 0.1, at + 0.1), (math.nextafter(at, 9.0), at + 0.1)]:
        bounds = bounds_of(lower, upper, end, 0.0, (0.0, 0.0), resolution=1.0)
        assert max(-bounds[0], -bounds[1], bounds[2], bounds[3]) >= 3.0 + MARGIN - ROUNDING


def test_the_full_circle_gives_the_square_around_the_circle() -> None:
    bounds = bounds_of(-PI_UPPER, PI_UPPER, (3.0, 4.0), 0.3, (0.1, 0.2), map_error=0.7, resolution=1.0)
    np.testing.assert_allclose(bounds, [-6.0, -6.0, 6.0, 6.0], rtol=1e-8)
    assert (np.abs(bounds) >= 6.0).all()


def test_end_points_far_outside_every_map_are_drawn_in_and_stay_outside() -> None:
    bounds = bounds_of(0.0, 0.0, (1e9, -1e9), 0.0, (0.0, 0.0))
    np.testing.assert_allclose(bounds, [REACH, -REACH, REACH, -REACH], rtol=1e-12)
    assert bounds[0] - NEAR > NEAR - 1.0
    bounds = bounds_of(0.0, 0.0, (1e9, 1e9), 0.0, (2e9, 2e9))
    np.testing.assert_allclose(bounds, [-REACH, -REACH, REACH, REACH], rtol=1e-12)
