"""Every operation beside crival, and some beside pyinterval: random and adversarial inputs by the million, forward and backward."""

import multiprocessing
import sys
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import numpy as np
from report import Report, options

from ial.contractors import Operation, set_threads
from ial.contractors.expressions.functions import OPERATIONS
from ial.contractors.intervals import arithmetic, sets
from ial.contractors.intervals.trigonometric import LARGEST_ANGLE
from ial.contractors.threads import available_threads

sys.path.append(str(Path(__file__).parents[1]))  # the oracles are those of the tests

from reverse_oracles import REVERSE, Reverse, narrow

from tests.contractors.oracles import EXPONENTS, ORACLES, WITH_EXPONENT, Pairs, hard_intervals, hard_numbers, intervals, rows, slack, tight
from tests.contractors.solutions import points, problems

ABOUT = f"""\
Half of the inputs are intervals of special doubles (0, subnormals, powers of two, the largest), their neighbours, doubles of any size, and
infinite bounds; the other half lie next to where a function is hard: multiples of π/4 up to ±{LARGEST_ANGLE:g} and of ln(2)/2, whole
and half numbers, powers of 2 and 10, and 1. `tests/contractors/oracles.py` draws them. *slack* is by how many doubles a bound is wider
than crival's, which is tight. *missed* must be 0 everywhere.

- Forward: a result misses if it does not enclose crival's.
- Backward: a random solution is drawn first, then its function value, and intervals around both. A result misses if it loses the solution.
  *tight* compares with what crival's reverse functions leave of each operand by itself, where there are such functions."""
ROWS = 50_000
REACH = ("sin", "cos", "tan")  # tight up to LARGEST_ANGLE, and only sound beyond
OTHERS = {kernel.__name__: kernel for kernel in (sets.intersect, sets.hull, arithmetic.cancel_minus, arithmetic.cancel_plus)}
NEAR = 4  # doubles


@dataclass
class Tally:
    """Counts of results."""

    inputs: int = 0
    missed: int = 0
    compared: int = 0
    slacks: Counter[int] = field(default_factory=Counter)
    example: str = ""

    def __iadd__(self, other: "Tally") -> "Tally":
        self.inputs += other.inputs
        self.missed += other.missed
        self.compared += other.compared
        self.slacks += other.slacks
        self.example = self.example or other.example
        return self

    def cells(self) -> Iterator[str]:
        """Yield the numbers for a table."""
        yield f"{self.inputs:,}"
        yield f"{self.missed:,}"
        if not self.compared:
            yield from ("–", "–", "–")
            return
        for most in (0, NEAR):
            yield f"{100.0 * sum(count for steps, count in self.slacks.items() if steps <= most) / self.compared:.3f} %"
        largest = max(self.slacks)
        yield f"{largest:,}" if largest < 1 << 20 else f"2^{largest.bit_length() - 1}"


def forward_tally(exact: Pairs, ours: Pairs, reach: Any, given: Iterable[Pairs]) -> Tally:
    """Compare results with the tight ones; slack is counted where `reach` is true."""
    empty = (exact[0] > exact[1]) | (exact[0] == np.inf)  # crival's rootn(x, -2) of [-1, 0], where nothing is defined, is [inf, inf]
    exact = np.where(empty, np.inf, exact[0]), np.where(empty, -np.inf, exact[1])
    steps = slack(exact, ours)
    lost = ~empty & ~((ours[0] <= exact[0]) & (exact[1] <= ours[1]))
    counted = np.where(empty & ~(ours[0] > ours[1]), steps, np.maximum(steps, 0))[reach]
    values, counts = np.unique(counted, return_counts=True)
    example = ""
    if lost.any():
        at = int(lost.argmax())
        shown = [(float(lower[at]), float(upper[at])) for lower, upper in (*given, ours, exact)]
        example = f"operands {shown[:-2]}: found {shown[-2]}, crival has {shown[-1]}"
    return Tally(len(lost), int(lost.sum()), int(reach.sum()), Counter(dict(zip(values.tolist(), counts.tolist(), strict=True))), example)


def inputs(seed: int, count: int) -> list[Pairs]:
    """Return three operands: half of the rows of every kind, half of hard ones."""
    half = count // 2
    pairs = []
    for k in range(3):
        parts = zip(intervals(count - half, seed + 10 * k), hard_intervals(half, seed + 10 * k + 5), strict=True)
        lower, upper = (np.concatenate(part) for part in parts)
        order = np.random.default_rng(seed + k).permutation(count)
        pairs.append((lower[order], upper[order]))
    return pairs


def forward(operation: Operation, operands: list[Pairs]) -> Iterator[Tally]:
    """Yield how an operation does on three operands, of which it takes the first ones."""
    if operation.forward in ORACLES:
        given = operands[: operation.arity]
        lower, upper = given[0]
        within = (lower >= -LARGEST_ANGLE) & (upper <= LARGEST_ANGLE)
        reach = within if operation.name in REACH else np.ones(len(lower), dtype=bool)
        yield forward_tally(tight(ORACLES[operation.forward].function, *given), operation.bounds(*given), reach, given)
        return
    (oracle,) = (oracle for kernel, oracle in WITH_EXPONENT.items() if kernel.py_func.__name__ == operation.name)
    for n, first in zip(EXPONENTS, range(len(EXPONENTS)), strict=True):
        part = operands[0][0][first :: len(EXPONENTS)], operands[0][1][first :: len(EXPONENTS)]
        power = np.full(len(part[0]), float(n))
        exact = tight(lambda x, n=n: oracle.function(x, n), part)
        yield forward_tally(exact, operation.bounds(part, (power, power)), np.ones(len(power), dtype=bool), [part, (power, power)])


def backward(operation: Operation, reverse: Reverse, seed: int, hard: list[Any]) -> Tally:
    """Return how the reverse of an operation does on random problems with a known solution."""
    rng = np.random.default_rng(seed)
    drawn = [points(len(x), seed + 100 * k, reverse.scale) for k, x in enumerate(hard[: reverse.operands])]
    drawn = [np.where(rng.random(len(x)) < 0.5, x, y) for x, y in zip(drawn, hard, strict=False)]
    result, priors, solutions = problems(reverse.function, seed + 1, *drawn)
    exponent = [] if reverse.exponent is None else [(np.full(len(result[0]), float(reverse.exponent)),) * 2]
    ours = narrow(operation, result, *priors, *exponent)
    kept = [
        (start <= lower) & (lower <= x) & (x <= upper) & (upper <= stop)
        for (lower, upper), (start, stop), x in zip(ours, priors, solutions, strict=False)
    ]
    lost = ~np.logical_and.reduce(kept)
    tally = Tally(len(lost), int(lost.sum()))
    if lost.any():
        at = int(lost.argmax())
        shown = [(float(lower[at]), float(upper[at])) for lower, upper in (result, *priors)]
        tally.example = f"result and operands {shown}: lost {[float(x[at]) for x in solutions]}"
    for oracle, (lower, upper) in zip(reverse.oracles, ours, strict=False):
        exact = tight(oracle, result, *priors)
        within = np.logical_and.reduce([(pair[0] >= -LARGEST_ANGLE) & (pair[1] <= LARGEST_ANGLE) for pair in priors])
        reach = within if operation.name in REACH else np.ones(len(lost), dtype=bool)
        steps = np.maximum(slack(exact, (lower, upper)), 0)[reach & (exact[0] <= exact[1])]
        values, counts = np.unique(steps, return_counts=True)
        tally += Tally(compared=len(steps), slacks=Counter(dict(zip(values.tolist(), counts.tolist(), strict=True))))
    return tally


def chunk(job: tuple[int, int]) -> dict[tuple[str, str], Tally]:
    """Return tallies of one part of the inputs, by direction and operation."""
    seed, count = job
    set_threads(1)
    tallies: dict[tuple[str, str], Tally] = {}
    operands = inputs(seed, count)
    for name, operation in OPERATIONS.items():
        tally = tallies.setdefault(("forward", name), Tally())
        for part in forward(operation, operands):
            tally += part
    for name, kernel in OTHERS.items():
        exact = tight(ORACLES[kernel].function, *operands[:2])
        tallies["forward", name] = forward_tally(exact, rows(kernel, *operands[:2]), np.ones(count, dtype=bool), operands[:2])
    hard = [hard_numbers(count, seed + 1000 * k) for k in range(3)]
    for name, reverses in REVERSE.items():
        tally = tallies.setdefault(("backward", name), Tally())
        for first, reverse in enumerate(reverses):
            tally += backward(OPERATIONS[name], reverse, seed + 7, [x[first :: len(reverses)] for x in hard])
    return tallies


def with_pyinterval(count: int) -> dict[str, Tally]:
    """Return how often an enclosure of f(x) at a point and pyinterval's, if not empty, have no number in common: one is then wrong."""
    from interval import imath, interval

    binary: dict[str, Callable[..., Any]] = {"add": lambda a, b: a + b, "sub": lambda a, b: a - b, "mul": lambda a, b: a * b}
    unary = {name: getattr(imath, name) for name in ("sqrt", "exp", "log", "sin", "cos", "tan", "atan", "sinh", "cosh", "tanh")}
    tallies: dict[str, Tally] = {}
    for name, function in (binary | unary).items():
        operation = OPERATIONS[name]
        given = [hard_numbers(count, 77 + k) for k in range(operation.arity)]
        lower, upper = operation.bounds(*((x, x) for x in given))
        tally = tallies.setdefault(name, Tally(count))
        for i, point in enumerate(zip(*(x.tolist() for x in given), strict=True)):
            other = function(*map(interval, point))
            if len(other) and not (lower[i] <= other[0].sup and other[0].inf <= upper[i]):
                tally.missed += 1
                tally.example = tally.example or f"operands {point}: found {(float(lower[i]), float(upper[i]))}, pyinterval has {other}"
    return tallies


def installed(package: str) -> str:
    """Return a package and its version."""
    try:
        return f"{package} {version(package)}"
    except PackageNotFoundError:
        return f"{package} is not installed"


def main() -> int:
    """Compare, print, and write; the exit status is 1 if something was missed."""
    parser = options(__doc__ or "")
    parser.add_argument("--inputs", type=int, default=1_000_000, metavar="COUNT", help="inputs for each operation (default: %(default)s)")
    chosen = parser.parse_args()
    libraries = ", ".join(map(installed, ("crival", "pyinterval", "mpmath")))
    report = Report("Beside other interval libraries", f"{ABOUT}\n\n{libraries}.")
    jobs = [(1_000_003 * (k + 1), min(ROWS, chosen.inputs - start)) for k, start in enumerate(range(0, chosen.inputs, ROWS))]
    total: dict[tuple[str, str], Tally] = {}
    with ProcessPoolExecutor(available_threads(), multiprocessing.get_context("spawn")) as pool:
        for part in pool.map(chunk, jobs):
            for key, tally in part.items():
                total[key] = total.setdefault(key, Tally())
                total[key] += tally
    for direction in ("forward", "backward"):
        chosen_rows = [(name, tally) for (way, name), tally in total.items() if way == direction]
        report.say(f"## {direction.capitalize()}\n")
        head = ("operation", "inputs", "missed", "tight", f"slack ≤ {NEAR}", "largest slack")
        report.table(head, ([name, *tally.cells()] for name, tally in chosen_rows))
    tallies = {" ".join(key): tally for key, tally in total.items()}
    report.say(
        f"Of `{'`, `'.join(REACH)}`, slack is counted up to ±{LARGEST_ANGLE:g}; beyond, they return what holds for every angle. "
        "A bound of a prior so near to a solution that rounding cannot tell stays: its slack is then the way to the next solution.\n"
    )
    if "is not" not in installed("pyinterval"):
        second = with_pyinterval(max(1, chosen.inputs // 100))
        tallies |= {f"pyinterval {name}": tally for name, tally in second.items()}
        report.say("## Beside pyinterval\n\nAt points, enclosures must have a number in common.\n")
        report.table(("operation", "inputs", "missed"), ([name, f"{tally.inputs:,}", tally.missed] for name, tally in second.items()))
    missed = sum(tally.missed for tally in tallies.values())
    report.say(f"**{missed:,} missed** of {sum(tally.inputs for tally in tallies.values()):,}.")
    for name, tally in tallies.items():
        if tally.example:
            report.say(f"- {name}: {tally.example}")
    report.write(chosen.out)
    return int(missed > 0)


if __name__ == "__main__":
    sys.exit(main())
