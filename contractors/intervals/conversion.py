"""Intervals of other libraries: crival and pyinterval. Neither is needed to use ial; each is imported when it is asked for."""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from ial.contractors.intervals.interval import Interval


def to_crival(interval: Interval) -> Any:
    """Return the same set as an ``Interval`` of crival, which writes the empty one with NaN.

    Raises
    ------
    ImportError
        If crival is not installed.
    """
    with _needed("crival"):
        import ival

    bounds = (math.nan, math.nan) if interval.is_empty else (interval.lower, interval.upper)
    return ival.Interval(*bounds)


def from_crival(interval: Any) -> Interval:
    """Return the same set as one ``Interval`` of crival.

    Raises
    ------
    TypeError
        If it is not one interval with bounds ``lo`` and ``hi``; an array of intervals is several.
    """
    try:
        lower, upper = float(interval.lo), float(interval.hi)
    except (AttributeError, TypeError, ValueError):
        raise TypeError(f"{interval!r} is not one interval of crival; for an array, give Boxes.column its bounds") from None
    return Interval.empty() if math.isnan(lower) and math.isnan(upper) else Interval(lower, upper)


def to_pyinterval(interval: Interval) -> Any:
    """Return the same set as an ``interval`` of pyinterval, which has no component if empty.

    Raises
    ------
    ImportError
        If pyinterval is not installed.
    """
    with _needed("pyinterval"):
        from interval import interval as pyinterval

    components = [] if interval.is_empty else [(interval.lower, interval.upper)]
    return pyinterval(*components)


def from_pyinterval(interval: Any) -> Interval:
    """Return the hull of an ``interval`` of pyinterval, which may be a union of several.

    Raises
    ------
    TypeError
        If it has no components that are pairs of bounds.
    """
    try:
        components = [(float(lower), float(upper)) for lower, upper in interval]
    except (TypeError, ValueError):
        raise TypeError(f"{interval!r} is not an interval of pyinterval") from None
    hull = Interval.empty()
    for lower, upper in components:
        hull |= Interval(lower, upper)
    return hull


@contextmanager
def _needed(package: str) -> Iterator[None]:
    try:
        yield
    except ImportError as error:
        raise ImportError(f"{package} is not installed; install it with 'pip install {package}'") from error
