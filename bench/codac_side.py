"""What codac does of the comparison, run by `codac_process.py` in a process of its own.

It is given the name of a task, and its arguments as JSON on standard input, and prints the results as JSON. Only codac and the standard
library are imported here.
"""

import json
import sys
from collections.abc import Callable
from typing import Any

import codac as cd
from formulas import disc, distance, equations
from timing import timed


def box(sides: list[list[float]]) -> Any:
    """Return a box of codac."""
    return cd.IntervalVector(sides)


def nodes(paving: Any) -> int:
    """Return how many boxes were contracted. A paving from a contractor begins with two nodes that only frame the first box."""
    count = 0

    def visit(_: Any) -> bool:
        nonlocal count
        count += 1
        return True

    paving.tree().visit(visit)
    return count - 2 if isinstance(paving, cd.PavingOut) else count


def measured(work: Callable[[], Any]) -> dict[str, Any]:
    """Pave; return seconds, nodes, and the boxes that are not decided: their number and volume."""
    elapsed, paving = timed(work)
    boxes = paving.boxes(cd.PavingOut.outer if isinstance(paving, cd.PavingOut) else cd.PavingInOut.bound)
    return {"seconds": elapsed, "nodes": nodes(paving), "boxes": len(boxes), "volume": sum(part.volume() for part in boxes)}


def ring(form: str, centred: bool, precision: float) -> dict[str, Any]:
    """Pave x² + y² ∈ [1, 2] in [−3, 3]²."""
    x = cd.VectorVar(2)
    function, values, start = cd.AnalyticFunction([x], disc(cd, x)), cd.Interval(1, 2), box([[-3, 3]] * 2)
    if form == "test":
        return measured(lambda: cd.sivia(start, function, values, precision))
    constraint = (cd.SepInverse if form == "separator" else cd.CtcInverse)(function, values, centred)
    return measured(lambda: cd.pave(start, constraint, precision))


def system(name: str, dimension: int, side: list[float], precision: float, centred: bool) -> dict[str, Any]:
    """Pave the solutions of a system of equations."""
    x = cd.VectorVar(dimension)
    left = equations(name, cd, x)
    contractor = cd.CtcInverse(cd.AnalyticFunction([x], cd.vec(*left)), cd.IntervalVector([[0, 0]] * len(left)), centred)
    return measured(lambda: cd.pave(box([side] * dimension), contractor, precision))


def beacons(
    places: list[list[float]], ranges: list[list[float]], outliers: int, side: list[float], precision: float, centred: bool
) -> dict[str, Any]:
    """Pave the places at which at most some of the ranges from beacons are wrong."""
    x = cd.VectorVar(2)
    parts = [
        cd.CtcInverse(cd.AnalyticFunction([x], distance(cd, x, place)), cd.Interval(*reading), centred)
        for place, reading in zip(places, ranges, strict=True)
    ]
    contractor = cd.CtcQInter(outliers, *parts)
    return measured(lambda: cd.pave(box([side] * 2), contractor, precision))


def polar(boxes: list[list[list[float]]]) -> dict[str, Any]:
    """Contract boxes over x, y, r, θ one by one."""
    contractor = cd.CtcPolar()
    rows = [[cd.Interval(*bounds) for bounds in row] for row in boxes]
    elapsed, contracted = timed(lambda: [contractor.contract(*row) for row in rows])
    return {
        "seconds": elapsed,
        "boxes": [None if any(side.is_empty() for side in row) else [[s.lb(), s.ub()] for s in row] for row in contracted],
    }


if __name__ == "__main__":
    task = {"ring": ring, "system": system, "beacons": beacons, "polar": polar}[sys.argv[1]]
    print(json.dumps(task(**json.load(sys.stdin))))
