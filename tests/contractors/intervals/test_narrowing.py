import doctest
import itertools
import math
from typing import Any

import pytest

from ial.contractors import Interval
from ial.contractors.expressions import functions
from ial.contractors.expressions.operation import Operation
from ial.contractors.intervals import narrowing, reverse, reverse_periodic, reverse_polar, reverse_powers
from ial.contractors.intervals.narrowing import divide_pieces, narrow
from tests.contractors import oracles

ENTIRE = Interval.entire()
ONE = {
    functions.sqr: reverse.sqr_reverse,
    functions.absolute: reverse.abs_reverse,
    functions.sin: reverse_periodic.sin_reverse,
    functions.cos: reverse_periodic.cos_reverse,
    functions.tan: reverse_periodic.tan_reverse,
    functions.cosh: reverse.cosh_reverse,
}
# Of two operands, the one that is sought, and a kernel for b, c, x.
TWO = [
    (functions.mul, 0, reverse.mul_reverse),
    (functions.pow, 0, reverse_powers.pow_reverse_base),
    (functions.pow, 1, reverse_powers.pow_reverse_exponent),
    (functions.atan2, 0, reverse_polar.atan2_reverse_y),
    (functions.atan2, 1, reverse_polar.atan2_reverse_x),
]


def random(count: int, seed: int) -> list[Interval]:
    return [Interval.of_bounds(*bounds) for bounds in zip(*oracles.intervals(count, seed), strict=True)]


def reversed_by(kernel: Any, *operands: Interval | int) -> Interval:
    return Interval.of_bounds(*kernel(*bounds_of(operands)))


def bounds_of(operands: Any) -> list[float]:
    return [bound for each in operands for bound in ((each.lower, each.upper) if isinstance(each, Interval) else (each,))]


@pytest.mark.parametrize("operation", ONE, ids=str)
def test_the_reverse_of_a_function(operation: Operation) -> None:
    for c, x in zip(random(200, 1), random(200, 4), strict=True):
        assert narrow(operation, c, x) == (reversed_by(ONE[operation], c, x),)
        assert narrow(operation, c) == (reversed_by(ONE[operation], c, ENTIRE),)


@pytest.mark.many
@pytest.mark.parametrize(("operation", "sought", "kernel"), TWO, ids=["mulRev", "powRev1", "powRev2", "atan2Rev1", "atan2Rev2"])
def test_the_reverse_for_one_of_two_operands(operation: Operation, sought: int, kernel: Any) -> None:
    kept = 0
    for b, c, x in zip(random(300, 1), random(300, 4), random(300, 7), strict=True):
        for prior in (x, ENTIRE):
            operands = (b, prior) if sought else (prior, b)
            ours, wanted = narrow(operation, c, *operands)[sought], reversed_by(kernel, b, c, prior)
            # Where there is no solution, the other operand may tell while this one does not, for rounding.
            assert ours.is_empty or ours == wanted
            kept += not ours.is_empty
            assert wanted.is_empty or not ours.is_empty or not has_solution(operation, c, *operands)
    assert kept > 30


def has_solution(operation: Operation, c: Interval, *operands: Interval) -> bool:
    corners = itertools.product(*([each.lower, each.midpoint, each.upper] for each in operands if not each.is_empty))
    points = [corner for corner in corners if len(corner) == len(operands) and all(map(math.isfinite, corner))]
    images = [operation(*point) for point in points]
    return any(not image.is_empty and image in c for image in images)


@pytest.mark.parametrize("n", [-3, -2, 0, 1, 2, 5])
def test_the_reverse_of_a_whole_power(n: int) -> None:
    for c, x in zip(random(100, 1), random(100, 4), strict=True):
        assert narrow(functions.pown, c, x, n)[0] == reversed_by(reverse_powers.pown_reverse, c, x, n)


def test_narrowing_takes_all_operands_or_one() -> None:
    assert narrow(functions.sqr, Interval(1, 4)) == (Interval(-2, 2),)
    assert narrow(functions.add, 3, Interval(0, 1), Interval(0, 5)) == (Interval(0, 1), Interval(2, 3))
    assert all(each.is_empty for each in narrow(functions.add, 9, 1, 2))
    with pytest.raises(TypeError, match="add has 2 operands; 1 were given"):
        narrow(functions.add, 3, Interval(0, 1))


def test_division_in_two_pieces() -> None:
    assert divide_pieces(1, Interval(-1, 2)) == (Interval(-math.inf, -1), Interval(0.5, math.inf))
    assert divide_pieces(1, Interval(1, 2)) == (Interval(0.5, 1), Interval.empty())
    assert divide_pieces(Interval(-1, 1), Interval(-1, 2)) == (ENTIRE, Interval.empty())
    assert divide_pieces(1, Interval(-1, 2), Interval(0, 9)) == (Interval(0.5, 9), Interval.empty())
    assert all(piece.is_empty for piece in divide_pieces(1, 0))


def test_the_examples() -> None:
    assert doctest.testmod(narrowing).failed == 0
