import math
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest

from ial.contractors.intervals import trigonometric
from ial.contractors.intervals.trigonometric import (
    HALF_PI_LOWER,
    HALF_PI_UPPER,
    LARGEST_ANGLE,
    PI_LOWER,
    PI_UPPER,
    TWO_PI_LOWER,
    TWO_PI_UPPER,
)
from tests.contractors import itf1788
from tests.contractors.oracles import EMPTY, ENTIRE, LARGEST, ORACLES, TINY, FloatArray, hard_intervals, intervals, kernels_of, wider

COUNT = 10_000
KERNELS = kernels_of(trigonometric)
PERIODIC = [trigonometric.sin, trigonometric.cos, trigonometric.tan]


def near_quarter_turns(count: int, seed: int) -> FloatArray:
    """Return doubles next to multiples of π/2 and of π/4, where reduction loses most digits."""
    eighths = np.random.default_rng(seed).integers(-127_000, 127_000, count)
    with mpmath.workdps(40):
        nearest = np.array([float(int(k) * mpmath.pi / 4) for k in eighths])
    return np.concatenate([nearest, np.nextafter(nearest, np.inf), np.nextafter(nearest, -np.inf)])


def angles(count: int, seed: int) -> FloatArray:
    rng = np.random.default_rng(seed)
    tiny = 10.0 ** rng.uniform(-320, 0, count)
    return np.concatenate([rng.uniform(-10, 10, count), rng.uniform(-1e5, 1e5, count), tiny, -tiny, near_quarter_turns(count, seed)])


def test_constants_enclose_pi() -> None:
    with mpmath.workdps(40):
        assert PI_LOWER < mpmath.pi < PI_UPPER
        assert TWO_PI_LOWER < 2 * mpmath.pi < TWO_PI_UPPER
    assert math.nextafter(PI_LOWER, 4.0) == PI_UPPER
    assert math.nextafter(TWO_PI_LOWER, 7.0) == TWO_PI_UPPER


def test_sine_and_cosine_of_a_number_are_right_within_one_unit_in_the_last_place() -> None:
    points = [0.0, -0.0, LARGEST_ANGLE, -LARGEST_ANGLE, *angles(1000, 5).tolist()]
    with mpmath.workdps(60):
        for x in points:
            for ours, exact in zip(trigonometric.sincos(x), (mpmath.sin(x), mpmath.cos(x)), strict=True):
                error = abs(exact - ours)
                assert error == 0 or error < min(math.ulp(ours), 2.0**-53), x


@pytest.mark.parametrize("x", [np.nextafter(LARGEST_ANGLE, np.inf), -1e6, np.inf, np.nan])
def test_sine_and_cosine_of_a_number_out_of_range_are_nan(x: float) -> None:
    assert all(math.isnan(value) for value in trigonometric.sincos(x))


@pytest.mark.parametrize("kernel", PERIODIC)
def test_periodic_functions_enclose_and_are_nearly_tight(kernel: Any) -> None:
    rng = np.random.default_rng(6)
    start = angles(COUNT // 4, 7)
    width = rng.choice([0.0, 1e-12, 1e-3, 1.0, 3.0, 6.0, 7.0], len(start)) * rng.random(len(start))
    beyond = wider(kernel, (start, np.minimum(start + width, LARGEST_ANGLE)))
    assert beyond.min() >= 0
    assert beyond.max() <= ORACLES[kernel].wider


@pytest.mark.parametrize("kernel", KERNELS)
def test_functions_enclose_everywhere_and_the_others_are_nearly_tight(kernel: Any) -> None:
    for make, seed in ((intervals, 8), (hard_intervals, 10)):
        beyond = wider(kernel, *(make(COUNT, seed + k) for k in range(ORACLES[kernel].operands)))
        assert beyond.min() >= 0
        assert kernel in PERIODIC or beyond.max() <= ORACLES[kernel].wider


@pytest.mark.parametrize("kernel", [trigonometric.sin, trigonometric.cos])
def test_a_wide_or_far_interval_gives_the_full_range(kernel: Any) -> None:
    for bounds in (ENTIRE, (0.0, 6.3), (1e6, 1e6), (-1e300, 1.0), (0.0, np.inf)):
        assert kernel(*bounds) == (-1.0, 1.0)


@pytest.mark.parametrize("bounds", [ENTIRE, (1.0, 2.0), (-2.0, -1.0), (0.0, 4.0), (1e6, 1e6), (-1e300, 1.0), (1.0, np.inf)])
def test_the_tangent_around_a_pole_or_far_out_is_the_real_line(bounds: itf1788.Pair) -> None:
    assert trigonometric.tan(*bounds) == ENTIRE


def test_the_tangent_beside_a_pole_is_bounded() -> None:
    below, above = trigonometric.tan(HALF_PI_LOWER, HALF_PI_LOWER), trigonometric.tan(HALF_PI_UPPER, HALF_PI_UPPER)
    assert 1.6e16 < below[0] <= below[1] < 1.7e16
    assert -1.7e16 < above[0] <= above[1] < -1.6e16 / 3
    assert trigonometric.tan(HALF_PI_LOWER, HALF_PI_UPPER) == ENTIRE


@pytest.mark.parametrize("kernel", KERNELS)
def test_an_empty_operand_gives_the_empty_interval(kernel: Any) -> None:
    assert kernel(*EMPTY, *([1.0, 2.0] * (ORACLES[kernel].operands - 1))) == EMPTY
    assert kernel(*([1.0, 2.0] * (ORACLES[kernel].operands - 1)), *EMPTY) == EMPTY


def test_an_extremum_inside_is_found() -> None:
    assert trigonometric.sin(1.5, 1.6)[1] == 1.0
    assert trigonometric.sin(-1.6, -1.5)[0] == -1.0
    assert trigonometric.cos(-0.1, 0.1)[1] == 1.0
    assert trigonometric.cos(3.1, 3.2)[0] == -1.0


@pytest.mark.parametrize(
    ("kernel", "operand", "result"),
    [
        (trigonometric.sin, (0.0, 0.0), (0.0, 0.0)),
        (trigonometric.tan, (-0.0, 0.0), (0.0, 0.0)),
        (trigonometric.tan, (TINY, TINY), (TINY, 2 * TINY)),
        (trigonometric.asin, (0.0, 0.0), (0.0, 0.0)),
        (trigonometric.asin, (1.0, 2.0), (HALF_PI_LOWER, HALF_PI_UPPER)),
        (trigonometric.asin, ENTIRE, (-HALF_PI_UPPER, HALF_PI_UPPER)),
        (trigonometric.asin, (1.1, 2.0), EMPTY),
        (trigonometric.acos, (1.0, 1.0), (0.0, 0.0)),
        (trigonometric.acos, (0.0, 0.0), (HALF_PI_LOWER, HALF_PI_UPPER)),
        (trigonometric.acos, (-2.0, -1.0), (PI_LOWER, PI_UPPER)),
        (trigonometric.acos, ENTIRE, (0.0, PI_UPPER)),
        (trigonometric.acos, (-2.0, -1.1), EMPTY),
        (trigonometric.atan, (0.0, 0.0), (0.0, 0.0)),
        (trigonometric.atan, ENTIRE, (-HALF_PI_UPPER, HALF_PI_UPPER)),
    ],
)
def test_exact_values_and_domains(kernel: Any, operand: itf1788.Pair, result: itf1788.Pair) -> None:
    assert kernel(*operand) == result


@pytest.mark.parametrize(("name", "scale"), [("sin", 30.0), ("cos", 30.0), ("tan", 30.0), ("asin", 1.0), ("acos", 1.0), ("atan", 30.0)])
def test_values_are_right_by_exact_arithmetic_too(name: str, scale: float) -> None:
    rng = np.random.default_rng(9)
    with mpmath.workdps(50):
        for x in (scale * rng.uniform(-1.0, 1.0, 1000) * 10.0 ** rng.choice([0, 0, -3, -9], 1000)).tolist():
            lower, upper = getattr(trigonometric, name)(x, x)
            assert lower <= getattr(mpmath, name)(x) <= upper, x


def test_pyinterval_agrees() -> None:
    pytest.importorskip("interval", reason="pyinterval is not installed; it needs a C compiler")
    from interval import imath, interval

    for x in angles(300, 9).tolist():
        for name in ("sin", "cos", "atan"):
            lower, upper = getattr(trigonometric, name)(x, x)
            ((low, high),) = getattr(imath, name)(interval[x, x])
            assert lower <= low <= high <= upper, (name, x)


def test_lengths_that_are_doubles_are_exact() -> None:
    for k in (-700, -480, -300, 0, 300, 480, 1000):
        unit = 2.0**k
        assert trigonometric.hypot(-3 * unit, -3 * unit, 4 * unit, 4 * unit) == (5 * unit, 5 * unit)
        assert trigonometric.hypot(0.0, 0.0, 0.1 * unit, 0.1 * unit) == (0.1 * unit, 0.1 * unit)
    assert trigonometric.hypot(1.0, 1.0, TINY, TINY) == (1.0, math.nextafter(1.0, 2.0))
    for large, small in ((2.0**-448, TINY), (2.0**255, 2.0**-443)):  # their squares are in range, but not what they add to the root
        assert trigonometric.hypot(large, large, small, small) == (large, math.nextafter(large, math.inf))
    assert trigonometric.hypot(LARGEST, LARGEST, LARGEST, LARGEST) == (LARGEST, math.inf)
    assert trigonometric.hypot(*ENTIRE, 2.0, 3.0) == (2.0, math.inf)


@pytest.mark.parametrize("kernel", [kernel for kernel in KERNELS if kernel is not trigonometric.hypot])
def test_itf1788_vectors_are_contained(kernel: Any, itf1788_folder: Path) -> None:
    assert len(list(itf1788.cases(itf1788_folder, kernel.__name__))) >= 10
    assert not itf1788.missed(itf1788_folder, kernel.__name__, kernel, tight=False)


@pytest.mark.parametrize(("wave", "phase"), [(trigonometric.sin, 1), (trigonometric.cos, 0)])
def test_an_interval_around_an_extremum_reaches_it_however_near_its_bounds_are(wave: Any, phase: int) -> None:
    """The bounds of the extremum itself are doubles beside it; then they move away from it, one after the other."""
    for turns in (*range(-9, 10), 1001, -1000, 31_800, -31_801):
        with mpmath.workdps(40):
            at = (turns + mpmath.mpf(phase) / 2) * mpmath.pi
            below, above = float(at), float(at)
            below, above = (math.nextafter(below, -math.inf), above) if below > at else (below, math.nextafter(above, math.inf))
        for before in (0.0, *(2.0**-k for k in range(5, 40))):
            for beyond in (0.0, 1e-7, before):
                low, high = wave(below - before, above + beyond)
                assert low == -1.0 if turns % 2 else high == 1.0
