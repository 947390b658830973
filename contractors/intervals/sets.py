"""Sets of numbers, questions about them and numbers that describe them, after IEEE 1788-2015, clauses 9.3–9.5 and 10.5.7–10.6.4.

Bounds are passed and returned as in `ial.contractors.intervals.arithmetic`: the empty set is (inf, -inf), which makes most questions about
it come out right by themselves. A number that describes an interval is tight, and NaN where there is none.
"""

import numpy as np

from ial.contractors.intervals.error_free import sum_residual
from ial.contractors.kernels import kernel
from ial.contractors.rounding import up

_LARGEST = float(np.finfo(np.float64).max)


@kernel
def unless(empty, lower, upper):  # type: ignore[no-untyped-def]
    """Return the bounds, or the empty interval."""
    return np.inf if empty else lower, -np.inf if empty else upper


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


# Questions (9.5, 10.5.10). An empty interval satisfies "for all points of it".


@kernel
def is_empty(al, au):  # type: ignore[no-untyped-def]
    """Return whether a has no point."""
    return al > au


@kernel
def is_entire(al, au):  # type: ignore[no-untyped-def]
    """Return whether a is the real line."""
    return (al == -np.inf) & (au == np.inf)


@kernel
def is_singleton(al, au):  # type: ignore[no-untyped-def]
    """Return whether a is one point."""
    return al == au


@kernel
def is_common(al, au):  # type: ignore[no-untyped-def]
    """Return whether a is bounded and not empty."""
    return (-np.inf < al) & (al <= au) & (au < np.inf)


@kernel
def member(x, al, au):  # type: ignore[no-untyped-def]
    """Return whether x is a real number in a; an infinity or NaN is not."""
    return (al <= x) & (x <= au) & (abs(x) < np.inf)


@kernel
def equal(al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Return whether a and b have the same points."""
    return (al == bl) & (au == bu)


@kernel
def subset(al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Return whether every point of a lies in b."""
    return (bl <= al) & (au <= bu)


@kernel
def _beyond(x, y, end):  # type: ignore[no-untyped-def]
    """Return whether x < y, or both stand at the same infinite end of the line."""
    return (x < y) | ((x == end) & (y == end))


@kernel
def interior(al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Return whether every point of a lies in the interior of b."""
    return (al > au) | (_beyond(bl, al, -np.inf) & _beyond(au, bu, np.inf))


@kernel
def disjoint(al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Return whether a and b have no point in common."""
    return max(al, bl) > min(au, bu)


@kernel
def less(al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Return whether every point of a has a point of b that is not below it, and every point of b one of a that is not above it."""
    return (al <= bl) & (au <= bu) & ((al > au) == (bl > bu))


@kernel
def strict_less(al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Return the same as `less`, with "above" in place of "not below" and "below" in place of "not above"."""
    both_empty = (al > au) & (bl > bu)
    either_empty = (al > au) | (bl > bu)
    return both_empty | ((not either_empty) & _beyond(al, bl, -np.inf) & _beyond(au, bu, np.inf))


@kernel
def precedes(al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Return whether no point of a lies above a point of b."""
    return au <= bl


@kernel
def strict_precedes(al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Return whether every point of a lies below every point of b."""
    return (al > au) | (bl > bu) | (au < bl)


OVERLAPS = (
    *("bothEmpty", "firstEmpty", "secondEmpty", "before", "meets", "overlaps", "starts", "containedBy"),
    *("finishes", "equals", "finishedBy", "contains", "startedBy", "overlappedBy", "metBy", "after"),
)


@kernel
def overlap(al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Return how a lies beside b: the place in `OVERLAPS` of the name of one of sixteen states (10.6.4)."""
    if al > au or bl > bu:
        return 0 if al > au and bl > bu else 1 if al > au else 2
    if au < bl or bu < al:
        return 3 if au < bl else 15
    if al == bl and au == bu:
        return 9
    if al < bl:
        return (4 if au == bl else 5) if au < bu else 10 if au == bu else 11
    if al == bl:
        return 6 if au < bu else 12
    return 7 if au < bu else 8 if au == bu else 14 if al == bu else 13


# Numbers (9.4, 10.5.9).


@kernel
def inf(al, au):  # type: ignore[no-untyped-def]
    """Return the lower bound; +inf if empty."""
    return al


@kernel
def sup(al, au):  # type: ignore[no-untyped-def]
    """Return the upper bound; -inf if empty."""
    return au


@kernel
def midpoint(al, au):  # type: ignore[no-untyped-def]
    """Return the double nearest to the middle, always inside; 0 for the real line, ±the largest double for a half line."""
    total = al + au
    middle = 0.5 * total if abs(total) < np.inf else 0.5 * al + 0.5 * au
    middle = _LARGEST if au == np.inf else middle
    middle = (0.0 if au == np.inf else -_LARGEST) if al == -np.inf else middle
    return np.nan if al > au else middle


@kernel
def _difference_above(a, b):  # type: ignore[no-untyped-def]
    """Return a − b rounded up."""
    difference = a - b
    return difference if sum_residual(a, -b, difference) <= 0.0 else up(difference)


@kernel
def width(al, au):  # type: ignore[no-untyped-def]
    """Return upper − lower, rounded up."""
    return np.nan if al > au else _difference_above(au, al)


@kernel
def radius(al, au):  # type: ignore[no-untyped-def]
    """Return the smallest double r such that `midpoint` ± r encloses the interval."""
    middle = midpoint(al, au)
    return np.nan if al > au else max(_difference_above(middle, al), _difference_above(au, middle))


@kernel
def mid_rad(al, au):  # type: ignore[no-untyped-def]
    """Return `midpoint` and `radius`."""
    return midpoint(al, au), radius(al, au)


@kernel
def magnitude(al, au):  # type: ignore[no-untyped-def]
    """Return the largest absolute value."""
    return np.nan if al > au else max(-al, au)


@kernel
def mignitude(al, au):  # type: ignore[no-untyped-def]
    """Return the smallest absolute value."""
    return np.nan if al > au else max(0.0, max(al, -au))
