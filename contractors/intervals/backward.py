"""Backward operations as compiled kernels on pairs of bounds: both operands narrowed at once, by the result.

Given r and operands a and b, each kernel returns (al, au, bl, bu): the hulls of the a and of the b that take part in some solution of
r = a ∘ b, rounded outward. If one is empty, all are. This is the backward step of forward–backward contraction, HC4-revise (Benhamou,
Goualard, Granvilliers and Puget, Revising hull and box consistency, ICLP 1999).

Bounds are passed and returned as in `ial.contractors.intervals.arithmetic`. Powers, lengths and angles are in `reverse_powers` and
`reverse_polar`.
"""

import numpy as np

from ial.contractors.intervals.arithmetic import add, mul, sub
from ial.contractors.intervals.reverse import mul_reverse
from ial.contractors.intervals.sets import intersect, unless
from ial.contractors.kernels import kernel


@kernel
def both(al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Return both intervals, or both empty if one is."""
    empty = (al > au) | (bl > bu)
    al, au = unless(empty, al, au)
    bl, bu = unless(empty, bl, bu)
    return al, au, bl, bu


@kernel
def add_backward(rl, ru, al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Narrow a and b by r = a + b."""
    a = intersect(*sub(rl, ru, bl, bu), al, au)
    b = intersect(*sub(rl, ru, al, au), bl, bu)
    return both(*a, *b)


@kernel
def sub_backward(rl, ru, al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Narrow a and b by r = a − b."""
    a = intersect(*add(rl, ru, bl, bu), al, au)
    b = intersect(*sub(al, au, rl, ru), bl, bu)
    return both(*a, *b)


@kernel
def mul_backward(rl, ru, al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Narrow a and b by r = a·b."""
    a = mul_reverse(bl, bu, rl, ru, al, au)
    b = mul_reverse(al, au, rl, ru, bl, bu)
    return both(*a, *b)


@kernel
def div_backward(rl, ru, al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Narrow a and b by r = a / b, in which b is not 0."""
    a = intersect(*mul(rl, ru, bl, bu), al, au)
    low, high = mul_reverse(rl, ru, al, au, bl, bu)
    return both(*a, *unless((low == 0.0) & (high == 0.0), low, high))


@kernel
def minimum_backward(rl, ru, al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Narrow a and b by r = min(a, b): both are at least r, and where one cannot be the smaller, the other one is."""
    a = intersect(rl, ru if bl > ru else np.inf, al, au)
    b = intersect(rl, ru if al > ru else np.inf, bl, bu)
    al, au, bl, bu = both(*a, *b)
    return both(*unless(rl > ru, al, au), bl, bu)


@kernel
def maximum_backward(rl, ru, al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Narrow a and b by r = max(a, b)."""
    al, au, bl, bu = minimum_backward(-ru, -rl, -au, -al, -bu, -bl)
    return -au, -al, -bu, -bl


@kernel
def multiply_add_backward(rl, ru, al, au, bl, bu, cl, cu):  # type: ignore[no-untyped-def]
    """Narrow a, b and c by r = a·b + c; returns six numbers."""
    pl, pu = sub(rl, ru, cl, cu)
    cl, cu = intersect(*sub(rl, ru, *mul(al, au, bl, bu)), cl, cu)
    al, au, bl, bu = mul_backward(pl, pu, al, au, bl, bu)
    al, au, bl, bu = both(*unless(cl > cu, al, au), bl, bu)
    cl, cu = unless(al > au, cl, cu)
    return al, au, bl, bu, cl, cu
