"""Outward rounding by one bit step, and the guard that the processor rounds to nearest."""

import numpy as np
from numba import types

from ial.contractors.kernels import intrinsic, kernel
from ial.errors import RoundingModeError


@intrinsic(lambda x: np.float64(x).view(np.int64))
def _bits(typingctx, x):  # type: ignore[no-untyped-def]
    def codegen(context, builder, signature, args):  # type: ignore[no-untyped-def]
        return builder.bitcast(args[0], context.get_value_type(types.int64))

    return types.int64(types.float64), codegen


@intrinsic(lambda bits: np.int64(bits).view(np.float64))
def _double(typingctx, x):  # type: ignore[no-untyped-def]
    def codegen(context, builder, signature, args):  # type: ignore[no-untyped-def]
        return builder.bitcast(args[0], context.get_value_type(types.float64))

    return types.float64(types.int64), codegen


_SMALLEST = 5e-324


@kernel
def down(x):  # type: ignore[no-untyped-def]
    """Return the next double below x (IEEE 754 nextDown); -inf and NaN stay."""
    # Values are chosen instead of branches taken: a loop can then be vectorized, and no branch is mispredicted where it is not.
    stepped = _double(_bits(x) + (-1 if x > 0.0 else 1))
    stepped = -_SMALLEST if x == 0.0 else stepped
    return stepped if x > -np.inf else x


@kernel
def up(x):  # type: ignore[no-untyped-def]
    """Return the next double above x (IEEE 754 nextUp); +inf and NaN stay."""
    stepped = _double(_bits(x) + (1 if x > 0.0 else -1))
    stepped = _SMALLEST if x == 0.0 else stepped
    return stepped if x < np.inf else x


@kernel
def stepped(x, steps):  # type: ignore[no-untyped-def]
    """Return x >= 0 moved by so many doubles, which must lead neither below 0 nor beyond infinity; cheaper than `down` and `up`."""
    return _double(_bits(x) + steps)


@kernel
def _rounds_to_nearest(tiny, least_normal):  # type: ignore[no-untyped-def]
    """Try the processor; the arguments come at run time, or the compiler would answer for it."""
    nearest = 1.0 + tiny == 1.0 and 1.0 - tiny == 1.0 and -1.0 - tiny == -1.0
    return nearest and least_normal * 0.5 != 0.0


def check_rounding() -> None:
    """Raise unless this thread rounds to nearest and keeps subnormal numbers.

    Raises
    ------
    RoundingModeError
        If another library changed the mode of the processor. codac leaves it in round-up when it is imported; a library built with
        ``-ffast-math`` sets flush-to-zero when it is loaded.
    """
    if not _rounds_to_nearest(1e-30, 2.0**-1022):
        raise RoundingModeError(
            "the processor does not round to nearest or flushes subnormal numbers to zero, so no bound could be trusted; "
            "some library changed its mode in this process (importing codac does, and so does a library built with -ffast-math): "
            "run that library in a process of its own"
        )
