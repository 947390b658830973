"""Every public name of `ial.contractors` at work. As a program: change the processor's mode, and write which of them did not refuse it.

Run in a process of its own, since the mode stays: ``python -m tests.contractors.guarded WHERE FIELD VALUE``, where WHERE is "caller", or
"workers" for threads that were started in the foreign mode, and FIELD is "mode" or the number of a word of the control registers.
"""

import ctypes
import ctypes.util
import math
import sys
from collections.abc import Callable
from typing import Any

import numpy as np

import ial.contractors as toolkit
from ial.contractors import threads
from ial.errors import RoundingModeError

# Names that compute no bound: classes and combinators whose work is done by `contract`, `image` and the like, below, and settings.
EXACT = {
    "Clusters",
    "Constraint",
    "ConstraintFamily",
    "Contractor",
    "ContractorLike",
    "Expression",
    "Family",
    "FunctionFamily",
    "MinimalOutliers",
    "Operation",
    "Paving",
    "from_crival",
    "from_pyinterval",
    "get_threads",
    "negation",
    "set_threads",
    "to_crival",
    "to_pyinterval",
    "variables",
}


def works() -> dict[str, Callable[[], Any]]:
    """Return, for each public name that computes bounds, something that makes it do so."""
    t = toolkit
    a, plane, cube = t.Interval(1, 2), t.Boxes.of([(1, 2), (3, 4)])[np.zeros(70_000, dtype=int)], t.Boxes.of([(1, 2), (3, 4), (5, 6)])
    x, y = t.variables("x y")
    ring = x**2 + y**2 == t.Interval(1, 25)
    disk = t.Annulus((0.0, 0.0), t.Interval(0, 5))
    both = t.Separator.of(ring)
    function = t.Function(x + y, x * y)
    affine = t.Affine.rigid(1.0, 2.0, 0.5)
    paving = t.pave(ring, plane[:1], 0.5)
    problem = t.Problem((x, y), {"x": (1, 2), "y": (3, 4)}, [ring])
    calls: dict[str, Callable[[], Any]] = {
        "Affine": lambda: affine.image(plane),
        "Annulus": lambda: disk.contract(plane),
        "Boxes": lambda: plane + plane,
        "Distance": lambda: t.Distance().contract(t.Boxes.of([(0, 1)] * 5)),
        "Function": lambda: function.image(plane),
        "Interval": lambda: a + a,
        "Intersection": lambda: t.Intersection(ring, disk).contract(plane),
        "Newton": lambda: t.Newton(function).contract(plane),
        "PointCloud": lambda: t.PointCloud(np.zeros((3, 2))).contract(plane),
        "Polar": lambda: t.Polar().contract(t.Boxes.of([(0, 1)] * 4)),
        "Polygon": lambda: t.Polygon([(0, 0), (1, 0), (0, 1)]).contract(plane),
        "Problem": lambda: problem.contract(plane),
        "RangeBearing": lambda: t.RangeBearing().contract(t.Boxes.of([(0, 1)] * 7)),
        "Relaxed": lambda: t.Relaxed(ring, disk, outliers=1).contract(plane),
        "Segment": lambda: t.Segment((0, 0), (1, 1)).contract(plane),
        "Segments": lambda: t.Segments([(0, 0)], [(1, 1)]).contract(plane),
        "Separator": lambda: both.separate(plane),
        "Union": lambda: t.Union(ring, disk).contract(plane),
        "certify": lambda: t.certify(function, plane),
        "check_rounding": t.check_rounding,
        "cluster": lambda: t.cluster(paving.boxes),
        "divide_pieces": lambda: t.divide_pieces(a, a),
        "fixpoint": lambda: t.fixpoint(ring).contract(plane),
        "from_polar": lambda: t.from_polar(t.Separator.of(ring)).separate(plane),
        "intersection": lambda: t.intersection([ring, disk]).contract(plane),
        "lazy": lambda: t.lazy([ring, disk]).contract(plane),
        "mean_value": lambda: t.mean_value(x * y - x == 1.0).contract(plane),
        "minimal_outliers": lambda: t.minimal_outliers([both, both], plane[:1], 0.5),
        "narrow": lambda: t.narrow(t.sqr, a, a),
        "pave": lambda: t.pave(ring, plane[:1], 0.5),
        "projection": lambda: t.projection(ring, [0], [(3, 4)], 0.5).contract(t.Boxes.of([(1, 2)])),
        "relaxed": lambda: t.relaxed([ring, disk], outliers=1).contract(plane),
        "relaxed_intersection": lambda: t.relaxed_intersection(np.zeros((9, 2, 1)), np.ones((9, 2, 1)), 1),
        "smear": lambda: t.smear(function.jacobian)(plane),
        "to_polar": lambda: t.to_polar(t.Separator.of(ring)).separate(plane),
        "transform": lambda: t.transform(ring, affine, affine.inverse).contract(plane),
        "union": lambda: t.union([ring, disk]).contract(plane),
        "where": lambda: t.where(ring, [0, 2], 3).contract(cube),
        "zeros": lambda: t.zeros(function, plane[:1], 0.5),
    }
    for name in t.__all__:
        operation = getattr(t, name)
        if isinstance(operation, t.Operation):
            operands = [a, 2][: operation.arity] if name in ("pown", "rootn") else [a] * operation.arity
            calls[name] = lambda operation=operation, operands=operands: operation(*operands)
    # What belongs to a name above but has entries of its own.
    more: dict[str, Callable[[], Any]] = {
        "Interval.parse": lambda: t.Interval.parse("[0.1, 0.2]"),
        "Boxes.around": lambda: t.Boxes.around(np.zeros((1, 2)), 0.1),
        "Operation.bounds": lambda: t.add.bounds((np.zeros(3), np.ones(3)), (np.zeros(3), np.ones(3))),
        "Constraint.contract": lambda: ring.contract(plane),
        "Constraint.complement": lambda: (~ring).contract(plane),
        "ConstraintFamily.contract_each": lambda: (x - np.array([1.0, 2.0]) == 1.0).contract_each(plane),
        "Function.jacobian": lambda: function.jacobian(plane),
        "Function.holds": lambda: t.Function(t.sqrt(x)).holds("defined", plane),
        "Function.preimage": lambda: function.preimage(disk).contract(plane),
        "Paving.volume": lambda: paving.volume(),
        "Problem.propagate": lambda: problem.propagate(),
        "Problem.solve": lambda: problem.solve(0.5),
    }
    return calls | more


def main(where: str, field: str, value: str) -> None:
    """Change the mode, call everything, and write the names that gave an answer."""
    libm = ctypes.CDLL(ctypes.util.find_library("m") or "libm.so.6")
    calls = works()

    def foreign() -> None:
        if field == "mode":
            assert libm.fesetround(int(value)) == 0
            return
        environment = (ctypes.c_uint32 * 16)()
        assert libm.fegetenv(environment) == 0
        environment[int(field)] |= int(value)
        assert libm.fesetenv(environment) == 0

    if where == "workers":
        threads.set_threads(2)
        environment = (ctypes.c_uint32 * 16)()
        assert libm.fegetenv(environment) == 0
        pool = threads._executor(2)
        foreign()
        for done in [pool.submit(math.sqrt, 2.0) for _ in range(64)]:  # starts the threads, which take over the mode of this one
            done.result()
        assert libm.fesetenv(environment) == 0
    else:
        foreign()
    for name, work in calls.items():
        try:
            work()
        except RoundingModeError:
            continue
        sys.stdout.write(f"{name}\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
