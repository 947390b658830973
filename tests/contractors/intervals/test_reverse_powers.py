import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import ival
import mpmath
import numpy as np
import pytest

from ial.contractors.intervals import reverse_powers
from tests.cases import cases
from tests.contractors import itf1788
from tests.contractors.oracles import EMPTY, ENTIRE, Pairs, intervals, rows, slack, tight
from tests.contractors.solutions import COUNT, assert_kept, assert_narrows, columns, encloses, grown, points, problems, some

EXPONENTS = (-1023, -8, -7, -3, -2, -1, 0, 1, 2, 3, 4, 7, 8, 10, 1000)


def with_exponent(kernel: Any, n: int, *operands: Pairs) -> Pairs:
    return rows(lambda *bounds: kernel(*bounds, n), *operands)


@pytest.mark.parametrize("n", EXPONENTS)
def test_no_base_of_an_integer_power_is_lost(n: int) -> None:
    c, priors, solutions = problems(lambda x: ival.pown(x, n), 1, points(1000, n + 2000, 3.0))
    narrowed = columns(lambda *bounds: reverse_powers.pown_reverse(*bounds, n), c, *priors)
    assert_kept(narrowed, priors, solutions, c)


@pytest.mark.parametrize("n", [n for n in EXPONENTS if n])
def test_no_radicand_is_lost(n: int) -> None:
    c, priors, solutions = problems(lambda x: ival.rootn(x, n), 2, points(1000, n + 3000, 3.0))
    narrowed = columns(lambda *bounds: reverse_powers.rootn_reverse(*bounds, n), c, *priors)
    assert_kept(narrowed, priors, solutions, c)
    assert_narrows(narrowed, priors)


@pytest.mark.many
@pytest.mark.parametrize("n", EXPONENTS)
def test_bases_of_integer_powers_are_nearly_tight(n: int) -> None:
    near, (prior,), _ = problems(lambda x: ival.pown(x, n), 3, points(1000, n + 4000, 3.0))
    for c, x in ((near, prior), (intervals(1000, 31), intervals(1000, 32))):
        exact, ours = tight(lambda c, x: ival.pownrev(c, n, x), c, x), with_exponent(reverse_powers.pown_reverse, n, c, x)
        assert encloses(ours, exact)
        # A bound of the prior may be so near to a solution that rounding cannot tell; then it stays.
        assert encloses(grown(tight(lambda c, x: ival.pownrev(c, n, x), grown(c, 2), grown(x, 2)), 2), ours)
        if -1 <= n <= 2:
            assert np.array_equal(ours, exact)


def power_problems(seed: int) -> Any:
    rng = np.random.default_rng(seed)
    base = np.where(rng.random(COUNT) < 0.5, np.exp(rng.normal(size=COUNT)), np.abs(points(COUNT, seed + 1, 3.0)))
    exponent = np.where(rng.random(COUNT) < 0.2, rng.integers(-3, 4, COUNT), points(COUNT, seed + 2, 5.0))
    return problems(ival.pow, seed + 3, base, exponent)


def test_no_base_or_exponent_is_lost() -> None:
    r, priors, solutions = power_problems(4)
    narrowed = columns(reverse_powers.pow_backward, r, *priors)
    assert_kept(narrowed, priors, solutions, r)
    assert_narrows(narrowed, priors)
    (a, b) = priors
    assert np.array_equal(rows(reverse_powers.pow_reverse_base, b, r, a), narrowed[0])
    assert np.array_equal(rows(reverse_powers.pow_reverse_exponent, a, r, b), narrowed[1])


def test_powers_reversed_enclose_everywhere_and_are_nearly_tight_where_numbers_are_ordinary() -> None:
    near, (a, b), _ = power_problems(6)
    low = np.sort(np.random.default_rng(5).uniform(0.1, 10.0, (3, COUNT, 2)), axis=2)
    ordinary = tuple((pair[:, 0], pair[:, 1]) for pair in low)
    for r, base, exponent in ((near, a, b), tuple(intervals(COUNT, seed) for seed in (51, 52, 53)), ordinary):
        for kernel, oracle, given, prior in (
            (reverse_powers.pow_reverse_base, ival.powrev1, exponent, base),
            (reverse_powers.pow_reverse_exponent, ival.powrev2, base, exponent),
        ):
            exact, ours = tight(oracle, given, r, prior), rows(kernel, given, r, prior)
            assert encloses(ours, exact)
            if r is ordinary[0]:
                assert some(exact).sum() > cases(1000, 20)
                assert slack(exact, ours)[some(exact)].max() <= 5
                assert (some(ours) == some(exact)).mean() > 0.99


# Vectors that are wider than the exact answer, and its bounds. [0, 5e-324] is x^-7 for the x from the seventh root of 2^1074 on; for a from
# 1/4 to 1/2, or to 1, a^x >= 2 holds up to log 2 / log(1/4).
LOOSE: dict[tuple[str, int], Callable[[], tuple[Any, Any]]] = {
    ("libieeep1788_rev.itl", 276): lambda: (mpmath.mpf(2) ** (mpmath.mpf(1074) / 7), mpmath.inf),
    ("libieeep1788_rev.itl", 277): lambda: (-mpmath.inf, -(mpmath.mpf(2) ** (mpmath.mpf(1074) / 7))),
    ("pow_rev.itl", 609): lambda: (-mpmath.inf, mpmath.log(2) / mpmath.log(0.25)),
    ("pow_rev.itl", 642): lambda: (-mpmath.inf, mpmath.log(2) / mpmath.log(0.25)),
}


def assert_contained(case: itf1788.Case, lower: float, upper: float) -> None:
    file, line, _ = case.source.split(":", 2)
    with mpmath.workdps(60):
        low, high = LOOSE.get((file, int(line)), lambda: case.result)()
        assert lower <= low <= high <= upper or (low, high) == EMPTY, case.source


def test_itf1788_vectors_of_integer_powers_are_contained(itf1788_folder: Path) -> None:
    cases = list(itf1788.cases(itf1788_folder, "pownRev", "pownRevBin"))
    assert len(cases) >= 150
    for case in cases:
        c, x, n = case.inputs if len(case.inputs) == 3 else (case.inputs[0], ENTIRE, case.inputs[1])
        assert_contained(case, *reverse_powers.pown_reverse(*c, *x, int(n)))


@pytest.mark.parametrize(
    ("operation", "kernel", "at_least"),
    [("powRev1", reverse_powers.pow_reverse_base, 400), ("powRev2", reverse_powers.pow_reverse_exponent, 300)],
)
def test_itf1788_vectors_of_powers_are_contained(operation: str, kernel: Any, at_least: int, itf1788_folder: Path) -> None:
    cases = list(itf1788.cases(itf1788_folder, operation))
    assert len(cases) >= at_least
    for case in cases:
        assert_contained(case, *kernel(*(bound for pair in case.inputs for bound in pair)))


@pytest.mark.parametrize("n", EXPONENTS)
def test_an_empty_result_or_prior_gives_the_empty_interval(n: int) -> None:
    for kernel in (reverse_powers.pown_reverse, reverse_powers.rootn_reverse):
        for other in (EMPTY, ENTIRE, (-1.0, 2.0), (0.0, 0.0)):
            assert kernel(*EMPTY, *other, n) == EMPTY == kernel(*other, *EMPTY, n)


def test_one_empty_operand_of_a_power_empties_both() -> None:
    for at in range(3):
        for other in (ENTIRE, (-1.0, 2.0), (0.0, 0.0), (1.0, 1.0), EMPTY):
            operands = [EMPTY if i == at else other for i in range(3)]
            assert reverse_powers.pow_backward(*(bound for pair in operands for bound in pair)) == (*EMPTY, *EMPTY)


def test_powers_where_they_are_defined() -> None:
    assert reverse_powers.pow_reverse_base(0.0, 0.0, 1.0, 1.0, -1.0, 0.0) == EMPTY  # 0^0 is undefined
    assert reverse_powers.pow_reverse_base(0.0, 0.0, 1.0, 1.0, -1.0, 3.0) == (0.0, 3.0)
    assert reverse_powers.pow_reverse_base(2.0, 2.0, 4.0, 9.0, *ENTIRE) == (2.0, 3.0)
    assert reverse_powers.pow_reverse_exponent(2.0, 2.0, 4.0, 8.0, *ENTIRE) == (2.0, 3.0)
    assert reverse_powers.pow_reverse_exponent(0.0, 0.0, 0.0, 0.0, *ENTIRE) == (0.0, math.inf)
    assert reverse_powers.rootn_reverse(-2.0, 3.0, *ENTIRE, 2) == (0.0, 9.0)
    assert reverse_powers.pown_reverse(1.0, 4.0, -5.0, 0.5, 2) == (-2.0, -1.0)
