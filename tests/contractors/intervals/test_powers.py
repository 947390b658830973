import math
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest

from ial.contractors.intervals import powers
from tests.contractors import itf1788
from tests.contractors.oracles import (
    EMPTY,
    ENTIRE,
    EXPONENTS,
    LARGEST,
    TINY,
    WITH_EXPONENT,
    hard_intervals,
    intervals,
    numbers,
    slack,
    tight,
    wider,
)

COUNT = 10_000


def results(kernel: Any, operand: Any, exponent: int) -> Any:
    bounds = np.array([kernel(lower, upper, exponent) for lower, upper in zip(*(bound.tolist() for bound in operand), strict=True)])
    return bounds[:, 0], bounds[:, 1]


@pytest.mark.parametrize("exponent", EXPONENTS)
@pytest.mark.parametrize("kernel", WITH_EXPONENT)
def test_powers_and_roots_enclose_and_are_nearly_tight(kernel: Any, exponent: int) -> None:
    oracle = WITH_EXPONENT[kernel]
    for operand in (intervals(COUNT // 8, 1), hard_intervals(COUNT // 8, 2)):
        exact = tight(lambda a: oracle.function(a, exponent), operand)
        if kernel is powers.rootn and exponent < 0 and exponent % 2 == 0:
            exact = tuple(np.where(operand[1] <= 0.0, end, bound) for end, bound in zip(EMPTY, exact, strict=True))  # theirs is [inf, inf]
        beyond = slack(exact, results(kernel, operand, exponent))
        assert beyond.min() >= 0
        assert beyond.max() <= oracle.wider


def test_powers_enclose_and_are_nearly_tight() -> None:
    rng = np.random.default_rng(3)
    base = np.abs(np.concatenate([numbers(COUNT, 4), rng.uniform(0.0, 3.0, COUNT)]))
    with np.errstate(divide="ignore", invalid="ignore"):
        exponent = np.nan_to_num(rng.uniform(-760.0, 720.0, 2 * COUNT) / np.log(base), nan=0.5, posinf=0.5, neginf=0.5)
    for a, b in (
        (intervals(COUNT, 5), intervals(COUNT, 6)),
        (hard_intervals(COUNT, 7), hard_intervals(COUNT, 8)),
        ((base, base), (exponent, exponent)),
    ):
        beyond = wider(powers.pow, a, b)
        assert beyond.min() >= 0
        assert beyond.max() <= 2


@pytest.mark.parametrize("exponent", [1, 2, 3, 5, 7, 30, 101, 1000, 2**20 + 1, -1, -3, -64, -999])
def test_powers_as_two_doubles_have_the_error_they_state(exponent: int) -> None:
    """The bound matters only where a power lies within 2^-100 of a double, which no test would find; so the number itself is compared."""
    worst = 0.0
    for x in np.random.default_rng(10).uniform(0.5, 2.0, 60).tolist():
        high, low, k, error = powers._power(x, exponent)
        with mpmath.workprec(400):
            exact = mpmath.mpf(x) ** exponent * mpmath.mpf(2) ** int(-k)
            wrong = abs((mpmath.mpf(high) + low) / exact - 1)
        assert wrong <= error
        worst = max(worst, float(wrong / error) if error else 0.0)
    assert worst > 2e-3 or abs(exponent) <= 2


@pytest.mark.parametrize(("operation", "kernel", "at_least"), [("pow", powers.pow, 1300), ("pown", powers.pown, 150)])
def test_itf1788_vectors_are_contained(operation: str, kernel: Any, at_least: int, itf1788_folder: Path) -> None:
    def called(*inputs: float) -> itf1788.Pair:
        return kernel(*inputs) if operation == "pow" else kernel(*inputs[:2], int(inputs[2]))

    assert len(list(itf1788.cases(itf1788_folder, operation))) >= at_least
    assert not itf1788.missed(itf1788_folder, operation, called, tight=False)


@pytest.mark.parametrize("exponent", [2**40 + 1, 2**53 + 1, 2**63 - 1, -(2**50), -(2**63)])
def test_huge_exponents_lose_nothing(exponent: int) -> None:
    rng = np.random.default_rng(9)
    near = 1.0 + rng.uniform(-1.0, 1.0, 100) * 2.0 ** -rng.uniform(20.0, 53.0, 100)
    with mpmath.workdps(120):
        for x in (*near.tolist(), 0.1, 3.0, TINY, LARGEST):
            lower, upper = powers.pown(x, x, exponent)
            assert lower <= mpmath.mpf(x) ** exponent <= upper
            lower, upper = powers.rootn(x, x, exponent)
            assert lower <= mpmath.mpf(x) ** (mpmath.mpf(1) / exponent) <= upper


def test_powers_that_are_doubles_are_exact() -> None:
    for x in range(-40, 41):
        for n in range(11):
            if abs(x**n) < 2**53:
                assert powers.pown(float(x), float(x), n) == (x**n, x**n)
            if x > 1 and n >= 2 and x**n < 2**53:
                assert powers.rootn(float(x**n), float(x**n), n) == (x, x)
                assert powers.pow(float(x), float(x), float(n), float(n)) == (x**n, x**n)
    for k in (-1074, -1022, -3, 0, 5, 1023):
        assert powers.pown(2.0, 2.0, k) == (2.0**k, 2.0**k) == powers.pow(2.0, 2.0, float(k), float(k))


@pytest.mark.parametrize(
    ("operands", "result"),
    [
        ((*EMPTY, 3), EMPTY),
        ((*ENTIRE, 0), (1.0, 1.0)),
        ((0.0, 0.0, 0), (1.0, 1.0)),
        ((0.0, 0.0, -1), EMPTY),
        ((0.0, 0.0, -2), EMPTY),
        ((-1.0, 2.0, -3), ENTIRE),
        ((-1.0, 2.0, -2), (0.25, math.inf)),
        ((-2.0, 0.0, -3), (-math.inf, -0.125)),
        ((0.0, 2.0, -3), (0.125, math.inf)),
        ((-2.0, 3.0, 4), (0.0, 81.0)),
        ((-math.inf, 2.0, 3), (-math.inf, 8.0)),
    ],
)
def test_integer_powers_at_zero_and_infinity(operands: tuple[float, ...], result: itf1788.Pair) -> None:
    assert powers.pown(*operands) == result


@pytest.mark.parametrize(
    ("operands", "result"),
    [
        ((*EMPTY, 3), EMPTY),
        ((1.0, 2.0, 0), EMPTY),
        ((-8.0, 27.0, 3), (-2.0, 3.0)),
        ((-8.0, 16.0, 4), (0.0, 2.0)),
        ((-8.0, -1.0, 4), EMPTY),
        ((-8.0, 0.0, -2), EMPTY),
        ((-8.0, 0.0, -3), (-math.inf, -0.5)),
        ((-1.0, 8.0, -3), ENTIRE),
        ((0.0, math.inf, 5), (0.0, math.inf)),
    ],
)
def test_roots_at_zero_and_infinity(operands: tuple[float, ...], result: itf1788.Pair) -> None:
    assert powers.rootn(*operands) == result


def test_a_negative_zero_is_zero() -> None:
    assert powers.pow(-0.0, 2.0, -1.0, 1.0) == (0.0, math.inf)
    assert powers.pown(-0.0, 2.0, -3) == (0.125, math.inf)
