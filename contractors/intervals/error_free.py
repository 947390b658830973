"""Error-free transformations: what a rounded operation lost, and doubles around a number that is known as a sum of two.

Where a comment or a docstring says high + low, the number is an unevaluated sum of two doubles with abs(low) far below abs(high). All
of this holds for rounding to nearest only (see `rounding.check_rounding`).

References
----------
Ogita, Rump, Oishi: Accurate sum and dot product, SIAM Journal on Scientific Computing 26 (2005). Joldes, Muller, Popescu: Tight and
rigorous error bounds for basic building blocks of double-word arithmetic, ACM Transactions on Mathematical Software 44 (2017).
"""

from fractions import Fraction
from typing import Any

import numpy as np
from numba import types

from ial.contractors.kernels import intrinsic, kernel
from ial.contractors.rounding import down, up


def _exact_fma(a: Any, b: Any, c: Any) -> Any:
    """Compute with fractions; `math.fma` comes with Python 3.13 only."""
    if not (np.isfinite(a) and np.isfinite(b)):
        return a * b + c
    if not np.isfinite(c):
        return c
    exact = Fraction(float(a)) * Fraction(float(b)) + Fraction(float(c))
    if exact == 0:
        return a * b + c if a == 0.0 or b == 0.0 else 0.0  # of what is 0 already, the processor knows the sign
    try:
        rounded = float(exact)
    except OverflowError:
        rounded = np.inf
    return np.copysign(rounded, 1.0 if exact > 0 else -1.0)


@intrinsic(_exact_fma)
def _fma(typingctx, a, b, c):  # type: ignore[no-untyped-def]
    """Return a·b + c, rounded once (IEEE 754 fusedMultiplyAdd)."""

    def codegen(context, builder, signature, args):  # type: ignore[no-untyped-def]
        return builder.fma(*args)

    return types.float64(types.float64, types.float64, types.float64), codegen


fma: Any = _fma  # for a type checker, the intrinsic would have a parameter more than a kernel passes


@kernel
def sum_residual(a, b, rounded):  # type: ignore[no-untyped-def]
    """Return a + b − rounded exactly (Knuth's TwoSum); NaN where something is infinite."""
    part = rounded - a
    return (a - (rounded - part)) + (b - part)


@kernel
def two_sum(a, b):  # type: ignore[no-untyped-def]
    """Return high, low with high + low = a + b exactly."""
    high = a + b
    return high, sum_residual(a, b, high)


@kernel
def fast_two_sum(a, b):  # type: ignore[no-untyped-def]
    """Return high, low with high + low = a + b exactly, for abs(a) >= abs(b)."""
    high = a + b
    return high, (a - high) + b


@kernel
def two_product(a, b):  # type: ignore[no-untyped-def]
    """Return high, low with high + low = a·b exactly, unless the product lies below 2^-960 or overflows."""
    high = a * b
    return high, fma(a, b, -high)


@kernel
def quotient(ah, al, bh, bl):  # type: ignore[no-untyped-def]
    """Return high, low near (ah + al) / (bh + bl), with a relative error below 2^-102."""
    high = ah / bh
    return high, (fma(-high, bh, ah) + (al - high * bl)) / bh


@kernel
def root(high, low):  # type: ignore[no-untyped-def]
    """Return high, low near √(high + low), with a relative error below 2^-100; the root of 0 is 0."""
    near = np.sqrt(high)
    return near, 0.0 if near == 0.0 else (fma(-near, near, high) + low) / (2.0 * near)


@kernel
def enclose(high, low, error):  # type: ignore[no-untyped-def]
    """Return doubles below and above every number within `error` of high + low.

    They are the nearest such doubles, but for the rounding of low ± error, which the error has to allow for (below 2^-53 of either). An
    exact number comes with low = error = 0, and is returned twice.
    """
    lower, below = fast_two_sum(high, low - error)
    upper, above = fast_two_sum(high, low + error)
    return down(lower) if below < 0.0 else lower, up(upper) if above > 0.0 else upper


_CUBE_IN_RANGE = 2.0**-300


@kernel
def enclose_odd(x, low, relative, away):  # type: ignore[no-untyped-def]
    """Return doubles below and above x + low, the value at x of an odd function that is near x and a double at 0 only.

    low has an error of at most relative·abs(low), and may have underflowed where abs(x) is below `_CUBE_IN_RANGE`; `away` is 1 if the
    values are farther from 0 than x, else −1.
    """
    lower, upper = enclose(x, low, abs(low) * relative)
    if abs(x) < _CUBE_IN_RANGE:
        lower = down(x) if x * away < 0.0 else x
        upper = up(x) if x * away > 0.0 else x
    return lower, upper


_MANTISSA_TO_INTEGER = 1.5 * 2.0**52  # added to a small whole number, it leaves the number in the last bits of the sum


@kernel
def power_of_two(exponent):  # type: ignore[no-untyped-def]
    """Return 2^exponent for a whole number, given as a double, from -1022 to 1023."""
    return np.int64((np.float64(exponent + (_MANTISSA_TO_INTEGER + 1023.0)).view(np.int64)) << 52).view(np.float64)


@kernel
def scale(x, exponent):  # type: ignore[no-untyped-def]
    """Return x·2^exponent for a whole number of at most 2000 in size; it is rounded at most once, where it leaves the normal range."""
    half = np.floor(0.5 * exponent)
    return x * power_of_two(half) * power_of_two(exponent - half)


@kernel
def scale_outward(lower, upper, exponent):  # type: ignore[no-untyped-def]
    """Return bounds times 2^exponent, rounded outward where they leave the range of doubles."""
    low = scale(lower, exponent)
    high = scale(upper, exponent)
    # Scaling back tells what rounding did. An infinity steps back to the largest double.
    low = down(low) if scale(low, -exponent) > lower else low
    high = up(high) if scale(high, -exponent) < upper else high
    return low, high


_LEAST_MANTISSA = 0.7071067811865475
_LEAST_NORMAL = 2.0**-1022


@kernel
def split(x):  # type: ignore[no-untyped-def]
    """Return m and a whole number k, a double, with x = m·2^k exactly and m between √½ and √2, for a finite x > 0."""
    small = x < _LEAST_NORMAL
    bits = np.float64(x * 2.0**54 if small else x).view(np.int64)
    k = (bits - np.float64(_LEAST_MANTISSA).view(np.int64)) >> 52
    return np.int64(bits - (k << 52)).view(np.float64), np.float64(k) - (54.0 if small else 0.0)
