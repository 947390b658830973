"""What `oracles.py` compares the reverse of each operation with, and how it runs them on arrays."""

import functools
from collections.abc import Callable
from typing import Any, NamedTuple

import ival
import numpy as np
from numba import njit

from ial.contractors import Operation
from ial.contractors.expressions.functions import OPERATIONS
from ial.contractors.expressions.operation import LANES, call
from ial.contractors.rounding import check_rounding
from tests.contractors.intervals.test_backward import BINARY
from tests.contractors.intervals.test_reverse import NEARLY_TIGHT, TIGHT
from tests.contractors.intervals.test_reverse_integer import OPERATIONS as INTEGER
from tests.contractors.intervals.test_reverse_periodic import INVERSE, PERIODIC
from tests.contractors.intervals.test_reverse_polar import OPERATIONS as POLAR
from tests.contractors.intervals.test_reverse_powers import EXPONENTS
from tests.contractors.oracles import Pairs


class Reverse(NamedTuple):
    """The function of crival, what its reverse functions leave of each operand (if known), and the size of usual solutions."""

    function: Callable[..., Any]
    oracles: tuple[Callable[..., Any], ...]
    scale: float = 10.0
    operands: int = 1
    exponent: int | None = None


def _by_kernel() -> dict[Any, Reverse]:
    """Return the tables of the tests, by the backward kernel."""
    reverses = {kernel: Reverse(function, (reverse,), scale) for kernel, function, reverse, scale in (*TIGHT, *NEARLY_TIGHT)}
    reverses |= {kernel: Reverse(function, (reverse,)) for kernel, (function, reverse) in (PERIODIC | INVERSE).items()}
    reverses |= {kernel: Reverse(function, (), 4.0) for kernel, function in INTEGER.items()}
    reverses |= {kernel: Reverse(row[0], row[1:], operands=2) for kernel, row in BINARY.items()}
    reverses |= {kernel: Reverse(function, (), operands=2) for kernel, function in POLAR.items()}
    return reverses


def _powers(name: str) -> list[Reverse]:
    """Return the reverses of a power or root for each of some exponents."""
    chosen = [n for n in EXPONENTS if n or name == "pown"]
    if name == "rootn":
        return [Reverse(functools.partial(_root, n=n), (), 3.0, exponent=n) for n in chosen]
    return [Reverse(functools.partial(_power, n=n), (functools.partial(_power_reverse, n=n),), 3.0, exponent=n) for n in chosen]


def _power(x: Any, n: int) -> Any:
    return ival.pown(x, n)


def _root(x: Any, n: int) -> Any:
    return ival.rootn(x, n)


def _power_reverse(r: Any, x: Any, n: int) -> Any:
    return ival.pownrev(r, n, x)


_KERNELS = _by_kernel()
_OTHERS = {
    "neg": [Reverse(lambda a: -a, (lambda r, a: -r & a,))],
    "multiply_add": [Reverse(ival.fma, (), operands=3)],
    "pow": [Reverse(ival.pow, (lambda r, a, b: ival.powrev1(b, r, a), lambda r, a, b: ival.powrev2(a, r, b)), 3.0, 2)],
    "pown": _powers("pown"),
    "rootn": _powers("rootn"),
}
REVERSE = {name: _OTHERS[name] if name in _OTHERS else [_KERNELS[operation.backward]] for name, operation in OPERATIONS.items()}
"""By the name of the operation; a power or root has one entry for each exponent."""


@njit(nogil=True)
def _narrow(address, operands, result):  # type: ignore[no-untyped-def]
    """Narrow operands (m, 2, n) in place by results (2, n), with the loop that expressions use."""
    lanes = np.empty((4, 2, LANES))
    at = lanes.ctypes.data
    rows = result.shape[1]
    for first in range(0, rows, LANES):
        count = min(LANES, rows - first)
        for side in range(2):
            lanes[3, side, :count] = result[side, first : first + count]
            for k in range(len(operands)):
                lanes[k, side, :count] = operands[k, side, first : first + count]
        call(address, count, at, at + 16 * LANES, at + 32 * LANES, at + 48 * LANES)
        for side in range(2):
            for k in range(len(operands)):
                operands[k, side, first : first + count] = lanes[k, side, :count]


def narrow(operation: Operation, result: Pairs, *operands: Pairs) -> list[Pairs]:
    """Return what an operation's compiled reverse leaves of each operand, given its results."""
    check_rounding()
    narrowed = np.stack([np.stack(pair) for pair in operands])
    _narrow(operation.backward_loop.address, narrowed, np.stack(result))
    return [(pair[0], pair[1]) for pair in narrowed]
