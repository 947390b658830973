import math

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.contractors.intervals.angle import contains_angle, direction, intersect_angle, shift_angle, wrap_angle
from ial.contractors.intervals.trigonometric import PI_UPPER, TWO_PI_LOWER
from tests.cases import cases
from tests.contractors.oracles import EMPTY, ENTIRE

CIRCLE = (-PI_UPPER, PI_UPPER)
ANGLES = st.floats(-1e4, 1e4) | st.integers(-3000, 3000).map(lambda k: k * math.pi)
WIDTHS = st.floats(0, 6.28) | st.floats(0, 1e-12) | st.just(0.0)


@given(ANGLES, WIDTHS)
def test_wrapping_moves_by_whole_turns_and_loses_nothing(lower: float, width: float) -> None:
    upper = lower + width
    low, high = wrap_angle(lower, upper)
    assert -PI_UPPER <= low <= PI_UPPER
    assert low <= high
    with mpmath.workdps(60):
        turns = mpmath.nint((mpmath.mpf(low) - lower) / (2 * mpmath.pi))
        shift = turns * 2 * mpmath.pi
        assert low <= lower + shift
        assert upper + shift <= high
        assert (high - low) - (mpmath.mpf(upper) - lower) <= 1e-15 * (4 + abs(lower) + abs(upper))


@given(ANGLES, WIDTHS)
def test_wrapping_twice_changes_nothing(lower: float, width: float) -> None:
    once = wrap_angle(lower, lower + width)
    assert wrap_angle(*once) == once


@pytest.mark.parametrize(
    "bounds", [(0.0, 2.0 * PI_UPPER), (0.0, TWO_PI_LOWER), ENTIRE, CIRCLE, (-100.0, 100.0), (1e300, 1e300), (0.0, math.nan)]
)
def test_a_turn_or_more_is_exactly_the_full_circle(bounds: tuple[float, float]) -> None:
    assert wrap_angle(*bounds) == CIRCLE


@pytest.mark.parametrize("bounds", [(0.0, 1.0), (-PI_UPPER, 3.0), (PI_UPPER, 4.0), (3.0, 9.0), (-0.0, 0.0)])
def test_an_interval_in_range_is_unchanged(bounds: tuple[float, float]) -> None:
    assert wrap_angle(*bounds) == bounds


def test_wrapping_the_empty_interval_leaves_it_empty() -> None:
    assert wrap_angle(*EMPTY) == EMPTY


@given(st.floats(-4, 4), WIDTHS, st.floats(0, 1), st.integers(-1000, 1000))
def test_an_angle_inside_is_contained_after_any_number_of_turns(lower: float, width: float, part: float, turns: int) -> None:
    upper = lower + width
    inside = min(upper, lower + part * (upper - lower))
    for angle in shift_angle(inside, inside, float(turns)):
        wide = (lower - 1e-12, upper + 1e-12)  # the shifted angle is a double, so it is off by a little
        assert contains_angle(*wide, angle)
    assert contains_angle(lower, upper, inside)


@given(st.floats(-4, 4), st.floats(0, 6.2), st.floats(0.01, 0.99), st.integers(-1000, 1000))
def test_an_angle_in_the_gap_is_not_contained(lower: float, width: float, part: float, turns: int) -> None:
    upper = lower + width
    outside = upper + part * (2 * math.pi - width)
    assert not contains_angle(lower, upper, outside + turns * 2 * math.pi)


def test_containing_no_angle_and_every_angle() -> None:
    assert not contains_angle(*EMPTY, 0.0)
    assert contains_angle(*CIRCLE, 1e6)
    assert contains_angle(math.pi - 0.1, math.pi + 0.1, -math.pi)


def test_congruent_numbers_are_never_lost() -> None:
    rng = np.random.default_rng(1)
    with mpmath.workdps(60):
        for _ in range(cases(3000, 100)):
            number = rng.uniform(-20, 20)
            exact = mpmath.mpf(number) - int(rng.integers(-4, 5)) * 2 * mpmath.pi
            low = math.nextafter(float(exact) - rng.choice([0, 1e-3, 1, 3]), -math.inf)
            high = math.nextafter(float(exact) + rng.choice([0, 1e-3, 1, 3]), math.inf)
            lower, upper = number - rng.choice([0, 1e-9, 1, 30]), number + rng.choice([0, 1e-9, 1, 30])
            new_lower, new_upper = intersect_angle(lower, upper, low, high)
            assert lower <= new_lower <= number <= new_upper <= upper


def test_congruent_numbers_are_found_as_a_slow_search_finds_them() -> None:
    rng = np.random.default_rng(2)
    for _ in range(cases(2000, 100)):
        lower, low = rng.uniform(-20, 20, 2)
        upper, high = lower + rng.choice([0.1, 3, 20]), low + rng.uniform(0, 6)
        copies = [(low + k * 2 * math.pi, high + k * 2 * math.pi) for k in range(-15, 16)]
        parts = [(max(lower, a), min(upper, b)) for a, b in copies if a <= upper and lower <= b]
        expected = (min(a for a, _ in parts), max(b for _, b in parts)) if parts else EMPTY
        assert intersect_angle(lower, upper, low, high) == pytest.approx(expected, abs=1e-12)


def test_congruence_with_any_angle_or_none_or_beyond_the_range() -> None:
    assert intersect_angle(1.0, 2.0, *CIRCLE) == (1.0, 2.0)
    assert intersect_angle(1.0, 2.0, *EMPTY) == EMPTY
    assert intersect_angle(*EMPTY, 0.0, 1.0) == EMPTY
    assert intersect_angle(*ENTIRE, 0.0, 1.0) == ENTIRE
    assert intersect_angle(0.0, 1e6, 0.0, 1.0) == (0.0, 1e6)


def test_directions_cross_the_cut() -> None:
    assert direction(-1.0, 1.0, -1.0, -1.0) == pytest.approx((0.75 * math.pi, 1.25 * math.pi))
    assert direction(-1.0, 0.0, -1.0, -1.0) == pytest.approx((math.pi, 1.25 * math.pi))
    low, high = direction(-1.0, 1.0, -1.0, 1.0)
    assert high - low >= TWO_PI_LOWER
    assert direction(0.0, 0.0, 0.0, 0.0) == EMPTY


def test_directions_of_points_of_a_box_are_never_lost() -> None:
    rng = np.random.default_rng(3)
    bounds = np.sort(rng.choice([0.0, -0.0, 1.0, -1.0, 2.0, -3.0, 1e-300, 0.5], size=(cases(3000, 100), 2, 2)), axis=2)
    for (yl, yu), (xl, xu) in bounds.tolist():
        for y, x in ((yl, xl), (yl, xu), (yu, xl), (yu, xu), (0.5 * (yl + yu), 0.5 * (xl + xu))):
            if x or y:
                assert contains_angle(*direction(yl, yu, xl, xu), math.atan2(y + 0.0, x + 0.0))


def test_the_angle_of_a_corner_is_enclosed_exactly_across_the_cut_too() -> None:
    random = np.random.default_rng(4)
    with mpmath.workdps(40):
        for _ in range(cases(2000, 100)):
            yl, yu, xl, xu = *sorted(random.uniform(-1.0, 1.0, 2).tolist()), *sorted(random.uniform(-1.0, 0.3, 2).tolist())
            low, high = direction(yl, yu, xl, xu)
            crosses = yl < 0.0 <= yu and xl < 0.0
            if crosses and xu >= 0.0:
                continue
            for y in (yl, yu):
                for x in (xl, xu):
                    angle = mpmath.atan2(y, x)
                    assert low <= (angle + 2 * mpmath.pi if crosses and angle < 0 else angle) <= high
