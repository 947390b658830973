import math
from collections.abc import Callable
from typing import Any

import ival
import numpy as np
import pytest

from ial.contractors.intervals import reverse_integer
from tests.contractors.itf1788 import Pair
from tests.contractors.oracles import EMPTY, ENTIRE
from tests.contractors.solutions import COUNT, Kernel, assert_kept, assert_narrows, columns, points, problems

OPERATIONS: dict[Kernel, Callable[..., Any]] = {
    reverse_integer.sign_reverse: ival.sign,
    reverse_integer.floor_reverse: ival.floor,
    reverse_integer.ceil_reverse: ival.ceil,
    reverse_integer.trunc_reverse: ival.trunc,
    reverse_integer.round_ties_to_even_reverse: ival.roundeven,
    reverse_integer.round_ties_to_away_reverse: ival.round,
}


def name(kernel: Kernel) -> str:
    return kernel.__name__


@pytest.mark.parametrize("kernel", OPERATIONS, ids=name)
def test_no_solution_is_lost(kernel: Kernel) -> None:
    c, priors, solutions = problems(OPERATIONS[kernel], 1, points(COUNT, 10, 4.0))
    narrowed = columns(kernel, c, *priors)
    assert_kept(narrowed, priors, solutions, c)
    assert_narrows(narrowed, priors)


@pytest.mark.parametrize("kernel", OPERATIONS, ids=name)
def test_every_set_of_small_integers_is_tight(kernel: Kernel) -> None:
    # All numbers that matter are multiples of 1/8: the hull of those that solve, and half a step around it where the set is open.
    grid = np.arange(-40, 41) / 8.0
    values = OPERATIONS[kernel](ival.Interval(grid, grid)).lo
    ends = [-math.inf, *np.arange(-6, 7) / 2.0, math.inf]
    priors = [-math.inf, *np.arange(-14, 15) / 4.0, math.inf]
    rng = np.random.default_rng(2)
    for _ in range(2000):
        c, x = np.sort(rng.choice(ends, 2)), np.sort(rng.choice(priors, 2))
        if any(math.isinf(pair[0]) and pair[0] == pair[1] for pair in (c, x)):
            continue
        solves = (values >= c[0]) & (values <= c[1]) & (grid >= x[0]) & (grid <= x[1])
        lower, upper = kernel(*c.tolist(), *x.tolist())
        if not solves.any():
            assert (lower, upper) == EMPTY, (c, x)
            continue
        first, last = grid[solves][[0, -1]]
        assert first - 0.125 <= lower <= first or first == grid[0], (c, x)
        assert last <= upper <= last + 0.125 or last == grid[-1], (c, x)
        assert x[0] <= lower
        assert upper <= x[1]


@pytest.mark.parametrize("kernel", OPERATIONS, ids=name)
def test_an_empty_result_or_prior_gives_the_empty_interval(kernel: Kernel) -> None:
    for other in (EMPTY, ENTIRE, (-1.0, 2.0), (0.0, 0.0)):
        assert kernel(*EMPTY, *other) == EMPTY == kernel(*other, *EMPTY)
    assert kernel(*ENTIRE, *ENTIRE) == ENTIRE


@pytest.mark.parametrize(
    ("kernel", "c", "x", "expected"),
    [
        (reverse_integer.sign_reverse, (1.0, 5.0), ENTIRE, (0.0, math.inf)),
        (reverse_integer.sign_reverse, (1.0, 5.0), (-1.0, 0.0), EMPTY),
        (reverse_integer.sign_reverse, (-0.5, 0.5), ENTIRE, (0.0, 0.0)),
        (reverse_integer.floor_reverse, (1.5, 2.5), ENTIRE, (2.0, 3.0)),
        (reverse_integer.floor_reverse, (1.25, 1.75), ENTIRE, EMPTY),
        (reverse_integer.floor_reverse, (2.0, 2.0), (3.0, 4.0), EMPTY),
        (reverse_integer.ceil_reverse, (2.0, 2.0), (0.0, 1.0), EMPTY),
        (reverse_integer.trunc_reverse, (0.0, 0.0), ENTIRE, (-1.0, 1.0)),
        (reverse_integer.round_ties_to_even_reverse, (2.0, 2.0), ENTIRE, (1.5, 2.5)),
        (reverse_integer.round_ties_to_even_reverse, (1.0, 1.0), (1.5, 9.0), EMPTY),
        (reverse_integer.round_ties_to_even_reverse, (2.0, 2.0), (0.0, 1.5), (1.5, 1.5)),
        (reverse_integer.round_ties_to_away_reverse, (0.0, 0.0), (0.5, 9.0), EMPTY),
        (reverse_integer.floor_reverse, (2.0**53, 2.0**53), ENTIRE, (2.0**53, 2.0**53 + 2.0)),
    ],
)
def test_ends_that_do_not_belong(kernel: Kernel, c: Pair, x: Pair, expected: Pair) -> None:
    assert kernel(*c, *x) == expected
