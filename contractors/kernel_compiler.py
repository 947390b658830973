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

_PROCESSOR = ("NUMBA_CPU_NAME", "NUMBA_CPU_FEATURES")  # settings that the processor's name and features tell


@functools.cache
def compiler_hash() -> str:
    """Return 16 digits that follow from the versions of Python, NumPy, Numba and llvmlite, Numba's settings, and the processor."""
    settings = sorted((name, value) for name, value in os.environ.items() if name.startswith("NUMBA_") and name not in _PROCESSOR)
    processor = cpu_target.target_context.codegen().magic_tuple()  # what LLVM compiles for: the system, the processor, its features
    decisive = sys.version, np.__version__, numba.__version__, llvmlite.__version__, processor, config.USING_SVML, settings
    return hashlib.sha256(repr(decisive).encode()).hexdigest()[:16]
