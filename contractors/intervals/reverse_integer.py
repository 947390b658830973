"""Reverse operations of sign and of rounding to integers, as compiled kernels on pairs of bounds (see `ial.contractors.intervals.reverse`).

What such a function maps to one integer is an interval with ends that belong to it or not. A result is closed, but empty where the prior
meets the set only in an end that does not belong to it.
"""

import numpy as np

from ial.contractors.intervals.arithmetic import add
from ial.contractors.intervals.sets import unless
from ial.contractors.kernels import kernel


@kernel
def _within(lower, lower_open, upper, upper_open, xl, xu):  # type: ignore[no-untyped-def]
    """Return the part of x between two ends, each of which belongs to the set or not."""
    empty = (xu < lower) | (lower_open & (xu == lower)) | (xl > upper) | (upper_open & (xl == upper))
    return unless(empty | (lower > upper) | (xl > xu), max(lower, xl), min(upper, xu))


@kernel
def _odd(n):  # type: ignore[no-untyped-def]
    """Return whether a number, which is an integer or infinite, is odd."""
    half = 0.5 * n
    return half != np.floor(half)


@kernel
def sign_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return the hull of {x : sign x in c} within x."""
    negative = (cl <= -1.0) & (cu >= -1.0) & (xl < 0.0)
    zero = (cl <= 0.0) & (cu >= 0.0) & (xl <= 0.0) & (xu >= 0.0)
    positive = (cl <= 1.0) & (cu >= 1.0) & (xu > 0.0)
    lower = xl if negative else 0.0 if zero else max(xl, 0.0)
    upper = xu if positive else 0.0 if zero else min(xu, 0.0)
    return unless((xl > xu) | (not (negative | zero | positive)), lower, upper)


@kernel
def floor_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return {x : floor x in c} within x."""
    first, last = np.ceil(cl), np.floor(cu)
    stop = add(last, last, 1.0, 1.0)[1]
    return _within(first, False, stop if first <= last else -np.inf, True, xl, xu)


@kernel
def ceil_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return {x : ceil x in c} within x."""
    lower, upper = floor_reverse(-cu, -cl, -xu, -xl)
    return -upper, -lower


@kernel
def trunc_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return {x : trunc x in c} within x."""
    first, last = np.ceil(cl), np.floor(cu)
    start = add(first, first, -1.0, -1.0)[0] if first <= 0.0 else first
    stop = add(last, last, 1.0, 1.0)[1] if last >= 0.0 else last
    return _within(start, first <= 0.0, stop if first <= last else -np.inf, last >= 0.0, xl, xu)


@kernel
def _round_reverse(first, start_open, last, stop_open, xl, xu):  # type: ignore[no-untyped-def]
    """Return the part of x that is rounded to one of the integers first … last."""
    start = add(first, first, -0.5, -0.5)[0]
    stop = add(last, last, 0.5, 0.5)[1]
    return _within(start, start_open, stop if first <= last else -np.inf, stop_open, xl, xu)


@kernel
def round_ties_to_even_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return {x : x rounded to the nearest integer, a tie to the even one, is in c} within x."""
    first, last = np.ceil(cl), np.floor(cu)
    return _round_reverse(first, _odd(first), last, _odd(last), xl, xu)


@kernel
def round_ties_to_away_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return {x : x rounded to the nearest integer, a tie to the one farther from 0, is in c} within x."""
    first, last = np.ceil(cl), np.floor(cu)
    return _round_reverse(first, first <= 0.0, last, last >= 0.0, xl, xu)
