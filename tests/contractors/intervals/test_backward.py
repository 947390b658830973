import math
from collections.abc import Callable
from typing import Any

import ival
import numpy as np
import pytest

from ial.contractors.intervals import backward
from tests.contractors.itf1788 import Pair
from tests.contractors.oracles import EMPTY, ENTIRE, intervals, tight
from tests.contractors.solutions import COUNT, Kernel, assert_kept, assert_narrows, columns, points, problems

# The backward kernel, the function of crival, and what r and one operand leave of the other.
BINARY: dict[Kernel, tuple[Callable[..., Any], ...]] = {
    backward.add_backward: (lambda a, b: a + b, lambda r, a, b: (r - b) & a, lambda r, a, b: (r - a) & b),
    backward.sub_backward: (lambda a, b: a - b, lambda r, a, b: (r + b) & a, lambda r, a, b: (a - r) & b),
    backward.mul_backward: (lambda a, b: a * b, lambda r, a, b: ival.mulrev(b, r, a), lambda r, a, b: ival.mulrev(a, r, b)),
    backward.div_backward: (lambda a, b: a / b, lambda r, a, b: (r * b) & a, lambda r, a, b: ival.mulrev(r, a, b)),
    backward.minimum_backward: (ival.min,),
    backward.maximum_backward: (ival.max,),
}


def name(kernel: Kernel) -> str:
    return kernel.__name__


@pytest.mark.parametrize("kernel", BINARY, ids=name)
def test_no_solution_is_lost(kernel: Kernel) -> None:
    r, priors, solutions = problems(BINARY[kernel][0], 1, points(COUNT, 10, 10.0), points(COUNT, 20, 10.0))
    narrowed = columns(kernel, r, *priors)
    assert_kept(narrowed, priors, solutions, r)
    assert_narrows(narrowed, priors)


@pytest.mark.parametrize("kernel", [kernel for kernel, row in BINARY.items() if len(row) == 3], ids=name)
def test_both_operands_are_tight(kernel: Kernel) -> None:
    _, first, second = BINARY[kernel]
    r, a, b = (intervals(COUNT, seed) for seed in (30, 31, 32))
    exact = tight(first, r, a, b), tight(second, r, a, b)
    none = (exact[0][0] > exact[0][1]) | (exact[1][0] > exact[1][1])
    if kernel is backward.div_backward:
        none |= (exact[1][0] == 0.0) & (exact[1][1] == 0.0)
    assert 0.1 < none.mean() < 0.9
    for ours, (low, high) in zip(columns(kernel, r, a, b), exact, strict=True):
        assert np.array_equal(ours[0], np.where(none, math.inf, low))
        assert np.array_equal(ours[1], np.where(none, -math.inf, high))


def test_no_solution_of_a_fused_product_and_sum_is_lost() -> None:
    operands = (points(COUNT, seed, 10.0) for seed in (40, 50, 60))
    r, priors, solutions = problems(ival.fma, 2, *operands)
    narrowed = columns(backward.multiply_add_backward, r, *priors)
    assert_kept(narrowed, priors, solutions, r)
    assert_narrows(narrowed, priors)


@pytest.mark.parametrize("kernel", BINARY, ids=name)
def test_one_empty_operand_empties_both(kernel: Kernel) -> None:
    for at in range(3):
        for other in (ENTIRE, (-1.0, 2.0), (0.0, 0.0), EMPTY):
            operands = [EMPTY if i == at else other for i in range(3)]
            assert kernel(*(bound for pair in operands for bound in pair)) == (*EMPTY, *EMPTY)


def test_one_empty_operand_of_four_empties_all() -> None:
    for at in range(4):
        operands = [EMPTY if i == at else (-1.0, 2.0) for i in range(4)]
        assert backward.multiply_add_backward(*(bound for pair in operands for bound in pair)) == (*EMPTY, *EMPTY, *EMPTY)


@pytest.mark.parametrize(
    ("kernel", "operands", "expected"),
    [
        (backward.add_backward, ((1.0, 1.0), (0.0, 0.25), (0.0, 2.0)), (0.0, 0.25, 0.75, 1.0)),
        (backward.add_backward, ((9.0, 9.0), (0.0, 1.0), (0.0, 2.0)), (*EMPTY, *EMPTY)),
        (backward.sub_backward, ((1.0, 1.0), (0.0, 2.0), (0.0, 0.5)), (1.0, 1.5, 0.0, 0.5)),
        (backward.mul_backward, ((1.0, 2.0), (-5.0, 5.0), (2.0, 4.0)), (0.25, 1.0, 2.0, 4.0)),
        (backward.mul_backward, ((0.0, 1.0), (-5.0, 5.0), (0.0, 4.0)), (-5.0, 5.0, 0.0, 4.0)),
        (backward.mul_backward, ((1.0, 2.0), (0.0, 0.0), (0.0, 4.0)), (*EMPTY, *EMPTY)),
        (backward.div_backward, ((1.0, 2.0), (2.0, 4.0), (-9.0, 9.0)), (2.0, 4.0, 1.0, 4.0)),
        (backward.div_backward, ((0.0, 0.0), (-2.0, 4.0), (-9.0, 9.0)), (0.0, 0.0, -9.0, 9.0)),
        (backward.div_backward, ((-1.0, 1.0), (-2.0, 4.0), (-9.0, 9.0)), (-2.0, 4.0, -9.0, 9.0)),
        (backward.div_backward, (ENTIRE, (-2.0, 4.0), (0.0, 0.0)), (*EMPTY, *EMPTY)),
        (backward.div_backward, ((1.0, 2.0), (0.0, 0.0), (-1.0, 1.0)), (*EMPTY, *EMPTY)),
        (backward.minimum_backward, ((1.0, 2.0), (0.0, 5.0), (3.0, 5.0)), (1.0, 2.0, 3.0, 5.0)),
        (backward.minimum_backward, ((1.0, 2.0), (0.0, 5.0), (2.0, 5.0)), (1.0, 5.0, 2.0, 5.0)),
        (backward.minimum_backward, ((1.0, 2.0), (3.0, 5.0), (3.0, 5.0)), (*EMPTY, *EMPTY)),
        (backward.maximum_backward, ((1.0, 2.0), (0.0, 5.0), (-3.0, 0.5)), (1.0, 2.0, -3.0, 0.5)),
        (backward.multiply_add_backward, ((7.0, 7.0), (2.0, 2.0), (0.0, 9.0), (1.0, 3.0)), (2.0, 2.0, 2.0, 3.0, 1.0, 3.0)),
    ],
)
def test_examples(kernel: Kernel, operands: tuple[Pair, ...], expected: tuple[float, ...]) -> None:
    assert kernel(*(bound for pair in operands for bound in pair)) == expected
