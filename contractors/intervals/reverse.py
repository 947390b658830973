"""Reverse operations as compiled kernels on pairs of bounds, after IEEE 1788-2015, clause 10.5.4.

A reverse operation answers: which x of a prior interval have f(x) in c? It returns the hull of that set, rounded outward; the prior
[-inf, inf] is none. Bounds are passed and returned as in `ial.contractors.intervals.arithmetic`. A point where f is undefined is no
solution.

`abs_reverse`, `sqr_reverse` and `mul_reverse` are *tight*: the smallest interval of doubles, and empty whenever there is no solution. Most
others are the inverse function met with the prior, and as tight as that function is. The families that need more have files of their own:
`reverse_integer`, `reverse_powers`, `reverse_periodic`, `reverse_polar`; `backward` narrows both operands of an operation at once.
"""

import numpy as np

from ial.contractors.intervals.arithmetic import div_pieces, product_at_most, sqr, sqrt, square_within
from ial.contractors.intervals.exponential import (
    acosh,
    asinh,
    atanh,
    cosh,
    exp,
    exp2,
    exp10,
    log,
    log2,
    log10,
    sinh,
    tanh,
)
from ial.contractors.intervals.sets import hull, intersect, unless
from ial.contractors.kernels import kernel


@kernel
def abs_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return the hull of {x : ``|x|`` in c} within x; tight (IEEE 1788-2015, absRev)."""
    cl = max(cl, 0.0)
    return hull(*intersect(cl, cu, xl, xu), *intersect(-cu, -cl, xl, xu))


@kernel
def _roots(cl, cu, low, high, xl, xu):  # type: ignore[no-untyped-def]
    """Return the roots of c on one side of 0 within x, given bounds of them."""
    lower, upper = intersect(low, high, xl, xu)
    # A root rounded outward may meet the prior in one double only, which need not be a root itself.
    return unless((lower == upper) & (not square_within(lower, cl, cu)), lower, upper)


@kernel
def sqr_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return the hull of {x : x² in c} within x; tight (IEEE 1788-2015, sqrRev)."""
    low, high = sqrt(cl, cu)
    return hull(*_roots(cl, cu, low, high, xl, xu), *_roots(cl, cu, -high, -low, xl, xu))


@kernel
def sqrt_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return {x : √x in c} within x."""
    return intersect(*sqr(*intersect(cl, cu, 0.0, np.inf)), xl, xu)


@kernel
def _solves(x, bl, bu, cl, cu):  # type: ignore[no-untyped-def]
    """Return whether x·b is in c for some b; exact."""
    return product_at_most(x, bl if x >= 0.0 else bu, cu) & product_at_most(-x, bu if x >= 0.0 else bl, -cl)


@kernel
def _piece(bl, bu, cl, cu, low, high, xl, xu):  # type: ignore[no-untyped-def]
    """Return a piece of c / b within x."""
    lower, upper = intersect(low, high, xl, xu)
    # As above: one double is where a bound rounded outward, or one that is a limit only, meets the prior.
    return unless((lower == upper) & (not _solves(lower, bl, bu, cl, cu)), lower, upper)


@kernel
def mul_reverse_pieces(bl, bu, cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return {x : x·b in c for some b} within x as two intervals, the lower one first; either may be empty. Four numbers; tight.

    Without a prior this is `div_pieces`, the two-output division mulRevToPair (IEEE 1788-2015, 10.5.5).
    """
    l1, u1, l2, u2 = div_pieces(cl, cu, bl, bu)
    l1, u1 = _piece(bl, bu, cl, cu, l1, u1, xl, xu)
    l2, u2 = _piece(bl, bu, cl, cu, l2, u2, xl, xu)
    return l1, u1, l2, u2


@kernel
def mul_reverse(bl, bu, cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return the hull of {x : x·b in c for some b} within x; tight (IEEE 1788-2015, mulRev). No limit where 0 is in both b and c."""
    l1, u1, l2, u2 = mul_reverse_pieces(bl, bu, cl, cu, xl, xu)
    return hull(l1, u1, l2, u2)


@kernel
def recip_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return the hull of {x : 1/x in c} within x; tight."""
    return mul_reverse(cl, cu, 1.0, 1.0, xl, xu)


@kernel
def exp_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return {x : exp x in c} within x."""
    return intersect(*log(cl, cu), xl, xu)


@kernel
def exp2_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return {x : 2^x in c} within x."""
    return intersect(*log2(cl, cu), xl, xu)


@kernel
def exp10_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return {x : 10^x in c} within x."""
    return intersect(*log10(cl, cu), xl, xu)


@kernel
def log_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return {x : log x in c} within x."""
    return intersect(*exp(cl, cu), xl, xu)


@kernel
def log2_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return {x : log2 x in c} within x."""
    return intersect(*exp2(cl, cu), xl, xu)


@kernel
def log10_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return {x : log10 x in c} within x."""
    return intersect(*exp10(cl, cu), xl, xu)


@kernel
def sinh_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return {x : sinh x in c} within x."""
    return intersect(*asinh(cl, cu), xl, xu)


@kernel
def cosh_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return the hull of {x : cosh x in c} within x (IEEE 1788-2015, coshRev)."""
    return abs_reverse(*acosh(cl, cu), xl, xu)


@kernel
def tanh_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return {x : tanh x in c} within x."""
    return intersect(*atanh(cl, cu), xl, xu)


@kernel
def asinh_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return {x : asinh x in c} within x."""
    return intersect(*sinh(cl, cu), xl, xu)


@kernel
def acosh_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return {x : acosh x in c} within x."""
    return intersect(*cosh(*intersect(cl, cu, 0.0, np.inf)), xl, xu)


@kernel
def atanh_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return {x : atanh x in c} within x."""
    return intersect(*tanh(cl, cu), xl, xu)
