"""Compilation of kernels with Numba.

Their code is kept by `KernelCache` in a `KernelFolder`, under a name that follows from their `KernelSources`.
With ``NUMBA_DISABLE_JIT=1`` nothing is compiled, and Python's interpreter runs all of it.
"""

from collections.abc import Callable
from typing import Any

import numba
from numba.core.ccallback import CFunc
from numba.core.dispatcher import Dispatcher
from numba.extending import intrinsic as numba_intrinsic

from ial.contractors.interpreter import INTERPRETED, InterpretedCallback, interpreted
from ial.contractors.kernel_cache import KernelCache


def callback(function: Callable[..., Any], *arguments: Any, keep: bool = True) -> Any:
    """Compile a function without a result, so that kernels can call it by its ``address`` without being compiled together with it.

    Parameters
    ----------
    function
        May close over kernels. Its ``__qualname__`` names it in the cache, so it must differ from those of the file's other callbacks.
    *arguments
        Numba's types of its arguments.
    keep
        Whether the compiled code is kept; only where all of it is ial's own, since only that is watched for changes.
    """
    if INTERPRETED:
        return InterpretedCallback(function)
    compiled: Any = CFunc(function, (arguments, numba.types.void), {}, {"error_model": "numpy", "fastmath": False})
    if keep:
        compiled._cache = KernelCache(function)
    compiled.compile()
    return compiled


def kernel(function: Callable[..., Any]) -> Any:
    """Compile a function of numbers and arrays; it runs without Python's lock, so threads can share the work.

    Floating-point semantics stay those of IEEE 754: no fastmath, and a division by zero gives an infinity.
    """
    dispatcher = compile_users(function)
    if not INTERPRETED:
        dispatcher._cache = KernelCache(function)
    return dispatcher


def compile_users(function: Callable[..., Any]) -> Any:
    """Compile a function of a user, as `kernel` does; it is not kept, since its source is not watched for changes."""
    if INTERPRETED:
        return interpreted(function)
    # A wrapper for callers in C is called by nobody and takes a tenth of the time to compile.
    return numba.njit(nogil=True, error_model="numpy", fastmath=False, forceinline=True, no_cfunc_wrapper=True)(function)


def is_kernel(function: Any) -> bool:
    """Return whether a function is a kernel already, or one that its user has compiled with Numba."""
    return hasattr(function, "py_func") if INTERPRETED else isinstance(function, Dispatcher)


def intrinsic(python: Callable[..., Any]) -> Callable[[Callable[..., Any]], Any]:
    """Decorate what writes machine code, as Numba's `intrinsic` does, with the Python function that does the same when interpreted.

    Parameters
    ----------
    python
        Takes the same arguments but for the typing context, and gives the same result to the last bit. It is kept as ``py_func``.
    """

    def decorate(writer: Callable[..., Any]) -> Any:
        if INTERPRETED:
            return interpreted(python)
        compiled = numba_intrinsic(writer)
        compiled.py_func = python
        return compiled

    return decorate
