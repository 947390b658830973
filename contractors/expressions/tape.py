"""`Tape`: expressions as a list of instructions, which `ial.contractors.expressions.machine` runs over a batch."""

from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.expressions.machine import evaluate_rows, narrow_rows
from ial.contractors.expressions.operation import LANES, IntervalArrays, Operation
from ial.contractors.intervals.interval import Interval
from ial.contractors.threads import run

_SHARED_STEPS = 1 << 15  # so many instructions on one row each take as long as waking a thread


class Node(Protocol):
    """What a tape reads of an expression: a variable has an axis, a constant has bounds, anything else an operation and operands."""

    @property
    def axis(self) -> int | None:
        """The number of a variable."""
        ...

    @property
    def bounds(self) -> IntervalArrays | None:
        """The bounds of a constant: two arrays of one value, or of one for each row."""
        ...

    @property
    def operation(self) -> Operation | None:
        """What is applied to the operands."""
        ...

    @property
    def operands(self) -> Sequence["Node"]:
        """What it is applied to."""
        ...


def ordered(outputs: Sequence[Node]) -> list[Node]:
    """Return all nodes that some outputs are made of, each once, operands before what uses them."""
    nodes: dict[int, Node] = {}
    stack = [(node, False) for node in reversed(outputs)]
    while stack:
        node, visited = stack.pop()
        if id(node) in nodes:
            continue
        if visited or not node.operands:
            nodes[id(node)] = node
        else:
            stack.append((node, True))
            stack.extend((operand, False) for operand in reversed(node.operands))
    return list(nodes.values())


class Tape:
    """Instructions that compute several expressions at once; equal subexpressions are computed once.

    Two constants are the same if both are the same number. Two intervals are not, even with the same bounds: each stands for a number of
    its own, and going backward narrows it.

    Parameters
    ----------
    dimension
        The number of variables of the boxes it runs on.
    outputs
        The expressions, or intervals for constant ones.
    """

    def __init__(self, dimension: int, outputs: Sequence[Node | Interval]) -> None:
        self.dimension = dimension
        nodes = [node for node in outputs if not isinstance(node, Interval)]
        slots: dict[int, int] = {}  # from a node's identity to where its value stands
        known: dict[Any, int] = {}  # the same from what it computes
        constants: list[IntervalArrays] = []
        instructions: list[tuple[Operation, tuple[int, ...]]] = []
        order = ordered(nodes)

        def place(identity: int, key: Any) -> bool:
            """Give a value its place, and return whether it is new."""
            count = len(known)
            slots[identity] = known.setdefault(key, count)
            return len(known) > count

        axes = [node.axis for node in order if node.axis is not None and place(id(node), ("axis", node.axis))]
        intervals = [(np.array([node.lower]), np.array([node.upper])) for node in outputs if isinstance(node, Interval)]
        given = [(id(node), node.bounds) for node in order] + [(id(bounds), bounds) for bounds in intervals]
        for identity, bounds in given:
            if bounds is not None:
                key = ("number", bounds[0].tobytes()) if np.array_equal(*bounds) else ("interval", identity)
                if place(identity, key):
                    constants.append(bounds)
        for node in order:
            if node.operation is not None:
                operands = tuple(slots[id(operand)] for operand in node.operands)
                if place(id(node), (id(node.operation), operands)):
                    instructions.append((node.operation, operands))
        remaining = iter(intervals)
        self.outputs = np.array([slots[id(next(remaining) if isinstance(node, Interval) else node)] for node in outputs], dtype=np.int64)
        self.axes = np.array(axes, dtype=np.int64)
        count = max([1, *(len(lower) for lower, _ in constants)])
        self.constants = np.empty((2, count, len(constants)))
        for k, bounds in enumerate(constants):
            self.constants[:, :, k] = bounds
        self._instructions = instructions
        self._program: npt.NDArray[np.int64] | None = None

    @property
    def count(self) -> int:
        """The number of rows of the constants; 1 if none varies."""
        return int(self.constants.shape[1])

    @property
    def program(self) -> npt.NDArray[np.int64]:
        """The instructions, int64 of shape (k, 6): addresses of the row loops forward and backward, slots of three operands and the result.

        The address backward is 0 where no operand depends on a variable. Row loops are compiled when they are first needed.
        """
        if self._program is None:
            first = len(self.axes) + self.constants.shape[2]
            varying = set(range(len(self.axes)))
            rows = []
            for slot, (operation, operands) in enumerate(self._instructions, first):
                active = not varying.isdisjoint(operands)
                varying.update([slot] if active else [])
                places = [*operands, *[operands[0]] * (3 - len(operands)), slot]
                rows.append([operation.forward_loop.address, operation.backward_loop.address if active else 0, *places])
            self._program = np.array(rows, dtype=np.int64).reshape(-1, 6)
        return self._program

    @property
    def _share(self) -> int:
        """The smallest number of rows worth a thread of its own."""
        return max(LANES, _SHARED_STEPS // (1 + len(self._instructions)))

    def evaluate(self, boxes: Boxes, members: int = 1) -> IntervalArrays:
        """Return the natural extension: bounds of every output on every box, each float64 of shape (n·members, outputs).

        Parameters
        ----------
        boxes
            n boxes; row i of the result belongs to box i // `members` and to row i % `count` of the constants.
        members
            How often each box is taken.
        """
        rows = len(boxes) * members
        lower, upper = np.empty((rows, len(self.outputs))), np.empty((rows, len(self.outputs)))
        given = (boxes.lower, boxes.upper, members, self.axes, self.constants, self.program, self.outputs)
        run(evaluate_rows, rows, *given, lower, upper, minimum=self._share)
        return lower, upper

    def narrow(self, boxes: Boxes, targets: FloatArray, members: int = 1, rounds: int = 1) -> Boxes:
        """Return the boxes narrowed by: every output lies in its target (HC4-revise on all outputs together).

        Parameters
        ----------
        boxes
            n boxes; row i of the result belongs to box i // `members` and to row i % `count` of the constants.
        targets
            Lower and upper bounds of the outputs, float64 of shape (2, rows of targets, outputs); row i takes row i % rows of targets.
        members
            How often each box is taken.
        rounds
            How often the tape runs forward and backward.
        """
        rows = len(boxes) * members
        lower, upper = np.empty((rows, self.dimension)), np.empty((rows, self.dimension))
        given = (boxes.lower, boxes.upper, members, self.axes, self.constants, self.program, self.outputs, targets, rounds)
        run(narrow_rows, rows, *given, lower, upper, minimum=self._share)
        return Boxes(lower, upper)
