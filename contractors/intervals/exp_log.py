"""e^x and log x of a number as high + low, ten bits more than a double holds, with a bound of the error.

They are polynomials after an exact reduction of the argument; nothing rests on the platform's mathematical library. u = 2^-53 is half a
unit in the last place of 1. The errors allow for the rounding in `error_free.enclose`.

References
----------
Muller: Elementary Functions, 3rd edition (2016), chapters 3 and 11. The coefficients were found by the Remez exchange.
"""

import numpy as np

from ial.contractors.intervals.error_free import fast_two_sum, fma, split, sum_residual, two_sum
from ial.contractors.kernels import kernel
from ial.contractors.margins import EXPONENTIAL, LOGARITHM, LOGARITHM_REST, REDUCTION

# ln 2 = _LN2_HIGH + _LN2_LOW within 2^-95; the first has 41 bits, so that its product with an exponent is exact.
_LN2_HIGH, _LN2_LOW = 0.693147180559663, 2.8235290563031577e-13
_LOG2_E = 1.4426950408889634

# e^r = 1 + r + r²·E(r) for abs(r) <= ln(2)/2, E with a relative error below 2^-57.
_E0, _E1, _E2, _E3 = 0.5, 0.1666666666666667, 0.041666666666666616, 0.008333333333326167
_E4, _E5, _E6, _E7 = 0.0013888888888917937, 0.00019841269874721503, 2.4801587245792686e-05, 2.755725551332508e-06
_E8, _E9, _E10 = 2.7557349571775454e-07, 2.510517399203018e-08, 2.088938932349166e-09
# log(1 + f) = f − f²/2 + s·(f²/2 + z·L(z)) with s = f / (2 + f), z = s², for 1 + f from √½ to √2, L with a relative error below 2^-53.9.
_L0, _L1, _L2, _L3 = 0.6666666666666666, 0.4000000000000088, 0.28571428570801927, 0.222222223920577
_L4, _L5, _L6, _L7 = 0.18181795606723852, 0.1538624136909464, 0.13268731935874606, 0.13087026355146406

_FAR = 800.0  # e^±800 and all beyond are out of the range of doubles


@kernel
def exp_reduced(r, rest):  # type: ignore[no-untyped-def]
    """Return e^(r + rest) as high + low and a bound of its error, for abs(r) <= 0.35 and abs(rest) <= u·abs(r).

    The polynomial and its product with r² round off less than 2u·r², the two sums after it and that in `enclose` less than 0.6u·r² each;
    the next term of e^rest is far below. For r below 2^-28 the sums may round off more, u·abs(low); low is then at most half a unit in the
    last place of high and keeps its sign, also that of low ± error, which is all that `enclose` makes of it.
    """
    z = r * r
    lower = _E0 + r * (_E1 + r * (_E2 + r * (_E3 + r * (_E4 + r * _E5))))
    upper = _E6 + r * (_E7 + r * (_E8 + r * (_E9 + r * _E10)))
    tail = z * (lower + (z * z * z) * upper)
    high, low = fast_two_sum(1.0, r)
    return high, low + (tail + (rest + rest * r)), EXPONENTIAL * z


@kernel
def exp_number(x, rest):  # type: ignore[no-untyped-def]
    """Return e^(x + rest), abs(rest) <= u·abs(x), as (high + low)·2^k, and a bound of the error of high + low.

    Cody and Waite's reduction to x − k·ln 2; both constants and their products are off by less than k·2^-92.
    """
    x = min(max(x, -_FAR), _FAR)
    k = np.floor(x * _LOG2_E + 0.5)
    reduced = x - k * _LN2_HIGH
    product = k * _LN2_LOW
    r = reduced - product
    rest = (sum_residual(reduced, -product, r) - fma(k, _LN2_LOW, -product)) + rest
    high, low, error = exp_reduced(*fast_two_sum(r, rest))
    return high, low, error + abs(k) * REDUCTION, k


@kernel
def log_reduced(x, rest):  # type: ignore[no-untyped-def]
    """Return k, and log((x + rest)·2^-k) as high + middle + low, and a bound of the error, for x > 0 and abs(rest) <= u·x.

    x·2^-k lies between √½ and √2. All is exact but for s·(…), which is off by less than 11u·abs(s·f²/2) and is itself below 1.5 of that,
    so that the two sums to come round off less than 3u of it; and for the next term of rest, below u²/2, and its quotient.
    """
    m, k = split(x)
    f = m - 1.0
    s = f / (2.0 + f)
    z = s * s
    half = 0.5 * f * f
    half_rest = fma(0.5 * f, f, -half)
    series = z * (_L0 + z * (_L1 + z * (_L2 + z * (_L3 + z * (_L4 + z * (_L5 + z * (_L6 + z * _L7)))))))
    high, middle = two_sum(f, -half)
    low = s * (half + series) + (rest / x - half_rest)
    error = LOGARITHM * abs(s * half) + (LOGARITHM_REST if rest != 0.0 else 0.0)
    return k, high, middle, low, error


@kernel
def log_number(x, rest, exponent):  # type: ignore[no-untyped-def]
    """Return log((x + rest)·2^exponent) as high + low and a bound of its error."""
    k, f, middle, low, error = log_reduced(x, rest)
    k += exponent
    high, residual = two_sum(k * _LN2_HIGH, f)
    low = (residual + middle) + (low + k * _LN2_LOW)
    return high, low, error + (abs(k) * REDUCTION + abs(high) * LOGARITHM_REST)
