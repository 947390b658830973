"""Interval arithmetic as compiled kernels on pairs of bounds, after IEEE 1788-2015, clauses 9.1, 9.3 and 10.5.

An interval is passed as two numbers, lower and upper, and returned as a tuple (lower, upper). The empty set is (inf, -inf), the real line
(-inf, inf); a lower bound is never +inf and an upper bound never -inf otherwise, and no bound is NaN. -0.0 and 0.0 are the same bound. The
processor must round to nearest (see `rounding.check_rounding`).

Every result is *tight*: the smallest interval of doubles around the exact set. An operation rounded to nearest tells by its residual (the
exact result minus the rounded one, of which only the sign matters) whether a bound lies on the wrong side, and only then is it moved by one
bit step. The residual of a sum comes from Knuth's TwoSum; that of a product, a quotient or a root from one fused multiply-add.
Kernels choose between values instead of branching (``|`` instead of ``or``), so that a loop over them can be vectorized.
"""

import math

import numpy as np

from ial.contractors.intervals.error_free import fma, sum_residual, two_product, two_sum
from ial.contractors.intervals.sets import unless
from ial.contractors.kernels import kernel
from ial.contractors.rounding import down, stepped, up

# Below these magnitudes a residual could underflow to zero and hide that a result is inexact; operands are then scaled, which is exact.
_SMALL = 2.0**-960
_SCALE = 2.0**600
_ROOT_SCALE = 2.0**300  # the square root of the scale
_LARGE = 2.0**1000


@kernel
def _product(a, b):  # type: ignore[no-untyped-def]
    """Return a·b to nearest, with 0·∞ = 0."""
    product = a * b
    return product if product == product else 0.0


@kernel
def _product_residual(a, b, rounded):  # type: ignore[no-untyped-def]
    """Return a number with the sign of a·b − rounded; NaN where a factor is infinite."""
    scale = _SCALE if abs(rounded) < _SMALL else 1.0
    return fma(a * scale, b * scale, -(rounded * scale * scale))


@kernel
def _quotient_residual(a, b, rounded):  # type: ignore[no-untyped-def]
    """Return a number with the sign of a / b − rounded for b > 0; NaN where a or b is infinite or b is 0."""
    scale = _SCALE if abs(a) < _SMALL else 1.0
    return fma(-(rounded * scale), b, a * scale)


@kernel
def _root_residual(a, rounded):  # type: ignore[no-untyped-def]
    """Return a number with the sign of √a − rounded; NaN where a is infinite."""
    small = abs(a) < _SMALL
    root = rounded * _ROOT_SCALE if small else rounded
    return fma(-root, root, a * _SCALE if small else a)


@kernel
def add(al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Return a + b."""
    lower = al + bl
    upper = au + bu
    # The residual of a sum that overflowed is NaN: the step leads back from the infinity. A true infinity stays where it is.
    lower = lower if sum_residual(al, bl, lower) >= 0.0 else down(lower)
    upper = upper if sum_residual(au, bu, upper) <= 0.0 else up(upper)
    return unless((al > au) | (bl > bu), lower, upper)


@kernel
def neg(al, au):  # type: ignore[no-untyped-def]
    """Return −a."""
    return -au, -al


@kernel
def sub(al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Return a − b."""
    return add(al, au, -bu, -bl)


@kernel
def mul(al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Return a·b: the extreme of the four products of bounds, which keep their order when rounded to nearest."""
    p = _product(al, bl)
    q = _product(al, bu)
    r = _product(au, bl)
    s = _product(au, bu)
    lower = min(min(p, q), min(r, s))
    upper = max(max(p, q), max(r, s))
    ep = _product_residual(al, bl, p)
    eq = _product_residual(al, bu, q)
    er = _product_residual(au, bl, r)
    es = _product_residual(au, bu, s)
    # Exact products may differ where the rounded ones are equal: each that rounded to the bound has a say.
    below = ((p == lower) & (ep < 0.0)) | ((q == lower) & (eq < 0.0)) | ((r == lower) & (er < 0.0)) | ((s == lower) & (es < 0.0))
    above = ((p == upper) & (ep > 0.0)) | ((q == upper) & (eq > 0.0)) | ((r == upper) & (er > 0.0)) | ((s == upper) & (es > 0.0))
    lower = down(lower) if below else lower
    upper = up(upper) if above else upper
    return unless((al > au) | (bl > bu), lower, upper)


@kernel
def div(al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Return a / b: the hull of the quotients with a divisor other than 0 (IEEE 1788-2015, 10.5.3); empty for b = [0, 0]."""
    empty = (al > au) | (bl > bu) | ((bl == 0.0) & (bu == 0.0))
    zero = (al == 0.0) & (au == 0.0)
    everything = (bl < 0.0) & (bu > 0.0)
    # A divisor <= 0 changes sign together with a. Adding 0.0 makes -0.0 into 0.0, so that dividing by it gives the right infinity.
    flip = bl < 0.0
    nl, nu = (-au, -al) if flip else (al, au)
    dl, du = (-bu + 0.0, -bl) if flip else (bl + 0.0, bu)
    low_divisor = du if nl >= 0.0 else dl
    high_divisor = dl if nu > 0.0 else du
    lower = nl / low_divisor
    upper = nu / high_divisor
    lower = down(lower) if _quotient_residual(nl, low_divisor, lower) < 0.0 else lower
    upper = up(upper) if _quotient_residual(nu, high_divisor, upper) > 0.0 else upper
    lower = 0.0 if zero else -np.inf if everything else lower
    upper = 0.0 if zero else np.inf if everything else upper
    return unless(empty, lower, upper)


@kernel
def recip(al, au):  # type: ignore[no-untyped-def]
    """Return {1 / x : x in a, x != 0}."""
    return div(1.0, 1.0, al, au)


@kernel
def div_pieces(al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Return the one or two intervals of {x : x·b meets a}, the lower one first, as four bounds (IEEE 1788-2015, 10.5.5).

    Two where b has points on both sides of 0 and a is apart from 0; otherwise the second is empty. The real line where both hold 0, since
    x·0 = 0 holds for every x; in that alone it exceeds `div`.
    """
    both = (bl < 0.0) & (bu > 0.0)
    everything = (al <= 0.0) & (au >= 0.0) & (bl <= 0.0) & (bu >= 0.0)
    positive = au < 0.0  # which part of b gives the negative quotients
    left = 0.0 if both & positive else bl
    right = 0.0 if both & (not positive) else bu
    other_left = bl if positive else 0.0
    other_right = 0.0 if positive else bu
    lower, upper = div(al, au, left, right)
    other_lower, other_upper = div(al, au, other_left, other_right)
    lower, upper = (-np.inf, np.inf) if everything else (lower, upper)
    other_lower, other_upper = unless(everything | (not both), other_lower, other_upper)
    return lower, upper, other_lower, other_upper


@kernel
def product_at_most(a, b, c):  # type: ignore[no-untyped-def]
    """Return whether a·b <= c, exactly, for numbers a and b and an upper bound c; 0·∞ = 0."""
    product = _product(a, b)
    return (product < c) | ((product == c) & (not _product_residual(a, b, product) > 0.0))  # NaN where both are infinite


@kernel
def sqr(al, au):  # type: ignore[no-untyped-def]
    """Return {x² : x in a}."""
    small, large = absolute(al, au)
    lower = small * small
    upper = large * large
    lower = stepped(lower, -1 if _product_residual(small, small, lower) < 0.0 else 0)
    upper = stepped(upper, 1 if _product_residual(large, large, upper) > 0.0 else 0)
    return unless(al > au, lower, upper)


@kernel
def square_within(x, al, au):  # type: ignore[no-untyped-def]
    """Return whether x² is in a, exactly, for a number x."""
    square = x * x
    residual = _product_residual(x, x, square)
    return ((square > al) | ((square == al) & (residual >= 0.0))) & ((square < au) | ((square == au) & (residual <= 0.0)))


@kernel
def sqrt(al, au):  # type: ignore[no-untyped-def]
    """Return {√x : x in a, x >= 0}."""
    empty = (al > au) | (au < 0.0)
    al = max(al, 0.0)
    au = max(au, 0.0)
    lower = np.sqrt(al)
    upper = np.sqrt(au)
    lower = stepped(lower, -1 if _root_residual(al, lower) < 0.0 else 0)
    upper = stepped(upper, 1 if _root_residual(au, upper) > 0.0 else 0)
    return unless(empty, lower, upper)


@kernel
def absolute(al, au):  # type: ignore[no-untyped-def]
    """Return the absolute values of an interval."""
    return max(0.0, max(al, -au)), max(-al, au)


@kernel
def minimum(al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Return {min(x, y) : x in a, y in b}."""
    return unless((al > au) | (bl > bu), min(al, bl), min(au, bu))


@kernel
def maximum(al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Return {max(x, y) : x in a, y in b}."""
    return unless((al > au) | (bl > bu), max(al, bl), max(au, bu))


@kernel
def cancel_minus(al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Return the smallest z with b + z enclosing a, which undoes the addition of b (IEEE 1788-2015, 9.2, 10.5.6).

    The real line where there is none: an operand is unbounded, b is empty and a is not, or b is wider than a.
    """
    bounded = (al > -np.inf) & (au < np.inf) & (bl > -np.inf) & (bu < np.inf)
    lower, upper = sub(al, al, bl, bl)[0], sub(au, au, bu, bu)[1]
    # b is wider than a if al − bl > au − bu. Rounded differences keep their order; if they are equal, the residuals have it. Differences
    # that overflow are halved first, exactly, since all numbers in them are then large.
    half = 0.5 if (abs(al - bl) == np.inf) & (abs(au - bu) == np.inf) else 1.0
    low, low_rest = two_sum(half * al, -(half * bl))
    high, high_rest = two_sum(half * au, -(half * bu))
    fits = (low < high) | ((low == high) & (low_rest <= high_rest))
    if al > au:
        return (np.inf, -np.inf) if (bl > bu) | ((bl > -np.inf) & (bu < np.inf)) else (-np.inf, np.inf)
    return (lower, upper) if bounded & (bl <= bu) & fits else (-np.inf, np.inf)


@kernel
def cancel_plus(al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Return `cancel_minus` of a and −b."""
    return cancel_minus(al, au, -bu, -bl)


@kernel
def _sum_sign(a, b, c, d):  # type: ignore[no-untyped-def]
    """Return a number with the sign of a + b + c + d, for b the residual of a product rounded to a.

    An expansion that grows by one number at a time (Shewchuk 1997, figure 6): exact, with its largest part decisive.
    """
    q, h1 = two_sum(c, b)
    q, h2 = two_sum(q, a)
    p, g1 = two_sum(d, h1)
    p, g2 = two_sum(p, h2)
    p, g3 = two_sum(p, q)
    return p if p != 0.0 else g3 if g3 != 0.0 else g2 if g2 != 0.0 else g1


@kernel
def _fused_below(a, b, c):  # type: ignore[no-untyped-def]
    """Return a·b + c rounded down; 0·∞ = 0."""
    product = _product(a, b)
    if abs(product + c) == np.inf and (abs(a) == np.inf or abs(b) == np.inf or abs(c) == np.inf):
        return product + c
    if a == 0.0 or b == 0.0:
        return c
    rounded = fma(a, b, c)
    if abs(rounded) == np.inf:
        return down(rounded)
    if abs(product) > _SMALL and abs(product) < _LARGE and abs(c) < _LARGE:
        high, low = two_product(a, b)
        return down(rounded) if _sum_sign(high, low, c, -rounded) < 0.0 else rounded
    # Elsewhere the factors are brought near 1, and the rest to the same scale. A summand far above the product is what the sum rounds to;
    # of one far below the product only the sign matters, and any small number has it.
    fa, ea = math.frexp(a)
    fb, eb = math.frexp(b)
    fc, ec = math.frexp(c)
    high, low = two_product(fa, fb)
    if c != 0.0 and ec - ea - eb > 100:
        return down(rounded) if high < 0.0 else rounded
    shift = ec - ea - eb if ec - ea - eb > -300 else -300
    half = -(ea + eb) // 2
    scaled = math.ldexp(math.ldexp(rounded, half), -(ea + eb) - half)
    return down(rounded) if _sum_sign(high, low, math.ldexp(fc, shift), -scaled) < 0.0 else rounded


@kernel
def multiply_add(al, au, bl, bu, cl, cu):  # type: ignore[no-untyped-def]
    """Return a·b + c, rounded once (IEEE 1788-2015, table 9.1, fma)."""
    if al > au or bl > bu or cl > cu:
        return np.inf, -np.inf
    # Which products of bounds are the extremes follows from signs; two remain in question where both factors have points on both sides.
    if al >= 0.0 or au <= 0.0:
        if au <= 0.0:
            al, au, bl, bu = -au, -al, -bu, -bl
        low_a, high_a = al if bl >= 0.0 else au, au if bu >= 0.0 else al
        return _fused_below(low_a, bl, cl), -_fused_below(-high_a, bu, -cu)
    if bl >= 0.0 or bu <= 0.0:
        if bu <= 0.0:
            al, au, bl, bu = -au, -al, -bu, -bl
        return _fused_below(al, bu, cl), -_fused_below(-au, bu, -cu)
    lower = min(_fused_below(al, bu, cl), _fused_below(au, bl, cl))
    upper = max(-_fused_below(-al, bl, -cu), -_fused_below(-au, bu, -cu))
    return lower, upper
