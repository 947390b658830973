"""Reverse operations of powers and roots as compiled kernels on pairs of bounds (see `ial.contractors.intervals.reverse`).

Bounds are within a few bits of tight where forward powers are. A power with a real exponent is that of IEEE 1788-2015, table 9.1: defined
for a base above 0, and for the base 0 with an exponent above 0.
"""

import numpy as np

from ial.contractors.intervals.arithmetic import recip
from ial.contractors.intervals.backward import both
from ial.contractors.intervals.exponential import log2
from ial.contractors.intervals.powers import pow, pown, rootn
from ial.contractors.intervals.reverse import abs_reverse, mul_reverse, recip_reverse, sqr_reverse
from ial.contractors.intervals.sets import hull, intersect, unless
from ial.contractors.kernels import kernel

_LARGEST_EXPONENT = 2.0**31  # of a power that is reversed as an integer one


@kernel
def pown_reverse(cl, cu, xl, xu, n):  # type: ignore[no-untyped-def]
    """Return the hull of {x : x^n in c} within x, for an integer n (IEEE 1788-2015, pownRev); tight for n from -1 to 2."""
    if n == 0:
        return unless((cl > 1.0) | (cu < 1.0), xl, xu)
    if n == 2:
        return sqr_reverse(cl, cu, xl, xu)
    low, high = (cl, cu) if abs(n) == 1 else rootn(cl, cu, abs(n))
    if n % 2 == 0:
        low, high = (low, high) if n > 0 else recip(low, high)  # after the root, since 1/c might overflow where 1/root does not
        return abs_reverse(low, high, xl, xu)
    return intersect(low, high, xl, xu) if n > 0 else recip_reverse(low, high, xl, xu)


@kernel
def rootn_reverse(cl, cu, xl, xu, n):  # type: ignore[no-untyped-def]
    """Return the hull of {x : the n-th root of x is in c} within x; an even root is defined for x >= 0 and is not negative."""
    if n == 0:
        return np.inf, -np.inf
    if n % 2 == 0:
        return intersect(*pown(*intersect(cl, cu, 0.0, np.inf), n), xl, xu)
    # A negative odd power of an interval around 0 has a piece on either side.
    below = intersect(*pown(*intersect(cl, cu, -np.inf, 0.0), n), xl, xu)
    above = intersect(*pown(*intersect(cl, cu, 0.0, np.inf), n), xl, xu)
    return hull(*below, *above)


@kernel
def _root_within(bl, bu, cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return {x : x^b in c for some b} within x, for b on one side of 0, from x = c^(1/b)."""
    lower, upper = intersect(*pow(cl, cu, *recip(bl, bu)), xl, xu)
    # 1 is a limit where b is unbounded, and 0 one where c is or b < 0: alone they are no solutions unless c holds 1^b or 0^b.
    one = (lower == 1.0) & (upper == 1.0) & ((cl > 1.0) | (cu < 1.0))
    zero = (upper == 0.0) & ((cl > 0.0) | (bu <= 0.0))
    return unless(one | zero, lower, upper)


@kernel
def pow_reverse_base(bl, bu, cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return the hull of {x : x^b in c for some b} within x (IEEE 1788-2015, powRev1); as tight as an integer power for one integer b."""
    xl, xu = intersect(xl, xu, 0.0, np.inf)
    cl, cu = intersect(cl, cu, 0.0, np.inf)
    if bl <= 0.0 <= bu and cl <= 1.0 <= cu:
        # x^0 = 1 for every x > 0; the base 0 gives 0, with b > 0 only.
        return unless((xu == 0.0) & ((cl > 0.0) | (bu == 0.0)), xl, xu)
    if bl == bu and bl == np.floor(bl) and abs(bl) <= _LARGEST_EXPONENT:
        return pown_reverse(cl, cu, xl, xu, int(bl))
    lower, upper = np.inf, -np.inf
    for start, stop in ((-np.inf, 0.0), (0.0, np.inf)):  # a loop, so that the long power is compiled once
        lower, upper = hull(lower, upper, *_root_within(*intersect(bl, bu, start, stop), cl, cu, xl, xu))
    return lower, upper


@kernel
def pow_reverse_exponent(al, au, cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return the hull of {x : a^x in c for some a} within x (IEEE 1788-2015, powRev2)."""
    # x·log2 a = log2 c for a > 0, exact for powers of 2. The base 0 gives 0, for every x > 0.
    zero = (al <= 0.0) & (au >= 0.0) & (cl <= 0.0) & (cu >= 0.0) & (xu > 0.0)
    low, high = mul_reverse(*log2(al, au), *log2(cl, cu), xl, xu)
    return hull(low, high, *unless((not zero) | (xl > xu), max(xl, 0.0), xu))


@kernel
def pow_backward(rl, ru, al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Narrow a and b by r = a^b (see `ial.contractors.intervals.backward`)."""
    a = pow_reverse_base(bl, bu, rl, ru, al, au)
    b = pow_reverse_exponent(al, au, rl, ru, bl, bu)
    return both(*a, *b)
