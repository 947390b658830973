"""What the tests of interval operations share: adversarial intervals, and answers of other libraries and of exact arithmetic."""

import math
from collections.abc import Callable
from typing import Any

import ival
import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
Pairs = tuple[FloatArray, FloatArray]

LARGEST = np.finfo(np.float64).max
EMPTY, ENTIRE = (math.inf, -math.inf), (-math.inf, math.inf)
TINY = 5e-324
NORMAL = 2.0**-1022
SMALL = (0.0, TINY, 3 * TINY, NORMAL, NORMAL - TINY, 2.0**-600, 2.0**-540, 2.0**-52)
LARGE = (1e5, 2.0**53, 2.0**500, 2.0**600, LARGEST / 2, LARGEST)
SPECIAL = np.array([*SMALL, 0.1, 0.5, 1.0, 1.0 + 2.0**-52, 3.0, 7.0, math.pi / 2, math.pi, 1.5 * math.pi, *LARGE])


def numbers(count: int, seed: int) -> FloatArray:
    """Return finite doubles: special ones, their neighbours, random ones of every magnitude, and of ordinary magnitude."""
    rng = np.random.default_rng(seed)
    special = rng.choice(SPECIAL, count)
    neighbour = np.nextafter(special, rng.choice([0.0, LARGEST], count))
    any_size = rng.uniform(1.0, 2.0, count) * 2.0 ** rng.integers(-1022, 1024, count)
    subnormal = TINY * rng.integers(1, 2**40, count)
    ordinary = rng.uniform(0.0, 100.0, count)
    chosen = np.choose(rng.integers(0, 5, count), [special, neighbour, any_size, subnormal, ordinary])
    return chosen * rng.choice([-1.0, 1.0], count)


def intervals(count: int, seed: int) -> Pairs:
    """Return intervals with such bounds; one in ten is a point, one in ten unbounded, one in fifty empty."""
    rng = np.random.default_rng(seed)
    a, b = numbers(count, seed + 1), numbers(count, seed + 2)
    lower, upper = np.minimum(a, b), np.maximum(a, b)
    upper = np.where(rng.random(count) < 0.1, lower, upper)
    lower = np.where(rng.random(count) < 0.05, -np.inf, lower)
    upper = np.where(rng.random(count) < 0.05, np.inf, upper)
    empty = rng.random(count) < 0.02
    return np.where(empty, np.inf, lower), np.where(empty, -np.inf, upper)


def rows(kernel: Callable[..., tuple[float, float]], *operands: Pairs) -> Pairs:
    """Return the results of a kernel on every row of some intervals."""
    arguments = [bound.tolist() for operand in operands for bound in operand]
    results = np.array([kernel(*row) for row in zip(*arguments, strict=True)])
    return results[:, 0], results[:, 1]


def tight(function: Callable[..., Any], *operands: Pairs) -> Pairs:
    """Return the tight results of a function of crival, which writes the empty interval as [nan, nan]."""
    result = function(*(ival.Interval(*(np.where(lower > upper, np.nan, bound) for bound in (lower, upper))) for lower, upper in operands))
    empty = np.isnan(result.lo)
    return np.where(empty, np.inf, result.lo), np.where(empty, -np.inf, result.hi)


def ordinal(x: FloatArray) -> npt.NDArray[np.int64]:
    """Return where doubles stand in the order of all doubles: neighbours differ by 1."""
    bits = (np.asarray(x, dtype=np.float64) + 0.0).view(np.int64)
    return np.where(bits < 0, np.int64(-(2**63)) - bits, bits)


def slack(inner: Pairs, outer: Pairs) -> npt.NDArray[np.int64]:
    """Return by how many doubles an enclosure is wider than the tight one, at its worse end; negative where it loses something."""
    below, above = ordinal(inner[0]) - ordinal(outer[0]), ordinal(outer[1]) - ordinal(inner[1])
    return np.where((below < 0) | (above < 0), np.minimum(below, above), np.maximum(below, above))
