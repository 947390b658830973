"""Reverse operations on `Interval`: which operands can give a result (IEEE 1788-2015, clauses 10.5.4 and 10.5.5)."""

from ial.contractors.expressions.operation import Operation
from ial.contractors.intervals.interval import Interval, Operand
from ial.contractors.intervals.reverse import mul_reverse_pieces
from ial.contractors.rounding import check_rounding


def narrow(operation: Operation, result: Operand, *operands: Operand) -> tuple[Interval, ...]:
    """Return the operands of an operation, narrowed to what can give a result.

    No solution of ``operation(x, …) in result`` with x, … in the operands is lost, and where there is none all operands come back empty.
    Each operation has one such reverse, which serves for all operands at once. In the names of the standard, for operands x, a, b:

    ======================================== ========================
    ``narrow(sqr, c, x)``                    sqrRev, and likewise absRev, sinRev, cosRev, tanRev, coshRev
    ``narrow(pown, c, x, n)[0]``             pownRev
    ``narrow(mul, c, x, b)[0]``              mulRev
    ``narrow(pow, c, x, b)[0]``              powRev1
    ``narrow(pow, c, a, x)[1]``              powRev2
    ``narrow(atan2, c, x, b)[0]``            atan2Rev1
    ``narrow(atan2, c, a, x)[1]``            atan2Rev2
    ======================================== ========================

    Parameters
    ----------
    operation
        One of `ial.contractors.expressions.functions`, or a user's own.
    result
        An interval that holds the result.
    *operands
        What is known of the operands before; ``Interval.entire()`` for one of which nothing is known. The one operand of a function such
        as `sqr` may then be left out.

    Returns
    -------
    tuple of Interval
        As many as the operation has operands.

    Raises
    ------
    TypeError
        If there are more or fewer operands than the operation has.

    Examples
    --------
    >>> from ial.contractors import Interval
    >>> from ial.contractors.expressions.functions import mul, sqr
    >>> [str(x) for x in narrow(sqr, Interval(1, 4), Interval(0, 9))]
    ['[1.0, 2.0]']
    >>> [str(x) for x in narrow(mul, 6, Interval(2, 3), Interval(0, 10))]
    ['[2.0, 3.0]', '[2.0, 3.0]']
    """
    check_rounding()
    known = operands or (Interval.entire(),)
    if len(known) != operation.arity:
        raise TypeError(f"{operation.name} has {operation.arity} operands; {len(known)} were given to narrow")
    intervals = [each if isinstance(each, Interval) else Interval(each) for each in (result, *known)]
    bounds = operation.backward(*(side for interval in intervals for side in (interval.lower, interval.upper)))
    return tuple(Interval.of_bounds(*bounds[i : i + 2]) for i in range(0, len(bounds), 2))


def divide_pieces(dividend: Operand, divisor: Operand, prior: Interval | None = None) -> tuple[Interval, Interval]:
    """Return {x in prior : x·b in the dividend for some b of the divisor} as two intervals, the lower one first.

    The second is empty unless the divisor has numbers on both sides of 0, and the dividend has not 0 (IEEE 1788-2015, mulRevToPair,
    10.5.5). Without a prior, every x is allowed.

    Examples
    --------
    >>> from ial.contractors import Interval
    >>> [str(x) for x in divide_pieces(1, Interval(-1, 2))]
    ['[-inf, -1.0]', '[0.5, inf]']
    """
    check_rounding()
    c, b = (each if isinstance(each, Interval) else Interval(each) for each in (dividend, divisor))
    x = Interval.entire() if prior is None else prior
    pieces = mul_reverse_pieces(b.lower, b.upper, c.lower, c.upper, x.lower, x.upper)
    first, second = Interval.of_bounds(*pieces[:2]), Interval.of_bounds(*pieces[2:])
    return (second, first) if first.is_empty else (first, second)
