import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import ival
import numpy as np
import pytest

from ial.contractors.intervals import reverse
from ial.contractors.intervals.arithmetic import div_pieces
from tests.contractors import itf1788
from tests.contractors.oracles import EMPTY, ENTIRE, LARGEST, TINY, Pairs, intervals, rows, slack, tight
from tests.contractors.solutions import COUNT, Kernel, assert_kept, assert_narrows, columns, encloses, points, problems, some

ONE = ival.Interval(1.0, 1.0)

# The reverse kernel, the function of crival, its reverse or the part of its inverse that lies in the domain, the size of usual arguments.
Row = tuple[Kernel, Callable[..., Any], Callable[..., Any], float]
TIGHT: list[Row] = [
    (reverse.abs_reverse, abs, ival.absrev, 10.0),
    (reverse.sqr_reverse, ival.sqr, ival.sqrrev, 10.0),
    (reverse.recip_reverse, ival.recip, lambda c, x: ival.mulrev(c, ONE, x), 10.0),
]
POSITIVE = ival.Interval(0.0, math.inf)
NEARLY_TIGHT: list[Row] = [
    (reverse.sqrt_reverse, ival.sqrt, lambda c, x: ival.sqr(c & POSITIVE) & x, 10.0),
    (reverse.exp_reverse, ival.exp, lambda c, x: ival.log(c) & x, 700.0),
    (reverse.exp2_reverse, ival.exp2, lambda c, x: ival.log2(c) & x, 1000.0),
    (reverse.exp10_reverse, ival.exp10, lambda c, x: ival.log10(c) & x, 300.0),
    (reverse.log_reverse, ival.log, lambda c, x: ival.exp(c) & x, 10.0),
    (reverse.log2_reverse, ival.log2, lambda c, x: ival.exp2(c) & x, 10.0),
    (reverse.log10_reverse, ival.log10, lambda c, x: ival.exp10(c) & x, 10.0),
    (reverse.sinh_reverse, ival.sinh, lambda c, x: ival.asinh(c) & x, 10.0),
    (reverse.cosh_reverse, ival.cosh, ival.coshrev, 10.0),
    (reverse.tanh_reverse, ival.tanh, lambda c, x: ival.atanh(c) & x, 10.0),
    (reverse.asinh_reverse, ival.asinh, lambda c, x: ival.sinh(c) & x, 10.0),
    (reverse.acosh_reverse, ival.acosh, lambda c, x: ival.cosh(c & POSITIVE) & x, 10.0),
    (reverse.atanh_reverse, ival.atanh, lambda c, x: ival.tanh(c) & x, 1.0),
]


def name(row: Any) -> str | None:
    return getattr(row[0], "__name__", None) if isinstance(row, tuple) else None


def unary_problems(row: Row, seed: int) -> Any:
    return problems(row[1], seed, points(COUNT, seed + 10, row[3]))


@pytest.mark.parametrize("row", [*TIGHT, *NEARLY_TIGHT], ids=name)
def test_no_solution_is_lost(row: Row) -> None:
    c, priors, solutions = unary_problems(row, 1)
    narrowed = columns(row[0], c, *priors)
    assert_kept(narrowed, priors, solutions, c)
    assert_narrows(narrowed, priors)


@pytest.mark.parametrize("row", TIGHT, ids=name)
def test_reverse_operations_are_tight(row: Row) -> None:
    c, x = intervals(COUNT, 1), intervals(COUNT, 2)
    assert np.array_equal(rows(row[0], c, x), tight(row[2], c, x))
    near, (prior,), _ = unary_problems(row, 2)
    assert np.array_equal(rows(row[0], near, prior), tight(row[2], near, prior))


@pytest.mark.parametrize("row", NEARLY_TIGHT, ids=name)
def test_reverse_operations_are_nearly_tight(row: Row) -> None:
    c, x = intervals(COUNT, 3), intervals(COUNT, 4)
    near, (prior,), _ = unary_problems(row, 5)
    for ours, exact in ((rows(row[0], c, x), tight(row[2], c, x)), (rows(row[0], near, prior), tight(row[2], near, prior))):
        assert encloses(ours, exact)
        assert slack(exact, ours)[some(exact)].max() <= 2
        assert some(exact).mean() > 0.1


def touching(c: Pairs, b: Pairs, seed: int) -> Pairs:
    """Return priors with a bound at, or next to, a quotient of bounds."""
    rng = np.random.default_rng(seed)
    end, divisor = (np.where(rng.random(COUNT) < 0.5, *pair) for pair in (c, b))
    with np.errstate(all="ignore"):
        quotient = np.nan_to_num(end / divisor, nan=0.0, posinf=LARGEST, neginf=-LARGEST)
        near = np.nextafter(quotient, rng.choice([0.0, math.inf, -math.inf, quotient[0]], COUNT))
    start = np.clip(np.where(rng.random(COUNT) < 0.5, quotient, near), -LARGEST, LARGEST)
    stop = np.clip(start / 2 + rng.choice([0.0, 1.0, -1.0, 1e300, -1e300], COUNT), -LARGEST, LARGEST)
    stop = np.where(rng.random(COUNT) < 0.3, start, stop)
    return np.minimum(start, stop), np.maximum(start, stop)


def test_quotients_are_tight_and_empty_where_the_prior_misses_them_by_a_hair() -> None:
    b, c, x = (intervals(COUNT, seed) for seed in (6, 7, 8))
    for prior in (x, touching(c, b, 9), (np.full(COUNT, -math.inf), np.full(COUNT, math.inf))):
        assert np.array_equal(rows(reverse.mul_reverse, b, c, prior), tight(ival.mulrev, b, c, prior))


def test_no_factor_is_lost() -> None:
    r, (x, b), (factor, other) = problems(lambda x, b: x * b, 10, points(COUNT, 20), points(COUNT, 30))
    first, second = columns(reverse.mul_reverse_pieces, b, r, x)
    assert ((first[1] <= second[0]) | (first[0] > first[1]) | (second[0] > second[1])).all()
    inside = [(piece[0] <= factor) & (factor <= piece[1]) for piece in (first, second)]
    assert (inside[0] | inside[1]).all()
    hull = np.minimum(first[0], second[0]), np.maximum(first[1], second[1])
    assert np.array_equal(rows(reverse.mul_reverse, b, r, x), hull)
    assert len(other) > COUNT / 2


def test_pieces_within_the_real_line_are_those_of_the_division() -> None:
    for case in zip(*intervals(1000, 40), *intervals(1000, 50), strict=True):
        bl, bu, cl, cu = map(float, case)
        assert reverse.mul_reverse_pieces(bl, bu, cl, cu, *ENTIRE) == div_pieces(cl, cu, bl, bu)


@pytest.mark.parametrize(
    ("operands", "pieces"),
    [
        (((-1.0, 1.0), (1.0, 2.0), ENTIRE), (-math.inf, -1.0, 1.0, math.inf)),
        (((-1.0, 1.0), (1.0, 2.0), (-3.0, 2.0)), (-3.0, -1.0, 1.0, 2.0)),
        (((-1.0, 1.0), (1.0, 2.0), (-0.5, 2.0)), (*EMPTY, 1.0, 2.0)),
        (((-1.0, 1.0), (0.0, 2.0), (-0.5, 2.0)), (-0.5, 2.0, *EMPTY)),
        (((0.0, 0.0), (1.0, 2.0), ENTIRE), (*EMPTY, *EMPTY)),
        (((1.0, math.inf), (1.0, 2.0), (-1.0, 0.0)), (*EMPTY, *EMPTY)),
        (((1.0, math.inf), (1.0, 2.0), (-1.0, TINY)), (0.0, TINY, *EMPTY)),
    ],
)
def test_pieces_within_a_prior(operands: tuple[itf1788.Pair, ...], pieces: tuple[float, ...]) -> None:
    assert reverse.mul_reverse_pieces(*(bound for pair in operands for bound in pair)) == pieces


@pytest.mark.parametrize("row", [*TIGHT, *NEARLY_TIGHT], ids=name)
def test_an_empty_result_or_prior_gives_the_empty_interval(row: Row) -> None:
    for other in (EMPTY, ENTIRE, (-1.0, 2.0), (0.0, 0.0)):
        assert row[0](*EMPTY, *other) == EMPTY == row[0](*other, *EMPTY)
        assert reverse.mul_reverse(*EMPTY, *other, *ENTIRE) == EMPTY == reverse.mul_reverse(*other, *EMPTY, *ENTIRE)


@pytest.mark.parametrize(
    ("operation", "kernel", "at_least"),
    [
        ("sqrRev", reverse.sqr_reverse, 9),
        ("absRev", reverse.abs_reverse, 9),
        ("mulRev", reverse.mul_reverse, 150),
        ("mulRevTen", reverse.mul_reverse, 5),
    ],
)
def test_itf1788_vectors_are_met_exactly(operation: str, kernel: Kernel, at_least: int, itf1788_folder: Path) -> None:
    cases = list(itf1788.cases(itf1788_folder, operation, f"{operation}Bin"))
    assert len(cases) >= at_least
    for case in cases:
        bounds = [bound for pair in case.inputs for bound in pair]  # type: ignore[union-attr]
        prior = () if case.operation.endswith(("Bin", "Ten")) else ENTIRE
        assert kernel(*bounds, *prior) == case.result, case.source


def test_itf1788_vectors_of_the_division_into_two_pieces_are_met_exactly(itf1788_folder: Path) -> None:
    text = (itf1788_folder / "libieeep1788_mul_rev.itl").read_text()
    # Bare cases only: four intervals without a decoration.
    vectors = re.findall(r"mulRevToPair" + r"\s+(\[[^\]]*\])(?!_)" * 2 + r"\s*=" + r"\s*(\[[^\]]*\])(?!_)" * 2 + ";", text)
    assert len(vectors) >= 150
    for words in vectors:
        if "[nai]" not in words:
            b, c, first, second = (itf1788._value(word) for word in words)
            assert reverse.mul_reverse_pieces(*b, *c, *ENTIRE) == (*first, *second), words  # type: ignore[misc]


def test_itf1788_vectors_of_the_reverse_hyperbolic_cosine_are_contained(itf1788_folder: Path) -> None:
    cases = list(itf1788.cases(itf1788_folder, "coshRev", "coshRevBin"))
    assert len(cases) >= 10
    for case in cases:
        c, x = (*case.inputs, ENTIRE)[:2]
        lower, upper = reverse.cosh_reverse(*c, *x)
        assert lower <= case.result[0], case.source
        assert case.result[1] <= upper, case.source
