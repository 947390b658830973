import math
from collections.abc import Callable
from pathlib import Path

import ival
import mpmath
import numpy as np
import pytest

from ial.contractors import elementary
from ial.contractors.elementary import LARGEST_ANGLE, PI_LOWER, PI_UPPER, TWO_PI_LOWER, TWO_PI_UPPER
from tests.contractors import itf1788
from tests.contractors.oracles import EMPTY, ENTIRE, FloatArray, intervals, rows, slack, tight

COUNT = 20_000
ITF1788 = {"sin": elementary.sin, "cos": elementary.cos, "atan2": elementary.atan2}


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
            for ours, exact in zip(elementary.sincos(x), (mpmath.sin(x), mpmath.cos(x)), strict=True):
                error = abs(exact - ours)
                assert error == 0 or error < min(math.ulp(ours), 2.0**-53), x


@pytest.mark.parametrize("x", [np.nextafter(LARGEST_ANGLE, np.inf), -1e6, np.inf, np.nan])
def test_sine_and_cosine_of_a_number_out_of_range_are_nan(x: float) -> None:
    assert all(math.isnan(value) for value in elementary.sincos(x))


@pytest.mark.parametrize(("kernel", "oracle"), [(elementary.sin, ival.sin), (elementary.cos, ival.cos)])
def test_sine_and_cosine_enclose_and_are_nearly_tight(kernel: Callable[..., tuple[float, float]], oracle: Callable[..., object]) -> None:
    rng = np.random.default_rng(6)
    start = angles(COUNT // 10, 7)
    width = rng.choice([0.0, 1e-12, 1e-3, 1.0, 3.0, 6.0, 7.0], len(start)) * rng.random(len(start))
    pairs = start, np.minimum(start + width, LARGEST_ANGLE)
    wider = slack(tight(oracle, pairs), rows(kernel, pairs))
    assert wider.min() >= 0
    assert wider.max() <= 3


@pytest.mark.parametrize(("kernel", "oracle"), [(elementary.sin, ival.sin), (elementary.cos, ival.cos)])
def test_sine_and_cosine_enclose_everywhere(kernel: Callable[..., tuple[float, float]], oracle: Callable[..., object]) -> None:
    pairs = intervals(COUNT, 8)
    assert slack(tight(oracle, pairs), rows(kernel, pairs)).min() >= 0


@pytest.mark.parametrize("kernel", [elementary.sin, elementary.cos])
def test_a_wide_or_far_interval_gives_the_full_range(kernel: Callable[..., tuple[float, float]]) -> None:
    for bounds in (ENTIRE, (0.0, 6.3), (1e6, 1e6), (-1e300, 1.0), (0.0, np.inf)):
        assert kernel(*bounds) == (-1.0, 1.0)
    assert kernel(*EMPTY) == EMPTY


def test_an_extremum_inside_is_found() -> None:
    assert elementary.sin(1.5, 1.6)[1] == 1.0
    assert elementary.sin(-1.6, -1.5)[0] == -1.0
    assert elementary.cos(-0.1, 0.1)[1] == 1.0
    assert elementary.cos(3.1, 3.2)[0] == -1.0
    assert elementary.sin(0.0, 0.0) == (0.0, 0.0)


def test_pyinterval_agrees_on_sine_and_cosine() -> None:
    pytest.importorskip("interval", reason="pyinterval is not installed; it needs a C compiler")
    from interval import imath, interval

    for x in angles(300, 9).tolist():
        for kernel, theirs in ((elementary.sin, imath.sin), (elementary.cos, imath.cos)):
            lower, upper = kernel(x, x)
            ((low, high),) = theirs(interval[x, x])
            assert lower <= low <= high <= upper, x


def test_angles_of_boxes_enclose_and_are_nearly_tight() -> None:
    y, x = intervals(COUNT, 10), intervals(COUNT, 11)
    wider = slack(tight(ival.atan2, y, x), rows(elementary.atan2, y, x))
    assert wider.min() >= 0
    assert wider.max() <= 4


def test_lengths_enclose_and_are_nearly_tight_where_squares_are_ordinary() -> None:
    a, b = intervals(COUNT, 12), intervals(COUNT, 13)
    exact, ours = tight(ival.hypot, a, b), rows(elementary.hypot, a, b)
    wider = slack(exact, ours)
    assert wider.min() >= 0
    ordinary = np.all([(np.abs(bound) == 0) | ((np.abs(bound) > 1e-150) & (np.abs(bound) < 1e150)) for bound in (*a, *b)], axis=0)
    assert ordinary.sum() > 1000
    assert wider[ordinary].max() <= 2


@pytest.mark.parametrize("operation", ITF1788)
def test_itf1788_vectors_are_contained(operation: str, itf1788_folder: Path) -> None:
    cases = list(itf1788.cases(itf1788_folder, operation))
    assert len(cases) >= 50
    for case in cases:
        lower, upper = ITF1788[operation](*(bound for pair in case.inputs for bound in pair))
        assert lower <= case.result[0], case.source
        assert case.result[1] <= upper, case.source
