"""What the tests of interval operations share: adversarial intervals, and answers of other libraries and of exact arithmetic."""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import ival
import mpmath
import numpy as np
import numpy.typing as npt

from ial.contractors.intervals import arithmetic, exponential, integer, powers, sets, trigonometric

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


def hard_numbers(count: int, seed: int) -> FloatArray:
    """Return doubles where some function is hard: near 1 and multiples of π/4 and ln(2)/2, whole and half numbers, powers of 2 and 10."""
    rng = np.random.default_rng(seed)
    near_one = 1.0 + rng.uniform(-1.0, 1.0, count) * 2.0 ** -rng.uniform(0.0, 53.0, count)
    with mpmath.workdps(40):
        eighths, halves = (float(unit) for unit in (mpmath.pi / 4, mpmath.log(2) / 2))
        turns = np.array([float(int(k) * mpmath.pi / 4) for k in rng.integers(0, 127_000, count)])
    logarithms = halves * rng.integers(0, 2000, count)
    grid = np.nextafter(np.where(rng.random(count) < 0.5, turns, logarithms), rng.choice([-np.inf, 0.0, np.inf], count))
    small_turns = np.nextafter(eighths * rng.integers(0, 9, count), rng.choice([-np.inf, np.inf], count))
    whole = rng.choice([0.5, 1.0], count) * rng.integers(0, 1100, count)
    binary, decimal = 2.0 ** rng.integers(-1074, 1024, count), np.array([float(10**k) for k in range(23)])[rng.integers(0, 23, count)]
    ordinary = rng.choice([1.0, 30.0, 700.0], count) * rng.random(count)
    chosen = np.choose(rng.integers(0, 7, count), [near_one, grid, small_turns, whole, binary, decimal, ordinary])
    return chosen * rng.choice([-1.0, 1.0], count)


def hard_intervals(count: int, seed: int) -> Pairs:
    """Return intervals of such bounds; every second one is a point."""
    rng = np.random.default_rng(seed)
    a, b = hard_numbers(count, seed + 1), hard_numbers(count, seed + 2)
    b = np.where(rng.random(count) < 0.5, a, b)
    return np.minimum(a, b), np.maximum(a, b)


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
    ends = [(ordinal(low), ordinal(high)) for low, high in ((outer[0], inner[0]), (inner[1], outer[1]))]
    lost = np.any([low > high for low, high in ends], axis=0)
    steps = [high.view(np.uint64) - low.view(np.uint64) for low, high in ends]  # may exceed an int64
    return np.where(lost, -1, np.minimum(np.maximum(*steps), np.uint64(2**62)).astype(np.int64))


class Oracle(NamedTuple):
    """What a kernel is compared with: crival's function, the number of operands, and how many doubles wider than tight a bound may be."""

    function: Callable[..., Any]
    operands: int = 1
    wider: int = 0


ORACLES: dict[Any, Oracle] = {
    sets.intersect: Oracle(lambda a, b: a & b, 2),
    sets.hull: Oracle(lambda a, b: a | b, 2),
    arithmetic.neg: Oracle(lambda a: -a),
    arithmetic.add: Oracle(lambda a, b: a + b, 2),
    arithmetic.sub: Oracle(lambda a, b: a - b, 2),
    arithmetic.mul: Oracle(lambda a, b: a * b, 2),
    arithmetic.div: Oracle(lambda a, b: a / b, 2),
    arithmetic.recip: Oracle(ival.recip),
    arithmetic.sqr: Oracle(ival.sqr),
    arithmetic.sqrt: Oracle(ival.sqrt),
    arithmetic.absolute: Oracle(abs),
    arithmetic.minimum: Oracle(ival.min, 2),
    arithmetic.maximum: Oracle(ival.max, 2),
    arithmetic.multiply_add: Oracle(ival.fma, 3),
    arithmetic.cancel_minus: Oracle(ival.cancelminus, 2),
    arithmetic.cancel_plus: Oracle(ival.cancelplus, 2),
    integer.sign: Oracle(ival.sign),
    integer.floor: Oracle(ival.floor),
    integer.ceil: Oracle(ival.ceil),
    integer.trunc: Oracle(ival.trunc),
    integer.round_ties_to_even: Oracle(ival.roundeven),
    integer.round_ties_to_away: Oracle(ival.round),
    powers.pow: Oracle(ival.pow, 2, 2),
    exponential.exp: Oracle(ival.exp, 1, 1),
    exponential.exp2: Oracle(ival.exp2, 1, 1),
    exponential.exp10: Oracle(ival.exp10, 1, 1),
    exponential.log: Oracle(ival.log, 1, 1),
    exponential.log2: Oracle(ival.log2, 1, 1),
    exponential.log10: Oracle(ival.log10, 1, 1),
    exponential.sinh: Oracle(ival.sinh, 1, 1),
    exponential.cosh: Oracle(ival.cosh, 1, 1),
    exponential.tanh: Oracle(ival.tanh, 1, 1),
    exponential.asinh: Oracle(ival.asinh, 1, 1),
    exponential.acosh: Oracle(ival.acosh, 1, 1),
    exponential.atanh: Oracle(ival.atanh, 1, 1),
    # These three only up to `trigonometric.LARGEST_ANGLE`; beyond it they are sound.
    trigonometric.sin: Oracle(ival.sin, 1, 3),
    trigonometric.cos: Oracle(ival.cos, 1, 3),
    trigonometric.tan: Oracle(ival.tan, 1, 2),
    trigonometric.asin: Oracle(ival.asin, 1, 3),
    trigonometric.acos: Oracle(ival.acos, 1, 3),
    trigonometric.atan: Oracle(ival.atan, 1, 3),
    trigonometric.atan2: Oracle(ival.atan2, 2, 4),
    trigonometric.hypot: Oracle(ival.hypot, 2, 1),
}

# Powers and roots with a whole exponent, which comes last: sound for every exponent, at most one double wider than tight for ordinary ones.
WITH_EXPONENT: dict[Any, Oracle] = {powers.pown: Oracle(ival.pown, 1, 1), powers.rootn: Oracle(ival.rootn, 1, 1)}
EXPONENTS = (-1001, -100, -7, -4, -3, -2, -1, 1, 2, 3, 4, 5, 8, 13, 100, 1001, 10**6)


def wider(kernel: Any, *operands: Pairs) -> npt.NDArray[np.int64]:
    """Return by how many doubles a kernel's results are wider than tight; negative where they lose something."""
    return slack(tight(ORACLES[kernel].function, *operands), rows(kernel, *operands))


def kernels_of(module: Any) -> list[Any]:
    """Return the kernels of a module that have an oracle."""
    return [kernel for kernel in ORACLES if kernel.py_func.__module__ == module.__name__]
