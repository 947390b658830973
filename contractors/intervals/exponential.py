"""Exponentials, logarithms and hyperbolic functions as compiled kernels on pairs of bounds, after IEEE 1788-2015, table 9.1.

Bounds are passed and returned as in `ial.contractors.intervals.arithmetic`. Nothing here rests on the platform's mathematical library: each
function of a number gives high + low and a bound of the error, and `error_free.enclose` rounds that outward. A bound is therefore tight
unless the exact value happens to lie within this error of a double, and then one double wider. The error is 0 where the value is a double:
e^0, 2^k, 10^k, log 1, log2 2^k, log10 10^k. u = 2^-53 is half a unit in the last place of 1.
"""

import numpy as np

from ial.contractors.intervals.arithmetic import absolute
from ial.contractors.intervals.error_free import (
    enclose,
    enclose_odd,
    fast_two_sum,
    power_of_two,
    quotient,
    root,
    scale_outward,
    two_product,
    two_sum,
)
from ial.contractors.intervals.exp_log import exp_number, exp_reduced, log_number, log_reduced
from ial.contractors.intervals.sets import unless
from ial.contractors.kernels import kernel
from ial.contractors.margins import ABOVE, CHANGE_OF_BASE, COMPOSED, HALVES, HYPERBOLIC_SINE, ROUNDINGS, SERIES, SMALL

# Constants as the nearest double and the double nearest to the rest.
_LN2, _LN2_REST = 0.6931471805599453, 2.3190468138462996e-17
_LN10, _LN10_REST = 2.302585092994046, -2.1707562233822494e-16
_LOG2_E, _LOG2_E_REST = 1.4426950408889634, 2.0355273740931033e-17
_LOG10_E, _LOG10_E_REST = 0.4342944819032518, 1.098319650216765e-17

# sinh x = x + x·z·H(z) with z = x² for abs(x) <= 1/2, H with a relative error below 2^-53.9.
_H0, _H1, _H2 = 0.16666666666666666, 0.00833333333333336, 0.0001984126984114733
_H3, _H4, _H5 = 2.7557319433240906e-06, 2.5051946883168892e-08, 1.611646875839379e-10

_POWERS_OF_TEN = np.array([float(10**k) for k in range(23)])  # those that are doubles


@kernel
def _exp_bounds(high, low, error, k):  # type: ignore[no-untyped-def]
    """Return bounds of (high + low)·2^k."""
    lower, upper = enclose(high, low, error)
    return scale_outward(lower, upper, k)


@kernel
def exp(al, au):  # type: ignore[no-untyped-def]
    """Return {e^x : x in a}."""
    lower = _exp_bounds(*exp_number(al, 0.0))[0]
    upper = _exp_bounds(*exp_number(au, 0.0))[1]
    return unless(al > au, lower, upper)


@kernel
def _exp2(x):  # type: ignore[no-untyped-def]
    """Return bounds of 2^x: x less the nearest whole number is exact."""
    x = min(max(x, -1600.0), 1600.0)
    k = np.floor(x + 0.5)
    r, rest = two_product(x - k, _LN2)
    high, low, error = exp_reduced(r, rest + (x - k) * _LN2_REST)
    return _exp_bounds(high, low, error, k)


@kernel
def exp2(al, au):  # type: ignore[no-untyped-def]
    """Return {2^x : x in a}; exact for whole numbers."""
    return unless(al > au, _exp2(al)[0], _exp2(au)[1])


@kernel
def _exp10(x):  # type: ignore[no-untyped-def]
    """Return bounds of 10^x = e^(x·ln 10)."""
    x = min(max(x, -400.0), 400.0)
    product, rest = two_product(x, _LN10)
    high, low, error, k = exp_number(product, rest + x * _LN10_REST)
    # Where the power is a double, it is the one nearest to high + low.
    exact = (x == np.floor(x)) & (x >= 0.0) & (x <= 22.0)
    high, low = fast_two_sum(high, low)
    return _exp_bounds(high, 0.0 if exact else low, 0.0 if exact else error, k)


@kernel
def exp10(al, au):  # type: ignore[no-untyped-def]
    """Return {10^x : x in a}; exact for whole numbers from 0 to 22."""
    return unless(al > au, _exp10(al)[0], _exp10(au)[1])


@kernel
def _log2(x):  # type: ignore[no-untyped-def]
    """Return log2 x = k + log(m) / ln 2 as high + low and a bound of its error."""
    k, f, middle, low, error = log_reduced(x, 0.0)
    f, low = fast_two_sum(f, middle + low)
    product, rest = two_product(f, _LOG2_E)
    high, residual = two_sum(k, product)
    low = residual + (rest + (low * _LOG2_E + f * _LOG2_E_REST))
    return high, low, 1.5 * error + abs(product) * CHANGE_OF_BASE


@kernel
def _log10(x):  # type: ignore[no-untyped-def]
    """Return log10 x = log(x) / ln 10 as high + low and a bound of its error."""
    high, low, error = log_number(x, 0.0, 0.0)
    high, low = fast_two_sum(high, low)
    product, rest = two_product(high, _LOG10_E)
    nearest = np.rint(product)
    exact = (nearest >= 0.0) & (nearest <= 22.0) & (_POWERS_OF_TEN[int(nearest) if 0.0 <= nearest <= 22.0 else 0] == x)
    low = rest + (low * _LOG10_E + high * _LOG10_E_REST)
    error = 0.5 * error + abs(product) * CHANGE_OF_BASE
    return nearest if exact else product, 0.0 if exact else low, 0.0 if exact else error


@kernel
def _log_range(al, au, lower, upper):  # type: ignore[no-untyped-def]
    """Return the bounds of a logarithm, minus infinity where a reaches 0; empty where no point of a is positive."""
    return unless((al > au) | (au <= 0.0), lower if al > 0.0 else -np.inf, upper if au < np.inf else np.inf)


@kernel
def log(al, au):  # type: ignore[no-untyped-def]
    """Return {log x : x in a, x > 0}, the natural logarithm."""
    return _log_range(al, au, enclose(*log_number(al, 0.0, 0.0))[0], enclose(*log_number(au, 0.0, 0.0))[1])


@kernel
def log2(al, au):  # type: ignore[no-untyped-def]
    """Return {log2 x : x in a, x > 0}; exact for powers of two."""
    return _log_range(al, au, enclose(*_log2(al))[0], enclose(*_log2(au))[1])


@kernel
def log10(al, au):  # type: ignore[no-untyped-def]
    """Return {log10 x : x in a, x > 0}; exact for powers of ten from 1 to 1e22."""
    return _log_range(al, au, enclose(*_log10(al))[0], enclose(*_log10(au))[1])


@kernel
def _halves(x):  # type: ignore[no-untyped-def]
    """Return, for x >= 0, 2·sinh x and 2·cosh x, both as (high + low)·2^k, with bounds of their errors, and the relative error of e^x.

    With E = e^x·2^-k they are E ∓ 4^-k / E, and an error of E goes into them multiplied by 1 ± 4^-k / E².
    """
    high, low, error, k = exp_number(x, 0.0)
    high, low = fast_two_sum(high, low)
    inverse, rest = quotient(1.0, 0.0, high, low)
    factor = power_of_two(max(-2.0 * k, -1000.0))  # where this is too large, what it stands for is far below the error
    passed = inverse * inverse * factor
    sine, sine_rest = two_sum(high, -(inverse * factor))
    cosine, cosine_rest = two_sum(high, inverse * factor)
    sine_error, cosine_error = error * (1.0 + passed) + HALVES, error * abs(1.0 - passed) + HALVES
    return (
        sine,
        sine_rest + (low - rest * factor),
        sine_error,
        cosine,
        cosine_rest + (low + rest * factor),
        cosine_error,
        k,
        error * inverse,
    )


@kernel
def _sinh_rest(x):  # type: ignore[no-untyped-def]
    """Return sinh x − x for abs(x) <= 1/2, with a relative error below 5u."""
    z = x * x
    return x * (z * (_H0 + z * (_H1 + z * (_H2 + z * (_H3 + z * (_H4 + z * _H5))))))


@kernel
def _sinh(x):  # type: ignore[no-untyped-def]
    """Return bounds of sinh x."""
    if abs(x) < 0.5:
        return enclose_odd(x, _sinh_rest(x), HYPERBOLIC_SINE, 1.0)
    high, low, error, _, _, _, k, _ = _halves(abs(x))
    sign = 1.0 if x > 0.0 else -1.0
    return _exp_bounds(sign * high, sign * low, error, k - 1.0)


@kernel
def sinh(al, au):  # type: ignore[no-untyped-def]
    """Return {sinh x : x in a}."""
    return unless(al > au, _sinh(al)[0], _sinh(au)[1])


@kernel
def _cosh(x):  # type: ignore[no-untyped-def]
    """Return bounds of cosh x for x >= 0."""
    _, _, _, high, low, error, k, _ = _halves(x)
    lower, upper = _exp_bounds(high, low, error, k - 1.0)
    return max(lower, 1.0), 1.0 if x == 0.0 else upper


@kernel
def cosh(al, au):  # type: ignore[no-untyped-def]
    """Return {cosh x : x in a}."""
    smallest, largest = absolute(al, au)
    return unless(al > au, _cosh(smallest)[0], _cosh(largest)[1])


@kernel
def _tanh(x):  # type: ignore[no-untyped-def]
    """Return bounds of tanh x; near 0 of x − x³/3, and from 20 on it rounds to 1."""
    near = min(abs(x), 20.0)
    if near <= SMALL:
        return enclose_odd(x, -x * (x * x / 3.0), SERIES, -1.0)
    sine, sine_rest, _, cosine, cosine_rest, cosine_error, k, relative = _halves(near)
    if near < 0.5:
        twice = power_of_two(1.0 - k)
        rest = _sinh_rest(near) * twice
        high, low = quotient(*fast_two_sum(near * twice, rest), *fast_two_sum(cosine, cosine_rest))
        error = (HYPERBOLIC_SINE * rest + high * cosine_error) / cosine
    else:
        high, low = quotient(*fast_two_sum(sine, sine_rest), *fast_two_sum(cosine, cosine_rest))
        error = relative * (1.0 - high * high + ROUNDINGS)  # an error of e^x is one of x, and the derivative of tanh is 1 − tanh²
    sign = 1.0 if x > 0.0 else -1.0
    lower, upper = enclose(sign * high, sign * low, ABOVE * error + COMPOSED * high)
    return max(lower, -1.0), min(upper, 1.0)


@kernel
def tanh(al, au):  # type: ignore[no-untyped-def]
    """Return {tanh x : x in a}."""
    return unless(al > au, _tanh(al)[0], _tanh(au)[1])


@kernel
def _asinh(x):  # type: ignore[no-untyped-def]
    """Return bounds of asinh x = log(x + √(x² + 1)); near 0 of x − x³/6, far out of log(2x + 1/(2x))."""
    near = abs(x)
    sign = 1.0 if x > 0.0 else -1.0
    if near <= SMALL:
        return enclose_odd(x, -x * (x * x / 6.0), SERIES, -1.0)
    if near == np.inf:
        return x, x
    if near > 2.0**30:
        high, low, error = log_number(near, 0.25 / near, 1.0)
    else:
        square, rest = two_product(near, near)
        square, carry = two_sum(square, 1.0)
        length, length_rest = root(*fast_two_sum(square, rest + carry))
        argument, carry = two_sum(near, length)
        high, low, error = log_number(*fast_two_sum(argument, length_rest + carry), 0.0)
    return enclose(sign * high, sign * low, error + COMPOSED)


@kernel
def asinh(al, au):  # type: ignore[no-untyped-def]
    """Return {asinh x : x in a}."""
    return unless(al > au, _asinh(al)[0], _asinh(au)[1])


@kernel
def _acosh(x):  # type: ignore[no-untyped-def]
    """Return bounds of acosh x = log(x + √(x² − 1)) for x >= 1; far out of log(2x − 1/(2x))."""
    if x == np.inf or x == 1.0:
        return (x, x) if x > 1.0 else (0.0, 0.0)
    if x > 2.0**30:
        high, low, error = log_number(x, -0.25 / x, 1.0)
    else:
        square, rest = two_product(x, x)
        square, carry = two_sum(square, -1.0)
        length, length_rest = root(*two_sum(square, rest + carry))
        argument, carry = two_sum(x, length)
        high, low, error = log_number(*fast_two_sum(argument, length_rest + carry), 0.0)
    return enclose(high, low, error + COMPOSED)


@kernel
def acosh(al, au):  # type: ignore[no-untyped-def]
    """Return {acosh x : x in a, x >= 1}."""
    return unless((al > au) | (au < 1.0), _acosh(max(al, 1.0))[0], _acosh(max(au, 1.0))[1])


@kernel
def _atanh(x):  # type: ignore[no-untyped-def]
    """Return bounds of atanh x = log((1 + x) / (1 − x)) / 2 for abs(x) <= 1; near 0 of x + x³/3."""
    near = abs(x)
    sign = 1.0 if x > 0.0 else -1.0
    if near <= SMALL:
        return enclose_odd(x, x * (x * x / 3.0), SERIES, 1.0)
    if near == 1.0:
        return sign * np.inf, sign * np.inf
    high, low, error = log_number(*quotient(*two_sum(1.0, near), *two_sum(1.0, -near)), 0.0)
    return enclose(0.5 * sign * high, 0.5 * sign * low, 0.5 * error + COMPOSED)


@kernel
def atanh(al, au):  # type: ignore[no-untyped-def]
    """Return {atanh x : x in a, -1 < x < 1}."""
    empty = (al > au) | (al >= 1.0) | (au <= -1.0)
    return unless(empty, _atanh(min(max(al, -1.0), 1.0))[0], _atanh(max(min(au, 1.0), -1.0))[1])
