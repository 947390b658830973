"""Random problems with a known solution, for the tests of reverse and backward operations: whatever they narrow, it must stay inside."""

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from tests.cases import cases
from tests.contractors.oracles import FloatArray, Pairs, numbers, tight

COUNT = cases(10_000, 200)

Kernel = Callable[..., tuple[float, ...]]


def points(count: int, seed: int, scale: float = 1.0) -> FloatArray:
    """Return numbers of every kind, half of them within ±scale, 0 and ±scale among them."""
    rng = np.random.default_rng(seed)
    near = np.where(rng.random(count) < 0.2, rng.integers(-2, 3, count) / 2.0, rng.uniform(-1.0, 1.0, count)) * scale
    return np.where(rng.random(count) < 0.5, near, numbers(count, seed + 1))


def around(low: FloatArray, high: FloatArray, seed: int) -> Pairs:
    """Return intervals around others: the same bound, the next double, a little or much farther out, or infinite."""
    rng = np.random.default_rng(seed)
    bounds = []
    for sign, bound in ((-1.0, low), (1.0, high)):
        with np.errstate(over="ignore"):
            choices = [
                bound,
                np.nextafter(bound, sign * np.inf),
                bound + sign * np.abs(bound) * rng.random(len(bound)),
                bound + sign * rng.uniform(0.0, 7.0, len(bound)),
                sign * np.maximum(sign * bound, np.abs(numbers(len(bound), seed + 1))),
                np.full(len(bound), sign * np.inf),
            ]
        bounds.append(np.choose(rng.choice(6, len(bound), p=[0.35, 0.1, 0.2, 0.15, 0.15, 0.05]), choices))
    return bounds[0], bounds[1]


def problems(function: Callable[..., Any], seed: int, *operands: FloatArray) -> tuple[Pairs, list[Pairs], list[FloatArray]]:
    """Return results r, priors and solutions: each solution lies in its prior, and what a function makes of the solutions lies in r.

    The function is one of crival's. Its tight value at a point holds the exact one. Points where it is undefined are left out.
    """
    low, high = tight(function, *((x, x) for x in operands))
    defined = low <= high
    solutions = [x[defined] for x in operands]
    result = around(low[defined], high[defined], seed)
    return result, [around(x, x, seed + 2 + i) for i, x in enumerate(solutions)], solutions


def columns(kernel: Kernel, *operands: Pairs, exponents: npt.NDArray[np.int64] | None = None) -> list[Pairs]:
    """Return what a kernel makes of every row of some intervals (and integers), as one or more intervals."""
    arguments = [bound.tolist() for operand in operands for bound in operand]
    if exponents is not None:
        arguments.append(exponents.tolist())
    results = np.array([kernel(*row) for row in zip(*arguments, strict=True)])
    return [(results[:, i], results[:, i + 1]) for i in range(0, results.shape[1], 2)]


def encloses(outer: Pairs, inner: Pairs) -> bool:
    """Return whether every interval contains its counterpart; all contain the empty one."""
    return bool(((outer[0] <= inner[0]) & (inner[1] <= outer[1])).all())


def some(pairs: Pairs) -> npt.NDArray[np.bool_]:
    """Return which intervals are not empty."""
    return np.asarray(pairs[0] <= pairs[1])


def grown(pair: Pairs, steps: int = 4) -> Pairs:
    """Return intervals a few doubles wider at both ends; empty ones stay."""
    lower, upper = pair
    for _ in range(steps):
        with np.errstate(over="ignore"):
            lower, upper = np.nextafter(lower, -np.inf), np.nextafter(upper, np.inf)
    empty = pair[0] > pair[1]
    return np.where(empty, np.inf, lower), np.where(empty, -np.inf, upper)


def assert_kept(narrowed: list[Pairs], priors: list[Pairs], solutions: list[FloatArray], *context: Pairs) -> None:
    """Fail if a solution is lost, or if a result is not within its prior or not written as an interval."""
    for (lower, upper), (start, stop), x in zip(narrowed, priors, solutions, strict=True):
        wrong = np.flatnonzero(~((start <= lower) & (lower <= x) & (x <= upper) & (upper <= stop)))
        shown = [[x[i], (lower[i], upper[i]), *((p[0][i], p[1][i]) for p in (*priors, *context))] for i in wrong[:3]]
        assert not len(wrong), f"{len(wrong)} of {len(x)}: solution, narrowed to, priors, given: {shown}"


def assert_narrows(narrowed: list[Pairs], priors: list[Pairs]) -> None:
    """Fail if next to nothing was narrowed: then nothing else was tested either."""
    for (lower, upper), (start, stop) in zip(narrowed, priors, strict=True):
        assert ((lower > start) | (upper < stop)).mean() > 0.05
