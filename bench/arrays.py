"""Operations on arrays of intervals beside crival, the vectorized library that the tests take their answers from."""

import sys
from collections.abc import Callable, Iterator
from importlib.metadata import version
from typing import Any

import numpy as np
import numpy.typing as npt
from report import Report, options
from timing import timed

from ial.contractors import Operation, add, atan2, cos, exp, mul, set_threads, sin, sqr, sqrt
from ial.contractors.threads import available_threads

try:
    import ival  # crival's module
except ImportError:
    ival = None

COUNT = 1_000_000
ABOUT = f"""\
{COUNT:,} intervals at once, their middles between −10 and 10 (for `sqrt` from 0 on), their widths up to 1. ial: `Operation.bounds`, with
the new arrays that it returns. *unequal* counts the results that differ from crival's, which are tight. Each time is the least of five."""
Pairs = tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]


def rows(other: Any) -> list[tuple[Operation, Callable[..., Any]]]:
    """Return the operations and crival's functions."""
    binary: list[tuple[Operation, Callable[..., Any]]] = [(add, lambda a, b: a + b), (mul, lambda a, b: a * b), (atan2, other.atan2)]
    return [*binary, (sqr, other.sqr), (sqrt, other.sqrt), (exp, other.exp), (sin, other.sin), (cos, other.cos)]


def intervals(seed: int, least: float) -> Pairs:
    """Return random intervals above a number."""
    rng = np.random.default_rng(seed)
    middle, half = rng.uniform(max(-10.0, least), 10.0, COUNT), rng.uniform(0.0, 0.5, COUNT)
    return np.maximum(middle - half, least), middle + half


def lines(threads: list[int]) -> Iterator[list[str]]:
    """Yield the cells of a line for each operation."""
    for operation, function in rows(ival):
        operands = [intervals(k, 0.0 if operation is sqrt else -np.inf) for k in range(operation.arity)]
        others = [ival.Interval(*pair) for pair in operands]
        other, tight = timed(function, *others)
        operation.bounds(*operands)  # loads its kernel
        times = []
        for count in threads:
            set_threads(count)
            elapsed, (lower, upper) = timed(operation.bounds, *operands)
            times.append(elapsed)
        unequal = np.count_nonzero((lower != tight.lo) | (upper != tight.hi))
        yield [operation.name, *(f"{1e9 * each / COUNT:.1f}" for each in (other, *times)), f"**{other / times[-1]:.1f}**", f"{unequal:,}"]


def main() -> None:
    """Measure, print, and write."""
    chosen = options(__doc__ or "").parse_args()
    if ival is None:
        sys.exit("crival is not installed; `make test` installs it, and so does `pip install crival`")
    threads = sorted({1, available_threads()})
    report = Report(f"Arrays, beside crival {version('crival')}", ABOUT)
    head = ("operation", "crival, ns", *(f"ial, ns, {count} thread{'s' * (count > 1)}" for count in threads), "ratio", "unequal")
    report.table(head, lines(threads))
    report.write(chosen.out)


if __name__ == "__main__":
    main()
