"""The table indices of a rectangle, as one step of the processor's vector unit.

The four bounds of a rectangle are added, converted to whole numbers and clamped together. Written with scalars the same work takes almost
twice as long, and this is the innermost step of the localizer.
"""

from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils

from ial.contractors.kernels import intrinsic

OFFSET = 2.0**18
"""Added to coordinates in cells, so that they are positive and cutting off the fraction rounds down."""

_DOUBLE, _INT32, _INT64 = ir.DoubleType(), ir.IntType(32), ir.IntType(64)


def _rectangle_indices_python(bounds: Any, i: Any, xl: Any, yl: Any, xu: Any, yu: Any, columns: Any, rows: Any) -> Any:
    index = (bounds[i] + np.array([xl, yl, xu, yu])).astype(np.int32) - int(OFFSET)
    return tuple(np.clip(index, 0, [columns, rows, columns, rows]).tolist())


@intrinsic(_rectangle_indices_python)
def rectangle_indices(typingctx, bounds, i, xl, yl, xu, yu, columns, rows):  # type: ignore[no-untyped-def]
    """Return (left, below, right, above): table indices of the rectangle ``bounds[i] + (xl, yl, xu, yu)``, clamped to the table.

    Parameters
    ----------
    bounds
        Contiguous float64 of shape (n, 4).
    i
        The row, int64, not negative.
    xl, yl, xu, yu
        float64; `OFFSET` is included, and the upper ones are larger by one cell.
    columns, rows
        The largest indices, int32.
    """
    signature = types.UniTuple(types.int32, 4)(bounds, i, xl, yl, xu, yu, columns, rows)

    def codegen(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        array, row, *box, columns, rows = arguments
        data = context.make_array(signature.args[0])(context, builder, array).data
        start = builder.gep(data, [builder.mul(row, ir.Constant(_INT64, 4))])
        relative = builder.load(builder.bitcast(start, ir.VectorType(_DOUBLE, 4).as_pointer()))
        relative.align = 8
        placed = builder.fadd(relative, _vector(builder, _DOUBLE, box))
        index = builder.fptosi(placed, ir.VectorType(_INT32, 4))
        index = builder.sub(index, ir.Constant(ir.VectorType(_INT32, 4), [int(OFFSET)] * 4))
        limit = _vector(builder, _INT32, [columns, rows, columns, rows])
        index = builder.select(builder.icmp_signed("<", index, limit), index, limit)
        zero = ir.Constant(ir.VectorType(_INT32, 4), [0] * 4)
        index = builder.select(builder.icmp_signed(">", index, zero), index, zero)
        return cgutils.pack_array(builder, [builder.extract_element(index, ir.Constant(_INT32, lane)) for lane in range(4)])

    return signature, codegen


def _vector(builder: Any, element: Any, values: Any) -> Any:
    vector = ir.Constant(ir.VectorType(element, len(values)), ir.Undefined)
    for lane, value in enumerate(values):
        vector = builder.insert_element(vector, value, ir.Constant(_INT32, lane))
    return vector
