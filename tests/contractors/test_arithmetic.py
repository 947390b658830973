import math
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import ival
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.contractors import arithmetic
from ial.contractors.kernels import kernel as compiled
from tests.contractors import itf1788
from tests.contractors.oracles import EMPTY, ENTIRE, Pairs, intervals, rows, tight

COUNT = 20_000

UNARY = {arithmetic.sqr: ival.sqr, arithmetic.sqrt: ival.sqrt, arithmetic.absolute: abs, arithmetic.neg: lambda a: -a}
BINARY = {
    arithmetic.add: lambda a, b: a + b,
    arithmetic.sub: lambda a, b: a - b,
    arithmetic.mul: lambda a, b: a * b,
    arithmetic.div: lambda a, b: a / b,
    arithmetic.minimum: ival.min,
    arithmetic.maximum: ival.max,
    arithmetic.intersect: lambda a, b: a & b,
    arithmetic.hull: lambda a, b: a | b,
}
ITF1788 = {
    "add": arithmetic.add,
    "sub": arithmetic.sub,
    "mul": arithmetic.mul,
    "div": arithmetic.div,
    "neg": arithmetic.neg,
    "sqr": arithmetic.sqr,
    "sqrt": arithmetic.sqrt,
    "abs": arithmetic.absolute,
    "min": arithmetic.minimum,
    "max": arithmetic.maximum,
    "intersection": arithmetic.intersect,
    "convexHull": arithmetic.hull,
}


def same(ours: Pairs, theirs: Pairs, operands: tuple[Pairs, ...]) -> None:
    wrong = np.flatnonzero((ours[0] != theirs[0]) | (ours[1] != theirs[1]))
    shown = [[(a[0][i], a[1][i]) for a in (*operands, ours, theirs)] for i in wrong[:5]]
    assert not len(wrong), f"{len(wrong)} differ: operands, ours, theirs: {shown}"


@pytest.mark.parametrize("kernel", UNARY, ids=lambda kernel: kernel.__name__)
def test_unary_operations_are_tight(kernel: Callable[..., tuple[float, float]]) -> None:
    a = intervals(COUNT, 1)
    same(rows(kernel, a), tight(UNARY[kernel], a), (a,))


@pytest.mark.parametrize("kernel", BINARY, ids=lambda kernel: kernel.__name__)
def test_binary_operations_are_tight(kernel: Callable[..., tuple[float, float]]) -> None:
    a, b = intervals(COUNT, 2), intervals(COUNT, 3)
    same(rows(kernel, a, b), tight(BINARY[kernel], a, b), (a, b))


@pytest.mark.parametrize("operation", ITF1788)
def test_itf1788_vectors_are_met_exactly(operation: str, itf1788_folder: Path) -> None:
    cases = list(itf1788.cases(itf1788_folder, operation))
    assert len(cases) >= 5
    failed = [case.source for case in cases if ITF1788[operation](*(bound for pair in case.inputs for bound in pair)) != case.result]
    assert not failed


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


@pytest.mark.parametrize("kernel", [*UNARY, *BINARY], ids=lambda kernel: kernel.__name__)
def test_empty_operands_give_the_empty_interval(kernel: Callable[..., tuple[float, float]]) -> None:
    if kernel in UNARY:
        assert kernel(*EMPTY) == EMPTY
    elif kernel is arithmetic.hull:
        assert kernel(*EMPTY, 1.0, 2.0) == (1.0, 2.0) == kernel(1.0, 2.0, *EMPTY)
    else:
        for other in ((1.0, 2.0), (0.0, 0.0), ENTIRE, EMPTY):
            assert kernel(*EMPTY, *other) == EMPTY == kernel(*other, *EMPTY)


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
def test_division_by_an_interval_that_holds_zero(a: itf1788.Bounds, b: itf1788.Bounds, quotient: itf1788.Bounds) -> None:
    assert arithmetic.div(*a, *b) == quotient


def test_zero_times_infinity_is_zero() -> None:
    assert arithmetic.mul(0.0, 0.0, *ENTIRE) == (0.0, 0.0)
    assert arithmetic.mul(0.0, math.inf, 0.0, 0.0) == (0.0, 0.0)


def test_fused_multiply_add_rounds_once() -> None:
    @compiled
    def fused(a, b, c):  # type: ignore[no-untyped-def]
        return arithmetic.fma(a, b, c)

    x = 1.0 + 2.0**-30
    assert fused(x, x, -(x * x)) == 2.0**-60
