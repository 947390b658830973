import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import ival
import mpmath
import numpy as np
import pytest

from ial.contractors.intervals import reverse_periodic
from ial.contractors.intervals.trigonometric import LARGEST_ANGLE
from tests.contractors import itf1788
from tests.contractors.oracles import EMPTY, ENTIRE, FloatArray, intervals, rows, slack, tight
from tests.contractors.solutions import COUNT, Kernel, assert_kept, assert_narrows, columns, encloses, grown, points, problems, some

PERIODIC: dict[Kernel, tuple[Callable[..., Any], Callable[..., Any]]] = {
    reverse_periodic.sin_reverse: (ival.sin, ival.sinrev),
    reverse_periodic.cos_reverse: (ival.cos, ival.cosrev),
    reverse_periodic.tan_reverse: (ival.tan, ival.tanrev),
}
QUARTERS, HALVES = ival.Interval(-math.pi / 2, math.pi / 2), ival.Interval(0.0, math.nextafter(math.pi, 4.0))
INVERSE: dict[Kernel, tuple[Callable[..., Any], Callable[..., Any]]] = {
    reverse_periodic.asin_reverse: (ival.asin, lambda c, x: ival.sin(c & QUARTERS) & x),
    reverse_periodic.acos_reverse: (ival.acos, lambda c, x: ival.cos(c & HALVES) & x),
    reverse_periodic.atan_reverse: (ival.atan, lambda c, x: ival.tan(c & QUARTERS) & x),
}


def name(kernel: Kernel) -> str:
    return kernel.__name__


def angles(seed: int) -> FloatArray:
    """Return angles near multiples of π/2, all over the range, beyond it, and others of every kind."""
    rng = np.random.default_rng(seed)
    turning = rng.integers(-63_000, 63_000, COUNT) * (math.pi / 2)
    turning = np.nextafter(turning, turning + rng.integers(-1, 2, COUNT))
    small = rng.integers(-8, 9, COUNT) * (math.pi / 2) * (1.0 + rng.integers(-3, 4, COUNT) * 2.0**-53)
    kinds = [turning, small, rng.uniform(-10.0, 10.0, COUNT), rng.uniform(-1.1, 1.1, COUNT) * LARGEST_ANGLE, points(COUNT, seed + 1)]
    return np.choose(rng.integers(0, len(kinds), COUNT), kinds)


@pytest.mark.parametrize("kernel", PERIODIC, ids=name)
def test_no_angle_is_lost(kernel: Kernel) -> None:
    c, priors, solutions = problems(PERIODIC[kernel][0], 1, angles(10))
    narrowed = columns(kernel, c, *priors)
    assert_kept(narrowed, priors, solutions, c)
    assert_narrows(narrowed, priors)


@pytest.mark.parametrize("kernel", INVERSE, ids=name)
def test_no_argument_is_lost(kernel: Kernel) -> None:
    c, priors, solutions = problems(INVERSE[kernel][0], 2, points(COUNT, 20))
    narrowed = columns(kernel, c, *priors)
    assert_kept(narrowed, priors, solutions, c)
    assert_narrows(narrowed, priors)


@pytest.mark.parametrize("kernel", PERIODIC, ids=name)
def test_angles_within_reach_are_those_of_a_problem_a_few_bits_wider_at_most(kernel: Kernel) -> None:
    # A bound of the prior may be so near to a solution that rounding cannot tell; then it stays.
    oracle = PERIODIC[kernel][1]
    near, (prior,), _ = problems(PERIODIC[kernel][0], 3, angles(30))
    unit = np.random.default_rng(33).uniform(-1.2, 1.2, (2, len(near[0])))
    count = len(near[0])
    for c, x in ((near, prior), (intervals(count, 31), intervals(count, 32)), ((unit.min(axis=0), unit.max(axis=0)), prior)):
        ours, exact, wider = rows(kernel, c, x), tight(oracle, c, x), grown(tight(oracle, grown(c), grown(x)))
        assert encloses(ours, exact)
        within = (np.abs(x[0]) <= LARGEST_ANGLE) & (np.abs(x[1]) <= LARGEST_ANGLE)
        assert within.mean() > 0.1
        assert encloses(wider, (np.where(within, ours[0], np.inf), np.where(within, ours[1], -np.inf)))
        if c is not near:
            assert (wider[0] > wider[1])[within].any()


@pytest.mark.parametrize("kernel", INVERSE, ids=name)
def test_inverse_functions_are_nearly_tight(kernel: Kernel) -> None:
    near, (prior,), _ = problems(INVERSE[kernel][0], 4, points(COUNT, 40))
    exact, ours = tight(INVERSE[kernel][1], near, prior), rows(kernel, near, prior)
    assert encloses(ours, exact)
    ordinary = (np.abs(near[0]) < 1.5707) & (np.abs(near[1]) < 1.5707) & some(exact)
    assert ordinary.sum() > 500
    assert slack(exact, ours)[ordinary].max() <= 4


def test_a_bound_out_of_reach_stays_and_the_other_one_moves() -> None:
    for kernel, zero in ((reverse_periodic.sin_reverse, math.pi), (reverse_periodic.tan_reverse, math.pi)):
        lower, upper = kernel(0.0, 0.0, -math.inf, 4.0)
        assert lower == -math.inf
        assert zero <= upper <= zero + 1e-15
        lower, upper = kernel(0.0, 0.0, 3.0, 1e300)
        assert zero - 1e-15 <= lower <= zero
        assert upper == 1e300
        assert kernel(0.0, 0.0, 1e6, 1e6 + 1e-3) == (1e6, 1e6 + 1e-3)


@pytest.mark.parametrize("kernel", [*PERIODIC, *INVERSE], ids=name)
def test_an_empty_result_or_prior_gives_the_empty_interval(kernel: Kernel) -> None:
    for other in (EMPTY, ENTIRE, (-1.0, 2.0), (0.0, 0.0), (5.0, 7.0)):
        assert kernel(*EMPTY, *other) == EMPTY == kernel(*other, *EMPTY)


def test_values_that_no_angle_has() -> None:
    for kernel in (reverse_periodic.sin_reverse, reverse_periodic.cos_reverse):
        assert kernel(1.1, 2.0, *ENTIRE) == EMPTY == kernel(-2.0, -1.1, -5.0, 5.0)
    assert reverse_periodic.sin_reverse(0.0, 0.0, 2.0, 2.5) == EMPTY
    assert reverse_periodic.asin_reverse(1.6, 2.0, *ENTIRE) == EMPTY
    assert reverse_periodic.acos_reverse(-2.0, -0.1, *ENTIRE) == EMPTY
    assert reverse_periodic.atan_reverse(math.nextafter(math.pi / 2, 2.0), 2.0, *ENTIRE) == EMPTY
    assert reverse_periodic.atan_reverse(-2.0, 2.0, *ENTIRE) == ENTIRE


# Vectors that are wider than the exact answer: line, and its exact bounds as functions of the bounds of c.
LOOSE: dict[int, Callable[..., Any]] = {
    555: lambda c: (mpmath.asin(c[0]), mpmath.pi - mpmath.asin(c[0])),
    633: lambda c: (mpmath.pi, mpmath.pi),
    642: lambda c: (mpmath.acos(c[1]), 2 * mpmath.pi - mpmath.acos(c[1])),
    643: lambda c: (mpmath.acos(c[1]) - 2 * mpmath.pi, -mpmath.acos(c[1])),
    711: lambda c: (mpmath.atan(c[0]) - mpmath.pi, mpmath.atan(c[1])),
    713: lambda c: (mpmath.atan(c[0]) - mpmath.pi, mpmath.pi + mpmath.atan(c[1])),
}


def holds_the_exact_answer(case: itf1788.Case, bounds: itf1788.Pair) -> bool:
    file, line, _ = case.source.split(":", 2)
    if file != "libieeep1788_rev.itl" or int(line) not in LOOSE:
        return False
    with mpmath.workdps(60):
        lower, upper = LOOSE[int(line)](case.inputs[0])
        return bool(bounds[0] <= lower <= upper <= bounds[1])


@pytest.mark.parametrize("kernel", PERIODIC, ids=name)
def test_itf1788_vectors_are_contained(kernel: Kernel, itf1788_folder: Path) -> None:
    operation = kernel.__name__[:3] + "Rev"
    cases = list(itf1788.cases(itf1788_folder, operation, f"{operation}Bin"))
    assert len(cases) >= 15
    for case in cases:
        c, x = (*case.inputs, ENTIRE)[:2]
        lower, upper = kernel(*c, *x)
        assert (lower <= case.result[0] and case.result[1] <= upper) or holds_the_exact_answer(case, (lower, upper)), case.source
