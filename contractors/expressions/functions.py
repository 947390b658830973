"""The operations that come with ial: what each computes forward and backward, its derivative, and where it is defined.

Each takes numbers, `Interval`, `Boxes` or `Expression`; see `Operation`. The names are those of IEEE 1788-2015, tables 9.1 and 9.2, written
out where Python or NumPy already have the short one.
"""

import math
from typing import Any

from ial.contractors.expressions.operation import Operation
from ial.contractors.expressions.whole_exponent import (
    pown_backward,
    pown_forward,
    require_exponent,
    require_root,
    rootn_backward,
    rootn_forward,
    whole_exponent,
)
from ial.contractors.intervals import (
    arithmetic,
    backward,
    exponential,
    integer,
    powers,
    reverse,
    reverse_integer,
    reverse_periodic,
    reverse_polar,
    reverse_powers,
    trigonometric,
)
from ial.contractors.intervals.interval import Interval
from ial.contractors.intervals.sets import intersect
from ial.contractors.kernels import kernel

# Closed intervals cannot leave out a bound: what must be positive is at least the smallest double.
_POSITIVE = Interval(math.ulp(0.0), math.inf)
_NOT_NEGATIVE = Interval(0.0, math.inf)
_UNIT = Interval(-1.0, 1.0)


@kernel
def _neg_backward(rl, ru, al, au):  # type: ignore[no-untyped-def]
    return intersect(-ru, -rl, al, au)


def _not_zero(x: Any) -> list[tuple[Any, Interval]]:
    return [(abs(x), _POSITIVE)]


def _within(interval: Interval) -> Any:
    return lambda x: [(x, interval)]


def _order(a: Any, b: Any) -> Any:
    """Return 1 where a > b, 0 where a < b, between them [0, 1]."""
    return 0.5 * (sign(a - b) + 1.0)


def _step(name: str, forward: Any, backward: Any, doc: str) -> Operation:
    """Return an operation that jumps between whole numbers: it is continuous on a box where it has one value, less itself [0, 0]."""
    step = Operation(name, forward, backward, continuous=lambda a: [(step(a) - step(a), Interval(0.0))], doc=doc)
    return step


add = Operation("add", arithmetic.add, backward.add_backward, derivative=lambda a, b, r: (1.0, 1.0), doc="Return a + b.")
sub = Operation("sub", arithmetic.sub, backward.sub_backward, derivative=lambda a, b, r: (1.0, -1.0), doc="Return a − b.")
mul = Operation("mul", arithmetic.mul, backward.mul_backward, derivative=lambda a, b, r: (b, a), doc="Return a·b.")
div = Operation(
    "div",
    arithmetic.div,
    backward.div_backward,
    derivative=lambda a, b, r: (1.0 / b, -r / b),
    defined=lambda a, b: _not_zero(b),
    doc="Return a / b for b ≠ 0.",
)
neg = Operation("neg", arithmetic.neg, _neg_backward, derivative=lambda a, r: (-1.0,), doc="Return −a.")
recip = Operation(
    "recip", arithmetic.recip, reverse.recip_reverse, derivative=lambda a, r: (-sqr(r),), defined=_not_zero, doc="Return 1 / a for a ≠ 0."
)
sqr: Operation = Operation("sqr", arithmetic.sqr, reverse.sqr_reverse, derivative=lambda a, r: (2.0 * a,), doc="Return a².")
sqrt = Operation(
    "sqrt",
    arithmetic.sqrt,
    reverse.sqrt_reverse,
    derivative=lambda a, r: (0.5 / r,),
    defined=_within(_NOT_NEGATIVE),
    doc="Return √a for a ≥ 0.",
)
absolute = Operation("absolute", arithmetic.absolute, reverse.abs_reverse, derivative=lambda a, r: (sign(a),), doc="Return \\|a\\|.")
minimum = Operation(
    "minimum",
    arithmetic.minimum,
    backward.minimum_backward,
    derivative=lambda a, b, r: (_order(b, a), _order(a, b)),
    doc="Return the smaller of a and b.",
)
maximum = Operation(
    "maximum",
    arithmetic.maximum,
    backward.maximum_backward,
    derivative=lambda a, b, r: (_order(a, b), _order(b, a)),
    doc="Return the larger of a and b.",
)
multiply_add = Operation(
    "multiply_add",
    arithmetic.multiply_add,
    backward.multiply_add_backward,
    derivative=lambda a, b, c, r: (b, a, 1.0),
    doc="Return a·b + c, rounded once.",
)

sign: Operation = _step("sign", integer.sign, reverse_integer.sign_reverse, "Return −1, 0 or 1.")
floor = _step("floor", integer.floor, reverse_integer.floor_reverse, "Return the largest whole number not above a.")
ceil = _step("ceil", integer.ceil, reverse_integer.ceil_reverse, "Return the smallest whole number not below a.")
trunc = _step("trunc", integer.trunc, reverse_integer.trunc_reverse, "Return a without its fraction.")
round_ties_to_even = _step(
    "round_ties_to_even",
    integer.round_ties_to_even,
    reverse_integer.round_ties_to_even_reverse,
    "Return the nearest whole number, the even one of two.",
)
round_ties_to_away = _step(
    "round_ties_to_away",
    integer.round_ties_to_away,
    reverse_integer.round_ties_to_away_reverse,
    "Return the nearest whole number, of two the one farther from 0.",
)

pown = Operation(
    "pown",
    pown_forward,
    pown_backward,
    derivative=lambda a, n, r: (whole_exponent(n) * a ** (whole_exponent(n) - 1) if whole_exponent(n) else 0.0, 0.0),
    defined=lambda a, n: _not_zero(a) if whole_exponent(n) < 0 else [],
    check=require_exponent,
    doc="Return aⁿ for a constant whole number n; for n < 0 where a ≠ 0.",
)
rootn = Operation(
    "rootn",
    rootn_forward,
    rootn_backward,
    derivative=lambda a, n, r: (r / (whole_exponent(n) * a), 0.0),
    defined=lambda a, n: (_not_zero(a) if whole_exponent(n) < 0 else []) + ([(a, _NOT_NEGATIVE)] if whole_exponent(n) % 2 == 0 else []),
    check=require_root,
    doc="Return the n-th root of a for a constant whole number n ≠ 0; for even n where a ≥ 0.",
)
pow: Operation = Operation(
    "pow",
    powers.pow,
    reverse_powers.pow_backward,
    derivative=lambda a, b, r: (b * pow(a, b - 1.0), r * log(a)),
    defined=lambda a, b: [(a, _POSITIVE)],
    doc="Return a^b for a > 0, and 0^b = 0 for b > 0.",
)

exp = Operation("exp", exponential.exp, reverse.exp_reverse, derivative=lambda a, r: (r,), doc="Return e^a.")
exp2 = Operation("exp2", exponential.exp2, reverse.exp2_reverse, derivative=lambda a, r: (r * log(2.0),), doc="Return 2^a.")
exp10 = Operation("exp10", exponential.exp10, reverse.exp10_reverse, derivative=lambda a, r: (r * log(10.0),), doc="Return 10^a.")
log: Operation = Operation(
    "log",
    exponential.log,
    reverse.log_reverse,
    derivative=lambda a, r: (1.0 / a,),
    defined=_within(_POSITIVE),
    doc="Return the natural logarithm of a > 0.",
)
log2 = Operation(
    "log2",
    exponential.log2,
    reverse.log2_reverse,
    derivative=lambda a, r: (1.0 / (a * log(2.0)),),
    defined=_within(_POSITIVE),
    doc="Return the logarithm of a > 0 to base 2.",
)
log10 = Operation(
    "log10",
    exponential.log10,
    reverse.log10_reverse,
    derivative=lambda a, r: (1.0 / (a * log(10.0)),),
    defined=_within(_POSITIVE),
    doc="Return the logarithm of a > 0 to base 10.",
)
sinh = Operation("sinh", exponential.sinh, reverse.sinh_reverse, derivative=lambda a, r: (cosh(a),), doc="Return the hyperbolic sine.")
cosh: Operation = Operation(
    "cosh", exponential.cosh, reverse.cosh_reverse, derivative=lambda a, r: (sinh(a),), doc="Return the hyperbolic cosine."
)
tanh = Operation(
    "tanh", exponential.tanh, reverse.tanh_reverse, derivative=lambda a, r: (1.0 - sqr(r),), doc="Return the hyperbolic tangent."
)
asinh = Operation(
    "asinh",
    exponential.asinh,
    reverse.asinh_reverse,
    derivative=lambda a, r: (1.0 / sqrt(sqr(a) + 1.0),),
    doc="Return the inverse of the hyperbolic sine.",
)
acosh = Operation(
    "acosh",
    exponential.acosh,
    reverse.acosh_reverse,
    derivative=lambda a, r: (1.0 / sqrt(sqr(a) - 1.0),),
    defined=_within(Interval(1.0, math.inf)),
    doc="Return the inverse of the hyperbolic cosine, for a ≥ 1.",
)
atanh = Operation(
    "atanh",
    exponential.atanh,
    reverse.atanh_reverse,
    derivative=lambda a, r: (1.0 / (1.0 - sqr(a)),),
    defined=lambda a: [(1.0 - abs(a), _POSITIVE)],
    doc="Return the inverse of the hyperbolic tangent, for -1 < a < 1.",
)

sin = Operation(
    "sin", trigonometric.sin, reverse_periodic.sin_reverse, derivative=lambda a, r: (cos(a),), doc="Return the sine of a in radians."
)
cos: Operation = Operation(
    "cos", trigonometric.cos, reverse_periodic.cos_reverse, derivative=lambda a, r: (-sin(a),), doc="Return the cosine of a in radians."
)
tan = Operation(
    "tan",
    trigonometric.tan,
    reverse_periodic.tan_reverse,
    derivative=lambda a, r: (sqr(r) + 1.0,),
    defined=lambda a: _not_zero(cos(a)),
    doc="Return the tangent of a in radians.",
)
asin = Operation(
    "asin",
    trigonometric.asin,
    reverse_periodic.asin_reverse,
    derivative=lambda a, r: (1.0 / sqrt(1.0 - sqr(a)),),
    defined=_within(_UNIT),
    doc="Return the arc sine of a in [−1, 1], in [−π/2, π/2].",
)
acos = Operation(
    "acos",
    trigonometric.acos,
    reverse_periodic.acos_reverse,
    derivative=lambda a, r: (-1.0 / sqrt(1.0 - sqr(a)),),
    defined=_within(_UNIT),
    doc="Return the arc cosine of a in [−1, 1], in [0, π].",
)
atan = Operation(
    "atan",
    trigonometric.atan,
    reverse_periodic.atan_reverse,
    derivative=lambda a, r: (1.0 / (sqr(a) + 1.0),),
    doc="Return the arc tangent.",
)
atan2 = Operation(
    "atan2",
    trigonometric.atan2,
    reverse_polar.atan2_backward,
    derivative=lambda y, x, r: (x / (sqr(x) + sqr(y)), -y / (sqr(x) + sqr(y))),
    defined=lambda y, x: [(maximum(abs(x), abs(y)), _POSITIVE)],
    continuous=lambda y, x: [(maximum(x, abs(y)), _POSITIVE)],
    doc="Return the angle of the point (x, y) ≠ (0, 0), in (−π, π]; y comes first.",
)
hypot = Operation(
    "hypot",
    trigonometric.hypot,
    reverse_polar.hypot_backward,
    derivative=lambda a, b, r: (a / r, b / r),
    doc="Return √(a² + b²).",
)

OPERATIONS = {operation.name: operation for operation in list(vars().values()) if isinstance(operation, Operation)}
"""All of them by name."""
