"""Powers and roots as compiled kernels on pairs of bounds, after IEEE 1788-2015, table 9.1 and clause 10.5.

Bounds are passed and returned as in `ial.contractors.intervals.arithmetic`. A power with a whole exponent is a product of sums of two
doubles; it is exact where the power is a double, and tight unless the exact value lies within abs(n)·2^-102 of one. A root is e^(log(x) /
n), exact where it is a double, else at most one double wider than tight. For an exponent that is not whole the platform's ``pow`` is
trusted to be right within one unit in the last place.
"""

import numpy as np

from ial.contractors.intervals.arithmetic import absolute, recip, sqr, sqrt
from ial.contractors.intervals.error_free import (
    enclose,
    fast_two_sum,
    fma,
    power_of_two,
    quotient,
    scale,
    scale_outward,
    split,
    two_product,
)
from ial.contractors.intervals.exp_log import exp_number, log_number
from ial.contractors.kernels import kernel
from ial.contractors.margins import EXPONENT, PRODUCT, QUOTIENT
from ial.contractors.rounding import down, up

_FAR_FROM_ONE = 2.0**100


@kernel
def _multiply(ah, al, bh, bl):  # type: ignore[no-untyped-def]
    """Return (ah + al)·(bh + bl) as high + low, and a bound of the relative error that this adds.

    It is at most 6·2^-106 (Joldes, Muller, Popescu 2017, algorithm 11), and 0 for two doubles or for a factor 1.
    """
    exact = (al == 0.0) & (bl == 0.0) | (ah == 1.0) & (al == 0.0)
    high, low = two_product(ah, bh)
    high, low = fast_two_sum(high, low + fma(ah, bl, al * bh))
    return high, low, 0.0 if exact else PRODUCT


@kernel
def _near_one(high, low, exponent):  # type: ignore[no-untyped-def]
    """Return (high + low)·2^exponent with its high part between √½ and √2 if it had gone far from 1."""
    if 1.0 / _FAR_FROM_ONE < high < _FAR_FROM_ONE:
        return high, low, exponent
    mantissa, k = split(high)
    return mantissa, low * power_of_two(-k), exponent + k


@kernel
def _power(x, n):  # type: ignore[no-untyped-def]
    """Return x^n for a finite x > 0 and a whole number n, as (high + low)·2^exponent, and a bound of the relative error of high + low.

    By repeated squaring, and one division where n is negative. Exponents beyond 2^53 are rounded, but then far out of range.
    """
    base, base_exponent = split(x)
    base_low, base_error = 0.0, 0.0
    high, low, exponent, error = 1.0, 0.0, 0.0, 0.0
    left = np.uint64(n) if n >= 0 else np.uint64(-(n + 1)) + np.uint64(1)
    while True:
        if left & np.uint64(1):
            high, low, added = _multiply(high, low, base, base_low)
            error += base_error + added
            high, low, exponent = _near_one(high, low, exponent + base_exponent)
        left >>= np.uint64(1)
        if left == 0:
            break
        base, base_low, added = _multiply(base, base_low, base, base_low)
        base_error += base_error + added
        base, base_low, base_exponent = _near_one(base, base_low, 2.0 * base_exponent)
    if n < 0 and not (high == 1.0 and low == 0.0 and error == 0.0):
        high, low = quotient(1.0, 0.0, high, low)
        error += QUOTIENT
    return high, low, exponent if n >= 0 else -exponent, 1.5 * error


@kernel
def _scaled(lower, upper, exponent):  # type: ignore[no-untyped-def]
    """Return bounds times 2^exponent, with an exponent of any size."""
    return scale_outward(lower, upper, min(max(exponent, -1900.0), 1900.0))


@kernel
def _limit(x, exponent):  # type: ignore[no-untyped-def]
    """Return the limit of a power at x = 0 or x = ∞ for an exponent other than 0."""
    return np.inf if (x == np.inf) == (exponent > 0) else 0.0


@kernel
def _power_bounds(x, n):  # type: ignore[no-untyped-def]
    """Return bounds of x^n for n != 0, for x < 0 those of −abs(x)^n."""
    near = abs(x)
    if near == 0.0 or near == np.inf:
        lower = upper = _limit(near, n)
    else:
        high, low, exponent, error = _power(near, n)
        lower, upper = enclose(high, low, error * high)
        lower, upper = _scaled(lower, upper, exponent)
    return (lower, upper) if x >= 0.0 else (-upper, -lower)


@kernel
def pown(al, au, n):  # type: ignore[no-untyped-def]
    """Return {x^n : x in a} for an integer n (int64); x^0 is 1 everywhere, and 0 has no negative power."""
    if al > au or (n < 0 and al == 0.0 and au == 0.0):
        return np.inf, -np.inf
    if n == 0:
        return 1.0, 1.0
    if n == 1 or n == -1:
        return (al, au) if n == 1 else recip(al, au)
    if n == 2:
        return sqr(al, au)
    if n % 2 == 0:
        al, au = absolute(al, au)
    elif n < 0 and al < 0.0 < au:
        return -np.inf, np.inf
    first, last = (al, au) if n > 0 else (au, al)
    return -np.inf if n < 0 and au == 0.0 else _power_bounds(first, n)[0], _power_bounds(last, n)[1]


@kernel
def _root_bounds(x, n):  # type: ignore[no-untyped-def]
    """Return bounds of the positive n-th root of abs(x) for n not −1, 0 or 1, with the sign of x."""
    near = abs(x)
    if near == 0.0 or near == np.inf:
        lower = upper = _limit(near, n)
    else:
        count = float(n)
        log_high, log_low, log_error = log_number(near, 0.0, 0.0)
        high, low, error, k = exp_number(*quotient(*fast_two_sum(log_high, log_low), count, 0.0))
        # An error of the exponent is one of the root, relative to it, which is below 1.5·2^k. n as a double is off by less than a part in
        # 2^53, and only where the exponent is below 2^-43.
        error += 1.5 * log_error / abs(count) + EXPONENT
        lower, upper = enclose(high, low, error)
        nearest, rest = fast_two_sum(high, low)
        lower, upper = scale_outward(lower, upper, k)
        if abs(rest) <= error:  # else it is no double
            nearest = scale(nearest, k)
            power, power_low, exponent, power_error = _power(nearest, n)
            if power_low == 0.0 and power_error == 0.0 and _scaled(power, power, exponent)[0] == near:
                lower = upper = nearest
    return (lower, upper) if x >= 0.0 else (-upper, -lower)


@kernel
def rootn(al, au, n):  # type: ignore[no-untyped-def]
    """Return {y : y^n in a} for an integer n (int64), for an even n only y >= 0; empty for n = 0."""
    if n % 2 == 0:
        al = max(al, 0.0)
    if al > au or n == 0 or (n < 0 and al == 0.0 and au == 0.0):
        return np.inf, -np.inf
    if n == 1 or n == -1:
        return (al, au) if n == 1 else recip(al, au)
    if n == 2:
        return sqrt(al, au)
    if n < 0 and al < 0.0 < au:
        return -np.inf, np.inf
    first, last = (al, au) if n > 0 else (au, al)
    return -np.inf if n < 0 and au == 0.0 else _root_bounds(first, n)[0], _root_bounds(last, n)[1]


@kernel
def _pow_bounds(x, y):  # type: ignore[no-untyped-def]
    """Return bounds of x^y for 0 <= x <= ∞ and any y, with its limits at 0 and ∞, where x^0 = 1^y = 1."""
    near = x**y
    if x == 0.0 or x == 1.0 or x == np.inf or y == 0.0 or abs(y) == np.inf:
        return near, near
    if y == np.floor(y) and abs(y) < 2.0**31:
        return _power_bounds(x, int(y))
    large = (x > 1.0) == (y > 0.0)  # on which side of 1 the power lies
    return max(down(down(near)), 1.0 if large else 0.0), min(up(up(near)), np.inf if large else 1.0)


@kernel
def pow(al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Return {x^y : x in a, y in b} where it is defined: for x > 0, and for x = 0 with y > 0.

    x^y = e^(y·log x) is extreme where y·log x is: at corners that follow from the signs of y and of log x.
    """
    if al > au or bl > bu or au < 0.0 or (au == 0.0 and bu <= 0.0):
        return np.inf, -np.inf
    if au == 0.0:
        return 0.0, 0.0
    al = max(al, 0.0) + 0.0  # never -0.0, which has powers of its own
    if bl >= 0.0:
        return _pow_bounds(al, bl if al >= 1.0 else bu)[0], _pow_bounds(au, bu if au >= 1.0 else bl)[1]
    if bu <= 0.0:
        return _pow_bounds(au, bl if au >= 1.0 else bu)[0], _pow_bounds(al, bu if al >= 1.0 else bl)[1]
    lower = min(_pow_bounds(al, bu)[0], _pow_bounds(au, bl)[0])
    upper = max(_pow_bounds(al, bl)[1], _pow_bounds(au, bu)[1])
    return lower, upper
