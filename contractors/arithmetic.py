"""Interval arithmetic as compiled kernels on pairs of bounds, after IEEE 1788-2015, clauses 9.1, 9.3 and 10.5.

An interval is passed as two numbers, lower and upper, and returned as a tuple (lower, upper). The empty set is (inf, -inf), the real line
(-inf, inf); a lower bound is never +inf and an upper bound never -inf otherwise, and no bound is NaN. -0.0 and 0.0 are the same bound. The
processor must round to nearest (see `rounding.check_rounding`).

Every result is *tight*: the smallest interval of doubles around the exact set. An operation rounded to nearest tells by its residual (the
exact result minus the rounded one, of which only the sign matters) whether a bound lies on the wrong side, and only then is it moved by one
bit step. The residual of a sum comes from Knuth's TwoSum; that of a product, a quotient or a root from one fused multiply-add.
Kernels choose between values instead of branching (``|`` instead of ``or``), so that a loop over them can be vectorized.
"""

from typing import Any

import numpy as np
from numba import types
from numba.extending import intrinsic

from ial.contractors.kernels import kernel
from ial.contractors.rounding import down, up

# Below these magnitudes a residual could underflow to zero and hide that a result is inexact; operands are then scaled, which is exact.
_SMALL = 2.0**-960
_SCALE = 2.0**600
_ROOT_SCALE = 2.0**300  # the square root of the scale


@intrinsic
def _fma(typingctx, a, b, c):  # type: ignore[no-untyped-def]
    """Return a·b + c, rounded once (IEEE 754 fusedMultiplyAdd)."""

    def codegen(context, builder, signature, args):  # type: ignore[no-untyped-def]
        return builder.fma(*args)

    return types.float64(types.float64, types.float64, types.float64), codegen


fma: Any = _fma  # for a type checker, the intrinsic would have a parameter more than a kernel passes


@kernel
def sum_residual(a, b, rounded):  # type: ignore[no-untyped-def]
    """Return a + b − rounded exactly; NaN where something is infinite."""
    part = rounded - a
    return (a - (rounded - part)) + (b - part)


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
def unless(empty, lower, upper):  # type: ignore[no-untyped-def]
    """Return the bounds, or the empty interval."""
    return np.inf if empty else lower, -np.inf if empty else upper


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
def sqr(al, au):  # type: ignore[no-untyped-def]
    """Return {x² : x in a}."""
    small, large = absolute(al, au)
    lower = small * small
    upper = large * large
    lower = down(lower) if _product_residual(small, small, lower) < 0.0 else lower
    upper = up(upper) if _product_residual(large, large, upper) > 0.0 else upper
    return unless(al > au, lower, upper)


@kernel
def sqrt(al, au):  # type: ignore[no-untyped-def]
    """Return {√x : x in a, x >= 0}."""
    empty = (al > au) | (au < 0.0)
    al = max(al, 0.0)
    au = max(au, 0.0)
    lower = np.sqrt(al)
    upper = np.sqrt(au)
    lower = down(lower) if _root_residual(al, lower) < 0.0 else lower
    upper = up(upper) if _root_residual(au, upper) > 0.0 else upper
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
def intersect(al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Return the points of both a and b."""
    lower = max(al, bl)
    upper = min(au, bu)
    return unless(lower > upper, lower, upper)


@kernel
def hull(al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Return the smallest interval around both a and b."""
    return min(al, bl), max(au, bu)
