"""Sine, cosine, tangent, their inverses, angle and length as compiled kernels on pairs of bounds, after IEEE 1788-2015, table 9.1.

Bounds are passed and returned as in `ial.contractors.intervals.arithmetic`. Angles are in radians. Results are sound and within a few
doubles of tight. The platform's ``asin``, ``acos``, ``atan`` and ``atan2`` are trusted to be right within one unit in the last place; the
others rest on nothing but the processor's arithmetic.
"""

import math

import numpy as np

from ial.contractors.intervals.arithmetic import absolute
from ial.contractors.intervals.error_free import (
    enclose,
    enclose_odd,
    fast_two_sum,
    fma,
    quotient,
    root,
    scale,
    scale_outward,
    sum_residual,
    two_product,
    two_sum,
)
from ial.contractors.intervals.sets import unless
from ial.contractors.kernels import kernel
from ial.contractors.margins import ROOT, SERIES, SMALL, TANGENT
from ial.contractors.rounding import down, up

# The nearest doubles to π, π/2 and 2π all lie below the exact number; one bit step above lies beyond it.
PI_LOWER, PI_UPPER = math.pi, math.nextafter(math.pi, 4.0)
TWO_PI_LOWER, TWO_PI_UPPER = 2.0 * PI_LOWER, 2.0 * PI_UPPER
HALF_PI_LOWER, HALF_PI_UPPER = 0.5 * PI_LOWER, 0.5 * PI_UPPER

LARGEST_ANGLE = 1e5  # beyond it, sine and cosine of an interval are [-1, 1]

_LARGE, _SMALL = 2.0**500, 2.0**-400  # lengths beyond these are scaled, so that their squares are in range
_IN_RANGE, _FAR_BELOW = 2.0**-475, 2.0**-200

# π/2 as a sum of three doubles, right to 2^-141. The first has 33 bits, so that its product with a number of quarter turns is exact.
_QUARTER_1, _QUARTER_2, _QUARTER_3 = 1.5707963267341256, 6.077100506506192e-11, 3.5215598651832e-27
_QUARTERS_PER_RADIAN, _HALVES_PER_RADIAN = 2.0 / math.pi, 1.0 / math.pi

# Minimax polynomials in z = r² on |r| <= π/4, found by the Remez exchange:
# sin r = r + r·z·S(z) with a relative error below 2^-57.3, cos r = 1 − z/2 + z²·C(z) with an absolute error below 2^-59.9.
_S0, _S1, _S2 = -0.16666666666666632, 0.008333333333322425, -0.00019841269829816888
_S3, _S4, _S5 = 2.7557313695198854e-06, -2.5050758648158273e-08, 1.5896827595734502e-10
_C0, _C1, _C2 = 0.0416666666666666, -0.0013888888888874138, 2.480158728949172e-05
_C3, _C4, _C5 = -2.7557314355205255e-07, 2.0875723678885297e-09, -1.1359669556869514e-11


@kernel
def _reduce(x):  # type: ignore[no-untyped-def]
    """Return k, r and rest with x = k·π/2 + r + rest, for ``|x|`` <= `LARGEST_ANGLE`; NaN beyond.

    Cody and Waite's reduction. The first difference is exact; what the second and its product round off goes into the rest, because r
    itself may be as small as 2^-61.
    """
    k = np.floor(x * _QUARTERS_PER_RADIAN + 0.5) if abs(x) <= LARGEST_ANGLE else np.nan
    reduced = x - k * _QUARTER_1
    product = k * _QUARTER_2
    r = reduced - product
    return k, r, sum_residual(reduced, -product, r) - fma(k, _QUARTER_2, -product) - k * _QUARTER_3


@kernel
def _sine(r, rest):  # type: ignore[no-untyped-def]
    """Return sin(r + rest) − r, with an error below 0.6u·``|r|`` (u = 2^-53), for ``|r|`` <= π/4."""
    z = r * r
    return r * z * (_S0 + z * (_S1 + z * (_S2 + z * (_S3 + z * (_S4 + z * _S5))))) + rest * (1.0 - 0.5 * z)


@kernel
def _cosine(r, rest):  # type: ignore[no-untyped-def]
    """Return cos(r + rest) as high + low, with an error below 0.12u, for ``|r|`` <= π/4."""
    z = r * r
    half = 0.5 * z
    high = 1.0 - half
    return high, ((1.0 - high) - half) + (z * z * (_C0 + z * (_C1 + z * (_C2 + z * (_C3 + z * (_C4 + z * _C5))))) - r * rest)


@kernel
def sincos(x):  # type: ignore[no-untyped-def]
    """Return sin x and cos x of a number, each wrong by less than one unit in its last place.

    Two bit steps outward (``down(down(s))``, ``up(up(s))``) therefore enclose the exact value. The error is also below 2^-53. The range is
    ``|x|`` <= `LARGEST_ANGLE`; beyond it the result is NaN.
    """
    k, r, rest = _reduce(x)
    sine = r + _sine(r, rest)
    high, low = _cosine(r, rest)
    cosine = high + low
    quadrant = k - 4.0 * np.floor(0.25 * k)
    odd = (quadrant == 1.0) | (quadrant == 3.0)  # `|` instead of `or` here and below: no branch, so that a loop can be vectorized
    s = cosine if odd else sine
    c = sine if odd else cosine
    s = -s if quadrant >= 2.0 else s
    c = -c if (quadrant == 1.0) | (quadrant == 2.0) else c
    return s, c


@kernel
def _between(start, stop, lower, upper, phase):  # type: ignore[no-untyped-def]
    """Return the range of a wave from its values at both bounds; it is (-1)^k at (k + phase)·π."""
    # Rounding may miss an extremum that lies within 1e-10 of a bound. At that bound the wave is nearer to ±1 than its double can tell, and
    # the steps outward reach ±1.
    first = np.ceil(lower * _HALVES_PER_RADIAN - phase)
    last = np.floor(upper * _HALVES_PER_RADIAN - phase)
    low = min(start, stop)
    high = max(start, stop)
    # A value of exactly 0 is the sine of exactly 0.
    low = max(down(down(low)), -1.0) if low != 0.0 else 0.0
    high = min(up(up(high)), 1.0) if high != 0.0 else 0.0
    even = first == 2.0 * np.floor(0.5 * first)
    unknown = (last > first) | (not (lower >= -LARGEST_ANGLE)) | (not (upper <= LARGEST_ANGLE))
    low = -1.0 if unknown | ((last == first) & (not even)) else low
    high = 1.0 if unknown | ((last == first) & even) else high
    return unless(lower > upper, low, high)


@kernel
def sin(lower, upper):  # type: ignore[no-untyped-def]
    """Return {sin x : x in [lower, upper]}; [-1, 1] where ``|x|`` exceeds `LARGEST_ANGLE`."""
    return _between(sincos(lower)[0], sincos(upper)[0], lower, upper, 0.5)


@kernel
def cos(lower, upper):  # type: ignore[no-untyped-def]
    """Return {cos x : x in [lower, upper]}; [-1, 1] where ``|x|`` exceeds `LARGEST_ANGLE`."""
    return _between(sincos(lower)[1], sincos(upper)[1], lower, upper, 0.0)


@kernel
def _tan(x):  # type: ignore[no-untyped-def]
    """Return bounds of tan x for ``|x|`` <= `LARGEST_ANGLE`, and the number of the branch; near 0 of x + x³/3.

    The relative errors of sine (0.63u) and cosine (0.16u) add up to less than u.
    """
    k, r, rest = _reduce(x)
    odd = k - 2.0 * np.floor(0.5 * k) == 1.0
    branch = np.floor(0.5 * (k + (1.0 if r >= 0.0 else 0.0)))  # poles lie where k is odd and r = 0, and no double is one
    sine, sine_rest = fast_two_sum(r, _sine(r, rest))
    cosine, cosine_rest = fast_two_sum(*_cosine(r, rest))
    upper, upper_rest = (-cosine, -cosine_rest) if odd else (sine, sine_rest)
    lower, lower_rest = (sine, sine_rest) if odd else (cosine, cosine_rest)
    high, low = quotient(upper, upper_rest, lower, lower_rest)
    bounds = enclose(high, low, TANGENT * abs(high)) if abs(x) > SMALL else enclose_odd(x, x * (x * x / 3.0), SERIES, 1.0)
    return bounds[0], bounds[1], branch


@kernel
def tan(lower, upper):  # type: ignore[no-untyped-def]
    """Return {tan x : x in [lower, upper]}; the real line around a pole and where ``|x|`` exceeds `LARGEST_ANGLE`."""
    low, _, first = _tan(lower)
    _, high, last = _tan(upper)
    unknown = (first != last) | (not (lower >= -LARGEST_ANGLE)) | (not (upper <= LARGEST_ANGLE))
    return unless(lower > upper, -np.inf if unknown else low, np.inf if unknown else high)


@kernel
def _acute(angle, zero, right, sign):  # type: ignore[no-untyped-def]
    """Return bounds of an angle from 0 to π/2 that is known within one unit in the last place, or exactly; with a sign."""
    lower = HALF_PI_LOWER if right else max(down(down(angle)), 0.0)
    upper = 0.0 if zero else min(up(up(angle)), HALF_PI_UPPER)
    return (lower, upper) if sign >= 0.0 else (-upper, -lower)


@kernel
def _asin(x):  # type: ignore[no-untyped-def]
    near = abs(x)
    return _acute(math.asin(near), near == 0.0, near == 1.0, x)


@kernel
def asin(al, au):  # type: ignore[no-untyped-def]
    """Return {asin x : x in a, −1 <= x <= 1}, from −π/2 to π/2."""
    return unless((al > au) | (al > 1.0) | (au < -1.0), _asin(min(max(al, -1.0), 1.0))[0], _asin(max(min(au, 1.0), -1.0))[1])


@kernel
def _acos(x):  # type: ignore[no-untyped-def]
    angle = math.acos(x)
    lower = PI_LOWER if x == -1.0 else HALF_PI_LOWER if x == 0.0 else max(down(down(angle)), 0.0)
    upper = 0.0 if x == 1.0 else HALF_PI_UPPER if x == 0.0 else min(up(up(angle)), PI_UPPER)
    return lower, upper


@kernel
def acos(al, au):  # type: ignore[no-untyped-def]
    """Return {acos x : x in a, −1 <= x <= 1}, from 0 to π."""
    return unless((al > au) | (al > 1.0) | (au < -1.0), _acos(max(min(au, 1.0), -1.0))[0], _acos(min(max(al, -1.0), 1.0))[1])


@kernel
def _atan(x):  # type: ignore[no-untyped-def]
    near = abs(x)
    return _acute(math.atan(near), near == 0.0, near == np.inf, x)


@kernel
def atan(al, au):  # type: ignore[no-untyped-def]
    """Return {atan x : x in a}, from −π/2 to π/2."""
    return unless(al > au, _atan(al)[0], _atan(au)[1])


@kernel
def _angle_below(y, x):  # type: ignore[no-untyped-def]
    """Return a lower bound of the angle of a point of the upper half plane, the axes exactly."""
    if y == 0.0:
        return 0.0 if x >= 0.0 else PI_LOWER
    if x == 0.0:
        return HALF_PI_LOWER
    return max(down(down(math.atan2(y, x))), 0.0)


@kernel
def _angle_above(y, x):  # type: ignore[no-untyped-def]
    """Return an upper bound of the angle of a point of the upper half plane, the axes exactly."""
    if y == 0.0:
        return 0.0 if x >= 0.0 else PI_UPPER
    if x == 0.0:
        return HALF_PI_UPPER
    return min(up(up(math.atan2(y, x))), PI_UPPER)


@kernel
def _atan2_above(yl, yu, xl, xu):  # type: ignore[no-untyped-def]
    """Return the angles of a box with yl >= 0: the angle falls as x grows, and turns towards the y axis as y grows."""
    if yu == 0.0 and xu <= 0.0:
        return PI_LOWER, PI_UPPER
    lower = _angle_below(yl if xu > 0.0 else yu, xu)
    upper = _angle_above(yu if xl >= 0.0 else yl, xl)
    return lower, upper


@kernel
def atan2(yl, yu, xl, xu):  # type: ignore[no-untyped-def]
    """Return {angle of the point (x, y) : x, y in their intervals, not both 0}, in (-π, π].

    A box that meets the negative x axis and the half plane below it gives [-π, π], rounded outward (IEEE 1788-2015, 9.1). The platform's
    ``atan2`` is trusted to be right within one unit in the last place.
    """
    if yl > yu or xl > xu or (yl == 0.0 and yu == 0.0 and xl == 0.0 and xu == 0.0):
        return np.inf, -np.inf
    if yl >= 0.0:
        return _atan2_above(yl, yu, xl, xu)
    if yu < 0.0 or (yu == 0.0 and xl >= 0.0):
        lower, upper = _atan2_above(-yu, -yl, xl, xu)
        return -upper, -lower
    if xl < 0.0:
        return -PI_UPPER, PI_UPPER
    return -_angle_above(-yl, xl), _angle_above(yu, xl)


@kernel
def _length(x, y):  # type: ignore[no-untyped-def]
    """Return bounds of √(x² + y²) for x, y >= 0.

    Both are scaled so that the larger square and its residual are in range. A square that still underflows is below 2^-140 of the other,
    and so within the error allowed for.
    """
    large, small = max(x, y), min(x, y)
    exponent = -600.0 if large > _LARGE else 600.0 if large < _SMALL else 0.0
    near, far = scale(small, exponent), scale(large, exponent)
    p, p_rest = two_product(far, far)
    q, q_rest = two_product(near, near)
    square, low = two_sum(p, q)
    rest, lost = two_sum(p_rest, q_rest)
    low, also_lost = two_sum(low, rest)
    length, correction = root(*fast_two_sum(square, low))
    certain = (small == 0.0) | ((near > _IN_RANGE) & (near > far * _FAR_BELOW))  # that nothing underflowed, the correction included
    exact = (lost == 0.0) & (also_lost == 0.0) & (correction == 0.0) & certain
    error = 0.0 if exact else ROOT * length
    lower, upper = scale_outward(*enclose(length, correction, error), -exponent)
    return large if large == np.inf else max(lower, large), large if large == np.inf else upper


@kernel
def hypot(al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Return {√(x² + y²) : x in a, y in b}; exact where it is a double."""
    al, au = absolute(al, au)
    bl, bu = absolute(bl, bu)
    return unless((al > au) | (bl > bu), _length(al, bl)[0], _length(au, bu)[1])
