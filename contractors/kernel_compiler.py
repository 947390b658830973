"""What decides, besides the sources, what kernels are compiled to."""

import functools
import hashlib
import os
import sys

import llvmlite
import numba
import numpy as np
from numba.core import config
from numba.core.registry import cpu_target

PORTABLE = {
    "x86-64-v3": frozenset(
        (
            "avx",
            "avx2",
            "bmi",
            "bmi2",
            "cx16",
            "f16c",
            "fma",
            "lzcnt",
            "movbe",
            "popcnt",
            "sahf",
            "sse3",
            "sse4.1",
            "sse4.2",
            "ssse3",
            "xsave",
        )
    ),
    "x86-64": frozenset(),
}
"""The processors that kernels of a wheel are compiled for, the best first: their names in LLVM, and the features that each needs beyond
those of the last (the levels of the x86-64 psABI)."""

_SETTINGS = ("NUMBA_CPU_NAME", "NUMBA_CPU_FEATURES")  # settings that `_processor` tells


def _processor() -> tuple[str, str, str]:
    """Return what LLVM compiles for: the system, the processor, its features, ``+…`` those that it has."""
    system, name, features = cpu_target.target_context.codegen().magic_tuple()
    return system, name, features


def _hash(python: str, processor: tuple[str, str, str]) -> str:
    settings = sorted((name, value) for name, value in os.environ.items() if name.startswith("NUMBA_") and name not in _SETTINGS)
    decisive = python, np.__version__, numba.__version__, llvmlite.__version__, processor, config.USING_SVML, settings
    return hashlib.sha256(repr(decisive).encode()).hexdigest()[:16]


@functools.cache
def compiler_hash() -> str:
    """Return 16 digits that follow from the versions of Python, NumPy, Numba and llvmlite, Numba's settings, and the processor."""
    return _hash(sys.version, _processor())


def portable_hash(name: str) -> str:
    """Return the same for one of the `PORTABLE` processors; of Python, only what decides whether it can load a compiled module counts."""
    return _hash(str(sys.implementation.cache_tag), (_processor()[0], name, ""))


def usable_processors() -> list[str]:
    """Return which of the `PORTABLE` processors this one can stand for, the best first."""
    features = {feature[1:] for feature in _processor()[2].split(",") if feature.startswith("+")}
    return [name for name, needed in PORTABLE.items() if needed <= features]
