"""How many of eight neighbouring rectangles hold no cell, as one step of the processor's vector unit.

Eight rectangles of equal size, side by side a cell apart, have their corners side by side in a summed-area table. So four loads fetch the
corners of all eight; this is the innermost step of the localizer.
"""

from typing import Any

from llvmlite import ir
from numba import types

from ial.contractors.kernels import intrinsic

LANES = 8
"""How many rectangles are looked up together."""

_INT32 = ir.IntType(32)


def _count_empty_rectangles_python(
    table: Any, above_right: Any, above_left: Any, below_right: Any, below_left: Any, counts: Any, at: Any
) -> None:
    one, two, three, four = (table[corner : corner + LANES] for corner in (above_right, above_left, below_right, below_left))
    counts[at : at + LANES] += one - two - three + four == 0


@intrinsic(_count_empty_rectangles_python)
def count_empty_rectangles(typingctx, table, above_right, above_left, below_right, below_left, counts, at):  # type: ignore[no-untyped-def]
    """Add 1 to each of ``counts[at : at + 8]`` whose rectangle holds no cell of the set.

    Parameters
    ----------
    table
        Summed-area table, contiguous int32 or uint16 of shape (n,); in 16 bits the rectangles must have less than 2¹⁶ cells.
    above_right, above_left, below_right, below_left
        Where in the table the corners of the first rectangle are, int64; those of the others follow. Nothing checks them.
    counts
        Contiguous int32.
    at
        int64.
    """
    signature = types.void(table, above_right, above_left, below_right, below_left, counts, at)

    def codegen(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        table, *corners, counts, at = arguments
        bits = signature.args[0].dtype.bitwidth
        numbers, lanes = ir.VectorType(ir.IntType(bits), LANES), ir.VectorType(_INT32, LANES)

        def pointer(number: int, array: Any, index: Any, kind: Any) -> Any:
            data = context.make_array(signature.args[number])(context, builder, array).data
            return builder.bitcast(builder.gep(data, [index]), kind.as_pointer())

        def load(pointer: Any, align: int) -> Any:
            vector = builder.load(pointer)
            vector.align = align
            return vector

        one, two, three, four = (load(pointer(0, table, corner, numbers), bits // 8) for corner in corners)
        cells = builder.add(builder.sub(builder.sub(one, two), three), four)
        empty = builder.sext(builder.icmp_signed("==", cells, ir.Constant(numbers, [0] * LANES)), lanes)  # -1 where there is none
        place = pointer(5, counts, at, lanes)
        stored = builder.store(builder.sub(load(place, 4), empty), place)
        stored.align = 4
        return context.get_dummy_value()

    return signature, codegen
