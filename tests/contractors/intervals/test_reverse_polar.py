import math

import ival
import numpy as np
import pytest

from ial.contractors.intervals import reverse_polar
from tests.contractors.itf1788 import Pair
from tests.contractors.oracles import EMPTY, ENTIRE, rows
from tests.contractors.solutions import COUNT, Kernel, assert_kept, assert_narrows, columns, points, problems

THIN = 1e-6
OPERATIONS = {reverse_polar.hypot_backward: ival.hypot, reverse_polar.atan2_backward: ival.atan2}


def name(kernel: Kernel) -> str:
    return kernel.__name__


@pytest.mark.parametrize("kernel", OPERATIONS, ids=name)
def test_no_point_is_lost(kernel: Kernel) -> None:
    r, priors, solutions = problems(OPERATIONS[kernel], 1, points(COUNT, 10, 10.0), points(COUNT, 20, 10.0))
    narrowed = columns(kernel, r, *priors)
    assert_kept(narrowed, priors, solutions, r)
    assert_narrows(narrowed, priors)


def test_reverse_angles_are_the_parts_of_the_backward_one() -> None:
    r, (y, x), _ = problems(ival.atan2, 2, points(COUNT, 30, 10.0), points(COUNT, 40, 10.0))
    first, second = columns(reverse_polar.atan2_backward, r, y, x)
    assert np.array_equal(rows(reverse_polar.atan2_reverse_y, x, r, y), first)
    assert np.array_equal(rows(reverse_polar.atan2_reverse_x, y, r, x), second)


def test_a_narrowed_box_cannot_be_narrowed_further_on_any_side() -> None:
    # Near each side there is a solution: the angles or lengths of a thin slice meet r. (Solutions may come as near to (0, 0) as they like.)
    rng = np.random.default_rng(3)
    for kernel, function in OPERATIONS.items():
        low = np.sort(rng.uniform(-4.0, 4.0, (500, 3, 2)), axis=2)
        for r, a, b in low.tolist():
            al, au, bl, bu = kernel(*r, *a, *b)
            slices = [((al, al + THIN), b), ((au - THIN, au), b), (a, (bl, bl + THIN)), (a, (bu - THIN, bu))]
            for slice_a, slice_b in slices if al <= au else []:
                reached = function(ival.Interval(*slice_a), ival.Interval(*slice_b))
                assert reached.lo <= r[1] + THIN, (kernel.__name__, r, a, b)
                assert reached.hi >= r[0] - THIN, (kernel.__name__, r, a, b)


def test_lengths_neither_overflow_nor_cancel() -> None:
    assert reverse_polar.hypot_backward(5e200, 5e200, 0.0, math.inf, 3e200, 3e200)[:2] == pytest.approx((4e200, 4e200), rel=1e-15)
    assert reverse_polar.hypot_backward(5e-200, 5e-200, 0.0, math.inf, 3e-200, 3e-200)[:2] == pytest.approx((4e-200, 4e-200), rel=1e-15)
    lower, upper = reverse_polar.hypot_backward(1.0 + 2.0**-52, 1.0 + 2.0**-52, 0.0, math.inf, 1.0, 1.0)[:2]
    exact = math.sqrt(2.0**-51 + 2.0**-104)
    assert lower <= exact <= upper
    assert upper - lower <= 8 * math.ulp(exact)


HALF_PI = (math.pi / 2, math.nextafter(math.pi / 2, 2.0))


@pytest.mark.parametrize(
    ("kernel", "operands", "expected"),
    [
        (reverse_polar.hypot_backward, ((0.0, 5.0), (3.0, 9.0), (-9.0, 4.0)), (3.0, 5.0, -4.0, 4.0)),
        (reverse_polar.hypot_backward, ((-2.0, -1.0), ENTIRE, ENTIRE), (*EMPTY, *EMPTY)),
        (reverse_polar.hypot_backward, ((0.0, 1.0), (2.0, 3.0), ENTIRE), (*EMPTY, *EMPTY)),
        (reverse_polar.hypot_backward, ((0.0, 0.0), ENTIRE, ENTIRE), (0.0, 0.0, 0.0, 0.0)),
        (reverse_polar.atan2_backward, (ENTIRE, (-3.0, 4.0), (-1.0, 2.0)), (-3.0, 4.0, -1.0, 2.0)),
        (reverse_polar.atan2_backward, (ENTIRE, (0.0, 0.0), (0.0, 0.0)), (*EMPTY, *EMPTY)),
        (reverse_polar.atan2_backward, ((0.0, 0.0), (-3.0, 4.0), (-1.0, 2.0)), (0.0, 0.0, 0.0, 2.0)),
        (reverse_polar.atan2_backward, (HALF_PI, (-3.0, 4.0), (0.0, 0.0)), (0.0, 4.0, 0.0, 0.0)),
        (reverse_polar.atan2_backward, ((3.0, 4.0), (0.0, 0.0), (-1.0, 2.0)), (0.0, 0.0, -1.0, 0.0)),
        (reverse_polar.atan2_backward, ((-4.0, -3.0), (0.0, 0.0), (-1.0, 2.0)), (*EMPTY, *EMPTY)),
        (reverse_polar.atan2_backward, ((4.0, 5.0), ENTIRE, ENTIRE), (*EMPTY, *EMPTY)),
        (reverse_polar.atan2_backward, ((0.1, 0.2), ENTIRE, (0.0, 0.0)), (*EMPTY, *EMPTY)),
    ],
)
def test_examples(kernel: Kernel, operands: tuple[Pair, ...], expected: tuple[float, ...]) -> None:
    result = kernel(*(bound for pair in operands for bound in pair))
    if kernel is reverse_polar.hypot_backward:
        assert result == pytest.approx(expected, rel=1e-15)
    else:
        assert result == expected


@pytest.mark.parametrize("kernel", OPERATIONS, ids=name)
def test_one_empty_operand_empties_both(kernel: Kernel) -> None:
    for at in range(3):
        for other in (ENTIRE, (-1.0, 2.0), (0.0, 0.0), EMPTY):
            operands = [EMPTY if i == at else other for i in range(3)]
            assert kernel(*(bound for pair in operands for bound in pair)) == (*EMPTY, *EMPTY)
