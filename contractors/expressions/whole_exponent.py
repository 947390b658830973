"""The whole exponent of `pown` and `rootn`: a number in a formula, an interval of one point in a tape."""

import numbers
from typing import Any

from ial.contractors.intervals import powers, reverse_powers
from ial.contractors.intervals.interval import Interval
from ial.contractors.kernels import kernel

_MOST = 2.0**53  # larger whole numbers need not be doubles


@kernel
def pown_forward(al, au, nl, nu):  # type: ignore[no-untyped-def]
    """Return aⁿ for the whole number n = [nl, nu]."""
    return powers.pown(al, au, int(nl))


@kernel
def pown_backward(rl, ru, al, au, nl, nu):  # type: ignore[no-untyped-def]
    """Narrow a, given the bounds of aⁿ."""
    al, au = reverse_powers.pown_reverse(rl, ru, al, au, int(nl))
    return al, au, nl, nu


@kernel
def rootn_forward(al, au, nl, nu):  # type: ignore[no-untyped-def]
    """Return the n-th root of a for the whole number n = [nl, nu]."""
    return powers.rootn(al, au, int(nl))


@kernel
def rootn_backward(rl, ru, al, au, nl, nu):  # type: ignore[no-untyped-def]
    """Narrow a, given the bounds of its n-th root."""
    al, au = reverse_powers.rootn_reverse(rl, ru, al, au, int(nl))
    return al, au, nl, nu


def whole_exponent(n: Any) -> int:
    """Return the exponent of `pown` and `rootn`, a number or a constant expression, if it is whole and a double holds it exactly."""
    given = getattr(n, "value", n)
    number: Any = given.lower if isinstance(given, Interval) and given.lower == given.upper else given
    if not issubclass(type(number), numbers.Real):
        raise TypeError(f"the exponent is {n}; pown and rootn need one whole number, pow takes others")
    if not (abs(number) <= _MOST and float(number).is_integer() and float(number) == number):
        raise ValueError(f"the exponent is {n}; pown and rootn need a whole number of at most 2^53 in size, pow takes others")
    return int(float(number))


def require_exponent(a: Any, n: Any) -> None:
    """Refuse what is no exponent of `pown`."""
    whole_exponent(n)


def require_root(a: Any, n: Any) -> None:
    """Refuse what is no exponent of `rootn`."""
    if whole_exponent(n) == 0:
        raise ValueError("the exponent is 0; rootn needs a whole number other than 0")
