"""The paver: contract, discard, bisect, repeat. Everything in ial that bisects calls this one."""

from collections.abc import Callable
from typing import NamedTuple

import numpy.typing as npt

from ial.contractors.boxes import Boxes
from ial.contractors.contractor import ContractorLike, require_dimension
from ial.contractors.paving.bisection import Cells, Division, Rule
from ial.contractors.paving.difference import difference
from ial.contractors.paving.limits import Deadline, Limit
from ial.contractors.paving.paving import Paving
from ial.contractors.paving.search import check_boxes, check_limits, checked_precision
from ial.contractors.paving.waiting import Order, waiting
from ial.contractors.rounding import check_rounding
from ial.contractors.separator import Separator

_BATCH = 1 << 16  # enough for all threads
_BEST_BATCH = 1 << 8  # the first of an order, not all that wait


class Progress(NamedTuple):
    """How far a search has come.

    Parameters
    ----------
    nodes
        How many boxes were contracted.
    waiting
        How many boxes wait.
    finished
        How many boxes the paving has already.
    elapsed_s
        Seconds since the search began.
    """

    nodes: int
    waiting: int
    finished: int
    elapsed_s: float


def pave(
    constraint: ContractorLike | Separator,
    boxes: Boxes,
    precision: npt.ArrayLike,
    *,
    order: Order = "depth",
    rule: Rule = "largest",
    max_boxes: int = 1_000_000,
    max_seconds: float | None = None,
    max_bytes: int | None = None,
    batch: int | None = None,
    progress: Callable[[Progress], object] | None = None,
) -> Paving:
    """Return a paving of all points of `boxes` that satisfy a constraint.

    Boxes are contracted, emptied ones are discarded, and those with a side above its wanted precision are bisected. With a separator, what
    its outer contractor cuts off is discarded, what its inner contractor then cuts off consists of solutions and is kept as inner boxes,
    and the rest is bisected; what is left at the wanted precision is the boundary.

    The result does not depend on the number of threads; without `max_seconds` it is always the same.

    Parameters
    ----------
    constraint
        A contractor or a separator of dimension d. A separator has two contractors: `outer` removes only points outside the set, `inner`
        only points of the set.
    boxes
        Where to search. Empty ones are passed over.
    precision
        The wanted width along each axis: one number, or shape (d,). Along an axis with an infinite one nothing is bisected. A side whose
        bounds are neighbouring doubles is not bisected either.
    order
        Which boxes are contracted next.

        - ``"depth"``: those that were bisected last, a batch at a time. Few boxes wait.
        - ``"breadth"``: those that have waited longest. Stopped early, the paving is equally coarse everywhere.
        - ``"best"``: the widest, measured as for the rule ``"largest"``.
        - a function of `Boxes` that gives keys of shape (n,): those with the largest key.
    rule
        Which side is bisected, among those that are wider than their precision.

        - ``"largest"``: the widest, measured in units of its precision.
        - ``"round_robin"``: the one that follows the side bisected last.
        - a function of `Boxes` that gives weights of shape (n, d), such as `smear`: the one with the largest weight.
    max_boxes
        Boxes are not bisected where that would make more than this many, finished and waiting together; they are returned as they are.
    max_seconds
        A limit on time; None for none. When it is near, smaller portions are contracted, so that it is missed by about one call of the
        contractor. A search that reaches it is not reproducible.
    max_bytes
        A limit on the memory that the boxes take, finished and waiting, and once more for the result that they are copied to; the memory
        of one contraction comes on top. It works like `max_boxes`.
    batch
        The largest number of boxes that one contraction takes, 65536 by default, and 256 for the orders that take the best.
    progress
        Called after every batch. What it raises ends the search.

    Raises
    ------
    ValueError
        If an argument cannot be used, if a bound is NaN, or if the contractor returns boxes of another shape.

    References
    ----------
    Jaulin, Walter: Set inversion via interval analysis for nonlinear bounded-error estimation, Automatica 29 (1993), with a contractor in
    the place of the inclusion test. Jaulin, Desrochers: Introduction to the algebra of separators, Engineering Applications of Artificial
    Intelligence 33 (2014). Guyonneau et al., Advanced Robotics 28 (2014), algorithm 1.
    """
    check_rounding()
    require_dimension(constraint, boxes)
    check_boxes(boxes)
    check_limits(max_boxes=max_boxes, max_bytes=max_bytes, batch=batch, max_seconds=max_seconds)
    widths = checked_precision(precision, boxes.dimension)
    _check_words(order, rule)
    batch = (_BEST_BATCH if callable(order) or order == "best" else _BATCH) if batch is None else batch
    affordable = max_boxes if max_bytes is None else max_bytes // (32 * boxes.dimension)  # two bounds, 8 bytes each, and once more
    deadline = Deadline(max_seconds)
    inner, boundary = [Boxes.none(boxes.dimension)], [Boxes.none(boxes.dimension)]
    kept = nodes = 0
    limited: Limit = ""
    cells = waiting(order, widths, batch)
    cells.push(Cells.uncut(boxes[~boxes.empty]))
    while len(cells) and limited != "time":
        rows = cells.pop()
        solutions, rest = _contract(constraint, rows.boxes, deadline)
        if len(rest) < len(rows.boxes):
            limited = "time"
            boundary.append(rows.boxes[len(rest) :])
        nodes += len(rest)
        division = Division(Cells(rest, rows.last[: len(rest)]), widths, rule)
        held = kept + len(cells) + len(solutions) + division.finished + 2 * division.cut
        if division.cut and held > min(max_boxes, affordable):
            limited = limited or ("boxes" if held > max_boxes else "memory")
        if limited == "time" or (division.cut and held > min(max_boxes, affordable)):
            division.stop()
        finished, halves = division.carry_out()
        cells.push(halves)
        inner.append(solutions)
        boundary.append(finished)
        kept += len(solutions) + len(finished)
        if progress is not None:
            progress(Progress(nodes, len(cells), kept, deadline.elapsed_s))
    while len(cells):
        boundary.append(cells.pop().boxes)
    return Paving(Boxes.concatenate(boundary), Boxes.concatenate(inner), limited, nodes)


def _contract(constraint: ContractorLike | Separator, boxes: Boxes, deadline: Deadline) -> tuple[Boxes, Boxes]:
    """Return boxes of solutions, and the rest of each box; the rest has fewer rows if the time was up."""
    solutions, rest = [], []
    start = 0
    while start < len(boxes):
        stop = start + deadline.portion(len(boxes) - start)
        if start == stop:
            break
        rows = boxes if stop - start == len(boxes) else boxes[start:stop]
        if isinstance(constraint, Separator):
            possible = _narrowed(constraint.outer, rows)
            undecided = _narrowed(constraint.inner, possible)
            solutions.append(difference(possible, undecided))
        else:
            undecided = _narrowed(constraint, rows)
        rest.append(undecided)
        deadline.worked(stop - start)
        start = stop
    return _joined(solutions, boxes.dimension), _joined(rest, boxes.dimension)


def _joined(batches: list[Boxes], dimension: int) -> Boxes:
    return batches[0] if len(batches) == 1 else Boxes.concatenate([Boxes.none(dimension), *batches])


def _narrowed(contractor: ContractorLike, boxes: Boxes) -> Boxes:
    narrowed = contractor.contract(boxes)
    if narrowed.lower.shape != boxes.lower.shape:
        raise ValueError(
            f"{type(contractor).__name__} returned bounds of shape {narrowed.lower.shape} for {boxes.lower.shape}; "
            "a contractor returns one box for each box, and an empty one where nothing is left"
        )
    return narrowed


def _check_words(order: Order, rule: Rule) -> None:
    for name, value, words in (("order", order, ("depth", "breadth", "best")), ("rule", rule, ("largest", "round_robin"))):
        if not callable(value) and value not in words:
            raise ValueError(f"the {name} is {value!r}; give one of {', '.join(words)}, or a function of boxes")
