"""Kernels in Python's interpreter, where ``NUMBA_DISABLE_JIT=1`` says so: slow, but a debugger steps through them and coverage sees them.

They compute what they would compute compiled. For that, numbers become NumPy's, which divide by zero and overflow as the processor does,
where Python's raise an error; and what leaves the outermost kernel are Python's numbers again, as from compiled code.
"""

import functools
import threading
from collections.abc import Callable
from typing import Any, ClassVar

import numpy as np
from numba.core import config

INTERPRETED = bool(config.DISABLE_JIT)
"""Whether this process interprets its kernels."""


class _Depth(threading.local):
    """Whether this thread is inside a kernel."""

    inside = False


_depth = _Depth()


def interpreted(function: Callable[..., Any]) -> Any:
    """Return a function that runs a kernel's source; its ``py_func`` is the source, as that of a compiled kernel."""

    @functools.wraps(function)
    def run(*arguments: Any) -> Any:
        if _depth.inside:
            return _entering(function(*map(_entering, arguments)))
        _depth.inside = True
        try:
            with np.errstate(all="ignore"):
                return _leaving(function(*map(_entering, arguments)))
        finally:
            _depth.inside = False

    run.py_func = function  # type: ignore[attr-defined]
    return run


def _entering(value: Any) -> Any:
    """Return a number as one of NumPy's; whole numbers of few bits as Python's, since compiled code widens them before it computes."""
    if type(value) is float:
        return np.float64(value)
    if type(value) is tuple:
        return tuple(map(_entering, value))
    if isinstance(value, np.integer) and value.itemsize < 8:
        return int(value)
    return value


def _leaving(value: Any) -> Any:
    """Return a number as one of Python's."""
    if isinstance(value, np.generic):
        return value.item()
    return tuple(map(_leaving, value)) if type(value) is tuple else value


class InterpretedCallback:
    """A function that kernels call by a number, in the place of Numba's ``CFunc``, which they call by its address.

    Parameters
    ----------
    function
        Is never forgotten, as compiled code is not.

    Attributes
    ----------
    address
        The number; 0 is none.
    """

    _all: ClassVar[list[Callable[..., None]]] = []

    def __init__(self, function: Callable[..., None]) -> None:
        self._all.append(interpreted(function))
        self.address = len(self._all)

    @classmethod
    def at(cls, address: int) -> Callable[..., None]:
        """Return the function of a number."""
        return cls._all[address - 1]
