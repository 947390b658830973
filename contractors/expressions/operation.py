"""`Operation`: one operation on intervals, forward and backward, for one interval, for arrays of them, and for expressions."""

import ctypes
import functools
import inspect
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from llvmlite import ir
from numba import types
from numba.core.errors import NumbaError

from ial.contractors.interpreter import InterpretedCallback
from ial.contractors.intervals.interval import Interval
from ial.contractors.kernels import callback, compile_users, intrinsic, is_kernel, kernel
from ial.contractors.rounding import check_rounding
from ial.contractors.threads import run

LANES = 128
"""Intervals that a row loop takes at once: few enough for the fastest cache, enough to make the call cheap."""

_POINTER = types.CPointer(types.float64)
_LOOP = (types.int64, _POINTER, _POINTER, _POINTER, _POINTER)

FloatArray = npt.NDArray[np.float64]
IntervalArrays = tuple[FloatArray, FloatArray]
"""Many intervals: their lower and their upper bounds."""


def _call_python(address: int, count: int, *lanes: int) -> None:
    InterpretedCallback.at(address)(count, *(ctypes.cast(int(lane), ctypes.POINTER(ctypes.c_double)) for lane in lanes))


@intrinsic(_call_python)
def call(typingctx, address, count, a, b, c, r):  # type: ignore[no-untyped-def]
    """Call a row loop by its address, with the addresses of the lanes of up to three operands and of the result."""

    def codegen(context, builder, signature, args):  # type: ignore[no-untyped-def]
        word, pointer = ir.IntType(64), ir.DoubleType().as_pointer()
        loop = ir.FunctionType(ir.VoidType(), [word] + [pointer] * 4).as_pointer()
        lanes = [builder.inttoptr(arg, pointer) for arg in args[2:]]
        builder.call(builder.inttoptr(args[0], loop), [args[1], *lanes])
        return context.get_dummy_value()

    return types.void(*[types.int64] * 6), codegen


def _forward_loop(operation: Any, arity: int) -> Callable[..., None]:
    """Return a loop that writes r = f(a, b, c). Lanes hold LANES lower bounds, then LANES upper bounds."""

    def unary(count, a, b, c, r):  # type: ignore[no-untyped-def]
        for i in range(count):
            r[i], r[LANES + i] = operation(a[i], a[LANES + i])

    def binary(count, a, b, c, r):  # type: ignore[no-untyped-def]
        for i in range(count):
            r[i], r[LANES + i] = operation(a[i], a[LANES + i], b[i], b[LANES + i])

    def ternary(count, a, b, c, r):  # type: ignore[no-untyped-def]
        for i in range(count):
            r[i], r[LANES + i] = operation(a[i], a[LANES + i], b[i], b[LANES + i], c[i], c[LANES + i])

    return (unary, binary, ternary)[arity - 1]


def _backward_loop(operation: Any, arity: int) -> Callable[..., None]:
    """Return a loop that narrows a, b, c to what can give r. Operands may share their lanes: what one wrote, the next one meets."""

    def unary(count, a, b, c, r):  # type: ignore[no-untyped-def]
        for i in range(count):
            al, au = operation(r[i], r[LANES + i], a[i], a[LANES + i])
            a[i], a[LANES + i] = max(al, a[i]), min(au, a[LANES + i])

    def binary(count, a, b, c, r):  # type: ignore[no-untyped-def]
        for i in range(count):
            al, au, bl, bu = operation(r[i], r[LANES + i], a[i], a[LANES + i], b[i], b[LANES + i])
            a[i], a[LANES + i] = max(al, a[i]), min(au, a[LANES + i])
            b[i], b[LANES + i] = max(bl, b[i]), min(bu, b[LANES + i])

    def ternary(count, a, b, c, r):  # type: ignore[no-untyped-def]
        for i in range(count):
            al, au, bl, bu, cl, cu = operation(r[i], r[LANES + i], a[i], a[LANES + i], b[i], b[LANES + i], c[i], c[LANES + i])
            a[i], a[LANES + i] = max(al, a[i]), min(au, a[LANES + i])
            b[i], b[LANES + i] = max(bl, b[i]), min(bu, b[LANES + i])
            c[i], c[LANES + i] = max(cl, c[i]), min(cu, c[LANES + i])

    return (unary, binary, ternary)[arity - 1]


@kernel
def _apply(start, stop, address, operands, lower, upper):  # type: ignore[no-untyped-def]
    """Write an operation's results on flat arrays: lower and upper bounds of the first operand, of the second, and so on."""
    lanes = np.empty((8, LANES))
    at = lanes.ctypes.data
    for first in range(start, stop, LANES):
        count = min(LANES, stop - first)
        for k in range(len(operands)):  # element by element: an assignment of slices brings in the text of Numba's errors to compile
            side, lane = operands[k], lanes[k]
            for i in range(count):
                lane[i] = side[first + i]
        call(address, count, at, at + 16 * LANES, at + 32 * LANES, at + 48 * LANES)
        for i in range(count):
            lower[first + i] = lanes[6, i]
            upper[first + i] = lanes[7, i]


class Operation:
    """An operation on intervals, and how to go back from its result to its operands.

    Calling it with numbers or `Interval` gives an `Interval`, with `Boxes` it works on every side of every box, and with an `Expression` it
    gives an `Expression`. Every result contains f of every point of the operands at which f is defined.

    Parameters
    ----------
    name
        How it is printed, and under which it is known in error messages.
    forward
        A function of numbers: ``forward(al, au[, bl, bu[, cl, cu]])`` returns bounds of {f(a[, b[, c]])}. Compiled by Numba. It must round
        outward, return ``(inf, -inf)`` for an empty operand, and never raise.
    backward
        ``backward(rl, ru, al, au[, bl, bu[, cl, cu]])`` returns bounds of all operands that contain every point of them that satisfies
        r = f(a[, b[, c]]). If one of them becomes empty, so must all. What it returns is met with the operands.
    derivative
        ``derivative(*operands, result)`` returns one expression for each operand, the partial derivatives (at a kink, an enclosure of the
        slopes); None if f is not continuous or nothing is known. Needed for the mean-value form, `jacobian` and Newton's method.
    defined
        ``defined(*operands)`` returns pairs (expression, interval): f is defined on a box if each expression's range there lies in its
        interval. None if f is defined everywhere.
    continuous
        The same for: f is defined and continuous on a box. None if `defined` says it.
    check
        ``check(*operands)`` raises if f cannot be applied to such operands. None if it can be applied to all.
    doc
        The docstring of the operation.

    Notes
    -----
    Operations are functions in the sense of IEEE 1788-2015, clause 9.1, and their reverse-mode extensions, clause 10.5.4.

    Raises
    ------
    ValueError
        If the numbers of parameters of `forward` and `backward` do not fit.
    TypeError
        If Numba cannot compile them.
    """

    def __init__(
        self,
        name: str,
        forward: Callable[..., Any],
        backward: Callable[..., Any],
        *,
        derivative: Callable[..., Sequence[Any]] | None = None,
        defined: Callable[..., Sequence[tuple[Any, Any]]] | None = None,
        continuous: Callable[..., Sequence[tuple[Any, Any]]] | None = None,
        check: Callable[..., None] | None = None,
        doc: str | None = None,
    ) -> None:
        self.name = self.__name__ = name
        self.derivative = derivative
        self.defined = defined
        self.continuous = continuous or defined
        self.check = check
        self._own = all(is_kernel(f) and f.__module__.startswith("ial.") for f in (forward, backward))
        self.forward: Any
        self.backward: Any
        self.forward, self.backward = (f if is_kernel(f) else compile_users(f) for f in (forward, backward))
        taken, returned = (len(inspect.signature(f.py_func).parameters) for f in (self.forward, self.backward))
        self.arity = taken // 2
        if taken not in (2, 4, 6) or returned != taken + 2:
            raise ValueError(
                f"the operation {name!r} must have one to three operands, with the functions forward(al, au, …) of two numbers an operand "
                "and backward(rl, ru, al, au, …) of two more"
            )
        self.__doc__ = doc or forward.__doc__
        if not self._own:  # what cannot be compiled is told where it is declared
            _ = self.forward_loop, self.backward_loop

    def __repr__(self) -> str:
        return f"<operation {self.name}>"

    def __call__(self, *operands: Any) -> Any:
        """Return the operation's result on numbers, intervals, boxes or expressions."""
        if len(operands) != self.arity:
            raise TypeError(f"{self.name} takes {self.arity} operand{'s' * (self.arity > 1)}; {len(operands)} were given")
        if any(isinstance(operand, np.ndarray) and operand.dtype == object for operand in operands):
            return np.frompyfunc(self, self.arity, 1)(*map(_cell, operands))
        if self.check is not None:
            self.check(*operands)
        chosen = max(operands, key=lambda operand: getattr(operand, "operand_rank", 0))
        if hasattr(chosen, "operate"):
            return chosen.operate(self, operands)
        if any(isinstance(operand, np.ndarray) and operand.ndim for operand in operands):
            raise TypeError(f"{self.name} is applied to an array of numbers; write Boxes(points, points) for points of shape (n, d)")
        return Interval.operate(self, operands)

    @functools.cached_property
    def forward_loop(self) -> Any:
        """The compiled loop over lanes that applies the operation."""
        return self._compile("forward", _forward_loop(self.forward, self.arity))

    @functools.cached_property
    def backward_loop(self) -> Any:
        """The compiled loop over lanes that narrows the operands."""
        return self._compile("backward", _backward_loop(self.backward, self.arity))

    def _compile(self, direction: str, loop: Callable[..., None]) -> Any:
        loop.__qualname__ = f"{direction}.{self.name}"
        try:
            return callback(loop, *_LOOP, keep=self._own)
        except NumbaError as error:
            raise TypeError(f"the function {direction} of the operation {self.name!r} cannot be compiled by Numba: {error}") from error

    def bounds(self, *operands: IntervalArrays) -> IntervalArrays:
        """Return the results on arrays of intervals, (lower, upper), each float64 of one shape that operands broadcast to."""
        check_rounding()
        sides = [np.asarray(side, dtype=np.float64) for operand in operands for side in operand]
        shape = np.broadcast_shapes(*(side.shape for side in sides))
        flat = tuple(_flat(side, shape) for side in sides)
        lower, upper = np.empty(len(flat[0])), np.empty(len(flat[0]))
        run(_apply, len(lower), self.forward_loop.address, flat, lower, upper, minimum=1 << 14)
        return lower.reshape(shape), upper.reshape(shape)


def _flat(side: FloatArray, shape: tuple[int, ...]) -> FloatArray:
    """Return an array of a shape as one row, copied only if it must be, and read-only always, since kernels are compiled for either."""
    flat = np.ascontiguousarray(np.broadcast_to(side, shape)).reshape(-1)
    flat.flags.writeable = False
    return flat


def _cell(operand: Any) -> Any:
    """Return an array as it is, anything else as an array without dimensions, which NumPy pairs with every element of the others."""
    if isinstance(operand, np.ndarray):
        return operand
    cell = np.empty((), dtype=object)
    cell[()] = operand
    return cell
