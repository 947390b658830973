"""Compilation of kernels with Numba.

Their code is kept by `KernelCache` in a `KernelFolder`, under a name that follows from their `KernelSources`.
"""

from collections.abc import Callable
from typing import Any

import numba
from numba.core.ccallback import CFunc

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
    dispatcher._cache = KernelCache(function)
    return dispatcher


def compile_users(function: Callable[..., Any]) -> Any:
    """Compile a function of a user, as `kernel` does; it is not kept, since its source is not watched for changes."""
    # A wrapper for callers in C is called by nobody and takes a tenth of the time to compile.
    return numba.njit(nogil=True, error_model="numpy", fastmath=False, forceinline=True, no_cfunc_wrapper=True)(function)
