"""The one compiled machine that runs any tape, forward and backward, over a batch.

It knows operations only by the addresses of their row loops, so that no expression and no user's operation ever needs it to be compiled
again. It takes `LANES` rows at a time through the whole tape, which keeps all values in the fastest cache.
"""

import numpy as np

from ial.contractors.expressions.operation import LANES, call
from ial.contractors.kernels import kernel


@kernel
def _load_variables(lanes, first, count, lower, upper, members, axes):  # type: ignore[no-untyped-def]
    for v in range(len(axes)):
        # Counting rows, since a division for each of them would cost more than the rest.
        low, high = lanes[v]
        box, member = divmod(first, members)
        for i in range(count):
            low[i] = lower[box, axes[v]]
            high[i] = upper[box, axes[v]]
            member += 1
            if member == members:
                member = 0
                box += 1


@kernel
def _load_constants(lanes, first, count, slot, constants):  # type: ignore[no-untyped-def]
    rows = constants.shape[1]
    for k in range(constants.shape[2]):
        for side in range(2):
            if rows == 1:
                lanes[slot + k, side, :count] = constants[side, 0, k]
            else:
                row = first % rows
                for i in range(count):
                    lanes[slot + k, side, i] = constants[side, row, k]
                    row = row + 1 if row + 1 < rows else 0


@kernel
def _meet_targets(lanes, first, count, outputs, targets):  # type: ignore[no-untyped-def]
    rows = targets.shape[1]
    for k in range(len(outputs)):
        low, high = lanes[outputs[k]]
        row = first % rows
        for i in range(count):
            low[i] = max(low[i], targets[0, row, k])
            high[i] = min(high[i], targets[1, row, k])
            row = row + 1 if row + 1 < rows else 0


@kernel
def _mark_empty(lanes, count, slots, empty):  # type: ignore[no-untyped-def]
    for k in range(len(slots)):
        low, high = lanes[slots[k]]
        for i in range(count):
            empty[i] = 1.0 if low[i] > high[i] else empty[i]


@kernel
def _all_marked(empty, count):  # type: ignore[no-untyped-def]
    for i in range(count):  # noqa: SIM110 - Numba compiles a loop to less than a generator
        if empty[i] == 0.0:
            return False
    return True


@kernel
def _store(lanes, first, count, lower, upper, members, places, empty, out_lower, out_upper):  # type: ignore[no-untyped-def]
    """Write the boxes: sides of variables from the lanes, the others as they were, all sides empty where one is."""
    for axis in range(lower.shape[1]):
        place = places[axis]
        box, member = divmod(first, members)
        for i in range(count):
            low = lanes[place, 0, i] if place >= 0 else lower[box, axis]
            high = lanes[place, 1, i] if place >= 0 else upper[box, axis]
            out_lower[first + i, axis] = np.inf if empty[i] > 0.0 else low
            out_upper[first + i, axis] = -np.inf if empty[i] > 0.0 else high
            member += 1
            if member == members:
                member = 0
                box += 1


@kernel
def _forward(lanes, count, program):  # type: ignore[no-untyped-def]
    at = lanes.ctypes.data
    for k in range(len(program)):
        step = program[k]
        call(step[0], count, *_addresses(at, step))


@kernel
def _backward(lanes, count, program):  # type: ignore[no-untyped-def]
    at = lanes.ctypes.data
    for k in range(len(program) - 1, -1, -1):
        step = program[k]
        if step[1] != 0:
            call(step[1], count, *_addresses(at, step))


@kernel
def _addresses(at, step):  # type: ignore[no-untyped-def]
    size = 16 * LANES
    return at + size * step[2], at + size * step[3], at + size * step[4], at + size * step[5]


@kernel
def evaluate_rows(start, stop, lower, upper, members, axes, constants, program, outputs, out_lower, out_upper):  # type: ignore[no-untyped-def]
    """Write the bounds of every output on rows of boxes; see `Tape.evaluate`."""
    lanes = np.empty((len(axes) + constants.shape[2] + len(program), 2, LANES))
    for first in range(start, stop, LANES):
        count = min(LANES, stop - first)
        _load_variables(lanes, first, count, lower, upper, members, axes)
        _load_constants(lanes, first, count, len(axes), constants)
        _forward(lanes, count, program)
        for k in range(len(outputs)):
            for i in range(count):
                out_lower[first + i, k] = lanes[outputs[k], 0, i]
                out_upper[first + i, k] = lanes[outputs[k], 1, i]


@kernel
def narrow_rows(start, stop, lower, upper, members, axes, constants, program, outputs, targets, rounds, out_lower, out_upper):  # type: ignore[no-untyped-def]
    """Write rows of boxes, narrowed by the targets of the outputs; see `Tape.narrow`."""
    lanes = np.empty((len(axes) + constants.shape[2] + len(program), 2, LANES))
    empty = np.empty(LANES)  # 1.0 marks an empty row; a double, since loops over values of one size are vectorized
    variables = np.arange(len(axes))
    places = np.full(lower.shape[1], -1)
    for v in range(len(axes)):
        places[axes[v]] = v
    for first in range(start, stop, LANES):
        count = min(LANES, stop - first)
        _load_variables(lanes, first, count, lower, upper, members, axes)
        empty[:] = 0.0
        for _ in range(rounds):
            # Going backward narrows constants as well, so they are written anew in every round.
            _load_constants(lanes, first, count, len(axes), constants)
            _forward(lanes, count, program)
            _meet_targets(lanes, first, count, outputs, targets)
            _mark_empty(lanes, count, outputs, empty)
            if _all_marked(empty, count):  # often so: neighbours in space are neighbours in a batch
                break
            _backward(lanes, count, program)
        _mark_empty(lanes, count, variables, empty)
        _store(lanes, first, count, lower, upper, members, places, empty, out_lower, out_upper)
