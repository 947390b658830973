import math
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.contractors.intervals import arithmetic
from tests.contractors import itf1788
from tests.contractors.oracles import EMPTY, ENTIRE, LARGEST, ORACLES, SPECIAL, TINY, Pairs, intervals, kernels_of, numbers, rows, tight

COUNT = 10_000
KERNELS = kernels_of(arithmetic)
ITF1788 = {
    "add": arithmetic.add,
    "sub": arithmetic.sub,
    "mul": arithmetic.mul,
    "div": arithmetic.div,
    "recip": arithmetic.recip,
    "neg": arithmetic.neg,
    "sqr": arithmetic.sqr,
    "sqrt": arithmetic.sqrt,
    "abs": arithmetic.absolute,
    "min": arithmetic.minimum,
    "max": arithmetic.maximum,
    "fma": arithmetic.multiply_add,
    "cancelMinus": arithmetic.cancel_minus,
    "cancelPlus": arithmetic.cancel_plus,
    "mulRevToPair": lambda bl, bu, al, au: arithmetic.div_pieces(al, au, bl, bu),
}


def same(ours: Pairs, theirs: Pairs, operands: tuple[Pairs, ...]) -> None:
    wrong = np.flatnonzero((ours[0] != theirs[0]) | (ours[1] != theirs[1]))
    shown = [[(a[0][i], a[1][i]) for a in (*operands, ours, theirs)] for i in wrong[:5]]
    assert not len(wrong), f"{len(wrong)} differ: operands, ours, theirs: {shown}"


def agrees(kernel: Any, *operands: Pairs) -> None:
    same(rows(kernel, *operands), tight(ORACLES[kernel].function, *operands), operands)


@pytest.mark.parametrize("kernel", KERNELS)
def test_operations_are_tight(kernel: Any) -> None:
    agrees(kernel, *(intervals(COUNT, seed) for seed in range(1, 1 + ORACLES[kernel].operands)))


def test_a_product_plus_what_nearly_cancels_it_is_tight() -> None:
    a, b = numbers(COUNT, 4), numbers(COUNT, 5)
    with np.errstate(over="ignore"):
        c = np.nextafter(-(a * b), np.random.default_rng(6).choice([-np.inf, 0.0, np.inf], COUNT))
    finite = np.abs(c) < np.inf
    agrees(arithmetic.multiply_add, *((x[finite], x[finite]) for x in (a, b, c)))


@pytest.mark.parametrize("kernel", [arithmetic.cancel_minus, arithmetic.cancel_plus])
def test_cancelling_what_was_added_is_tight(kernel: Any) -> None:
    lower, upper = intervals(COUNT, 7)
    shift = np.random.default_rng(8).choice([*SPECIAL, *-SPECIAL], COUNT)
    with np.errstate(over="ignore"):
        moved = tuple(np.clip(bound + shift, -LARGEST, LARGEST) for bound in (lower, upper))
    common = (lower <= upper) & (lower > -np.inf) & (upper < np.inf)
    minuend, subtrahend = ((a[common], b[common]) for a, b in (moved, (lower, upper)))
    agrees(kernel, minuend, subtrahend if kernel is arithmetic.cancel_minus else (-subtrahend[1], -subtrahend[0]))


@pytest.mark.parametrize("operation", ITF1788)
def test_itf1788_vectors_are_met_exactly(operation: str, itf1788_folder: Path) -> None:
    assert len(list(itf1788.cases(itf1788_folder, operation))) >= 5
    assert not itf1788.missed(itf1788_folder, operation, ITF1788[operation], tight=True)


def test_itf1788_reader_finds_every_bare_case_of_the_division(itf1788_folder: Path) -> None:
    assert len(list(itf1788.cases(itf1788_folder, "div"))) == 341


def test_pyinterval_agrees_on_sums_and_products_and_has_no_tighter_quotient() -> None:
    interval = pytest.importorskip("interval", reason="pyinterval is not installed; it needs a C compiler").interval
    operations = {
        arithmetic.add: lambda a, b: a + b,
        arithmetic.sub: lambda a, b: a - b,
        arithmetic.mul: lambda a, b: a * b,
        arithmetic.div: lambda a, b: a / b,
    }
    rng = np.random.default_rng(4)
    bounds = np.sort(rng.normal(size=(2000, 2, 2)) * 10.0 ** rng.integers(-9, 9, size=(2000, 2, 1)), axis=2)
    for (al, au), (bl, bu) in bounds.tolist():
        for kernel, theirs in operations.items():
            parts = theirs(interval[al, au], interval[bl, bu])
            ours, hull = kernel(al, au, bl, bu), (parts[0].inf, parts[-1].sup)
            tighter = hull[0] <= ours[0] and ours[1] <= hull[1]
            assert ours == hull or (kernel is arithmetic.div and tighter), (kernel.__name__, al, au, bl, bu)


def below(exact: Fraction) -> float:
    """The largest double that is not above a number; the slow, obvious way to round down."""
    try:
        nearest = float(exact)
    except OverflowError:
        nearest = math.inf if exact > 0 else -math.inf
    return math.nextafter(nearest, -math.inf) if nearest > exact else nearest


FINITE = st.floats(allow_nan=False, allow_infinity=False)


@given(FINITE, FINITE)
def test_points_round_as_exact_fractions_do(a: float, b: float) -> None:
    x, y = Fraction(a), Fraction(b)
    for kernel, exact in ((arithmetic.add, x + y), (arithmetic.sub, x - y), (arithmetic.mul, x * y)):
        assert kernel(a, a, b, b) == (below(exact), -below(-exact))
    if b:
        assert arithmetic.div(a, a, b, b) == (below(x / y), -below(-x / y))


@given(st.floats(0, allow_infinity=False))
def test_square_roots_of_points_are_the_two_doubles_around_them(a: float) -> None:
    lower, upper = arithmetic.sqrt(a, a)
    assert Fraction(lower) ** 2 <= Fraction(a) <= Fraction(upper) ** 2
    assert (lower == upper) == (Fraction(lower) ** 2 == Fraction(a))
    assert upper <= math.nextafter(lower, math.inf)


@given(FINITE, FINITE, FINITE)
def test_a_product_plus_a_number_rounds_as_exact_fractions_do(a: float, b: float, c: float) -> None:
    exact = Fraction(a) * Fraction(b) + Fraction(c)
    assert arithmetic.multiply_add(a, a, b, b, c, c) == (below(exact), -below(-exact))


@pytest.mark.parametrize("kernel", KERNELS)
def test_an_empty_operand_gives_the_empty_interval(kernel: Any) -> None:
    count = ORACLES[kernel].operands
    if kernel in (arithmetic.cancel_minus, arithmetic.cancel_plus):
        assert kernel(*EMPTY, 1.0, 2.0) == EMPTY == kernel(*EMPTY, *EMPTY)
        assert kernel(1.0, 2.0, *EMPTY) == ENTIRE == kernel(*EMPTY, *ENTIRE)
        return
    for place in range(count):
        for other in ((1.0, 2.0), (0.0, 0.0), ENTIRE, EMPTY):
            operands = [EMPTY if k == place else other for k in range(count)]
            assert kernel(*(bound for operand in operands for bound in operand)) == EMPTY


@pytest.mark.parametrize(
    ("a", "b", "quotient"),
    [
        ((1.0, 2.0), (0.0, 0.0), EMPTY),
        ((1.0, 2.0), (-0.0, 4.0), (0.25, math.inf)),
        ((1.0, 2.0), (-4.0, 0.0), (-math.inf, -0.25)),
        ((-2.0, -1.0), (0.0, 4.0), (-math.inf, -0.25)),
        ((-2.0, 1.0), (0.0, 4.0), ENTIRE),
        ((1.0, 2.0), (-1.0, 4.0), ENTIRE),
        ((0.0, 0.0), (-1.0, 4.0), (0.0, 0.0)),
        ((0.0, 2.0), (0.0, 4.0), (0.0, math.inf)),
        ((1.0, math.inf), (1.0, math.inf), (0.0, math.inf)),
    ],
)
def test_division_by_an_interval_that_holds_zero(a: itf1788.Pair, b: itf1788.Pair, quotient: itf1788.Pair) -> None:
    assert arithmetic.div(*a, *b) == quotient


def test_zero_times_infinity_is_zero() -> None:
    assert arithmetic.mul(0.0, 0.0, *ENTIRE) == (0.0, 0.0)
    assert arithmetic.mul(0.0, math.inf, 0.0, 0.0) == (0.0, 0.0)


@pytest.mark.parametrize(
    ("a", "b", "pieces"),
    [
        ((1.0, 2.0), (-1.0, 4.0), (-math.inf, -1.0, 0.25, math.inf)),
        ((-2.0, -1.0), (-1.0, 4.0), (-math.inf, -0.25, 1.0, math.inf)),
        ((0.0, 2.0), (-1.0, 4.0), (*ENTIRE, *EMPTY)),
        ((1.0, 2.0), (2.0, 4.0), (0.25, 1.0, *EMPTY)),
        ((1.0, 2.0), (0.0, 0.0), (*EMPTY, *EMPTY)),
        ((0.0, 0.0), (0.0, 0.0), (*ENTIRE, *EMPTY)),
        ((TINY, TINY), ENTIRE, (-math.inf, 0.0, 0.0, math.inf)),
    ],
)
def test_division_into_pieces(a: itf1788.Pair, b: itf1788.Pair, pieces: tuple[float, ...]) -> None:
    assert arithmetic.div_pieces(*a, *b) == pieces
