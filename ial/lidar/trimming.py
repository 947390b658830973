"""How far a hypothesis really reaches: its outermost cells are halved again and again, and what holds no consistent pose is cut off.

A search ends with cells of one size. Where few of them are left, their outer faces can be found more finely: along each face the
outermost piece is looked for that may hold a consistent pose, cells first, then their halves, and so on. The cells inside stay whole, so
that what belongs together stays connected.
"""

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import Boxes
from ial.contractors.kernels import kernel
from ial.contractors.threads import run
from ial.lidar.beams import Beams
from ial.lidar.corners import OFFSET
from ial.lidar.end_points import relative_bounds
from ial.lidar.margins import NEAR
from ial.lidar.scan_contractor import fits
from ial.maps.cell_index import BORDER, CellIndex

_WIDEST = 64  # layers; a hypothesis that spans more headings is left as it is


@kernel
def _interval(lower, upper, depth, number):  # type: ignore[no-untyped-def]
    """Return one of the 2**depth pieces of an interval, which is halved again and again."""
    for level in range(depth):
        middle = lower + 0.5 * (upper - lower)
        if (number >> (depth - 1 - level)) & 1:
            lower = middle
        else:
            upper = middle
    return lower, upper


@kernel
def _outermost(axis, side, rows, boxes, depth, evidence, q, cells, known, bounds, stack, piece):  # type: ignore[no-untyped-def]
    """Find the piece of some cells that reaches farthest along an axis, down (side 0) or up; return whether there is one.

    Parameters
    ----------
    rows
        The cells, the farthest first.
    boxes
        Lower and upper bounds of the cells, and the layer of each, counted from the lowest one of the hypothesis.
    known, bounds
        For each layer and each node of the tree of its halves: whether the relative bounds of the beams are known, and these.
    stack
        Working space.
    piece
        Where to write the row of its cell, and its numbers along x, y and θ.
    """
    lower, upper, layers = boxes
    ends, directions, errors, map_error = evidence
    resolution, flat, stride, row_limit, column_limit, origin = cells
    second, third = (axis + 1) % 3, (axis + 2) % 3
    best = np.inf
    for row in rows:
        stack[0, :] = 0
        height = 1
        while height:
            height -= 1
            level, nx, ny, nt = stack[height]
            number = stack[height, 1 + axis]
            if axis == 2:
                begin = float(((layers[row] << level) + number) << (depth - level))
                begin = begin if side == 0 else -(begin + (1 << (depth - level)))
            else:
                low, high = _interval(lower[row, axis], upper[row, axis], level, number)
                begin = low if side == 0 else -high
            if begin >= best:
                continue
            layer, node = layers[row], (1 << level) + nt
            if not known[layer, node]:
                low, high = _interval(lower[row, 2], upper[row, 2], level, nt)
                relative_bounds(low, high, ends, directions, errors, map_error, resolution, bounds[layer, node])
                known[layer, node] = True
            xl, xu = _interval(lower[row, 0], upper[row, 0], level, nx)
            yl, yu = _interval(lower[row, 1], upper[row, 1], level, ny)
            xl, xu = xl / resolution - origin[1], xu / resolution - origin[1]
            yl, yu = yl / resolution - origin[0], yu / resolution - origin[0]
            near = min(xl, yl) >= -NEAR and max(xu, yu) <= NEAR
            xl, yl = xl + OFFSET, yl + OFFSET
            xu, yu = xu + (OFFSET + 1.0), yu + (OFFSET + 1.0)
            if near and not fits(xl, yl, xu, yu, bounds[layer, node], q, flat, stride, row_limit, column_limit):
                continue
            if level == depth:
                best = begin
                piece[0], piece[1], piece[2], piece[3] = row, nx, ny, nt
                continue
            numbers = (nx, ny, nt)
            for child in range(8):  # the last one put on the stack is the next, so the outer halves come last
                outer = (child >> 2) ^ (1 - side)
                stack[height, 0] = level + 1
                stack[height, 1 + axis] = 2 * numbers[axis] + outer
                stack[height, 1 + second] = 2 * numbers[second] + (child & 1)
                stack[height, 1 + third] = 2 * numbers[third] + ((child >> 1) & 1)
                height += 1
    return best < np.inf


@kernel
def _trim(start, stop, edges, lower, upper, layers, depth, evidence, q, grid, keep):  # type: ignore[no-untyped-def]
    """Cut the cells of each hypothesis, rows edges[i] … edges[i + 1] - 1, to its outermost pieces; empty cells are not kept."""
    resolution, bordered, origin = grid
    row_limit = np.int32(bordered.shape[0] - 1)
    column_limit = np.int32(bordered.shape[1] - 1 - 2 * BORDER)
    cells = (resolution, bordered.reshape(-1)[BORDER:], np.uint64(bordered.shape[1]), row_limit, column_limit, origin)
    beams = len(evidence[0])
    stack = np.empty((8 * (depth + 1), 4), dtype=np.int64)
    piece = np.empty(4, dtype=np.int64)
    for group in range(start, stop):
        first, behind = edges[group], edges[group + 1]
        boxes = (lower[first:behind].copy(), upper[first:behind].copy(), layers[first:behind])
        deepest = boxes[2].max() + 1
        if deepest > _WIDEST:
            continue
        known = np.zeros((deepest, 2 << depth), dtype=np.bool_)
        bounds = np.empty((deepest, 2 << depth, beams, 4))
        for axis in range(3):
            for side in range(2):
                far = boxes[2].astype(np.float64) if axis == 2 else (boxes[0] if side == 0 else boxes[1])[:, axis].copy()
                rows = np.argsort(far if side == 0 else -far)
                if not _outermost(axis, side, rows, boxes, depth, evidence, q, cells, known, bounds, stack, piece):
                    keep[first:behind] = False
                    break
                edge = _interval(boxes[0][piece[0], axis], boxes[1][piece[0], axis], depth, piece[1 + axis])[side]
                for row in range(first, behind):
                    beyond = layers[row] - boxes[2][piece[0]] if axis == 2 else 0
                    if side == 0:
                        keep[row] = keep[row] and beyond >= 0
                        if beyond == 0:
                            lower[row, axis] = max(lower[row, axis], edge)
                    else:
                        keep[row] = keep[row] and beyond <= 0
                        if beyond == 0:
                            upper[row, axis] = min(upper[row, axis], edge)
                    # What only touches the cut lies in other cells, too.
                    keep[row] = keep[row] and lower[row, axis] < upper[row, axis]


def trim(
    boxes: Boxes,
    labels: npt.NDArray[np.int64],
    layers: npt.NDArray[np.int64],
    beams: Beams,
    occupied: CellIndex,
    map_error_m: float,
    depth: int,
) -> tuple[Boxes, npt.NDArray[np.bool_]]:
    """Return the cells of hypotheses, cut to the finest outer pieces that may hold a consistent pose, and which of them are left.

    Parameters
    ----------
    boxes
        Cells of one lattice.
    labels
        The hypothesis of each.
    layers
        The layer of each, counted from the lowest one of its hypothesis.
    beams
        The evidence of the scan, and how many of its beams may be bad.
    occupied
        The cells that beams may end at.
    map_error_m
        How far the map may be wrong.
    depth
        How often cells are halved along each axis.
    """
    order = np.argsort(labels, kind="stable")
    edges = np.append(np.flatnonzero(np.append(True, np.diff(labels[order]) != 0)), len(order))
    lower, upper, keep = boxes.lower[order], boxes.upper[order], np.ones(len(order), dtype=np.bool_)
    evidence = (beams.ends, beams.directions, beams.errors, map_error_m)
    grid = (occupied.resolution, occupied.bordered, occupied.origin)
    run(_trim, len(edges) - 1, edges, lower, upper, layers[order], depth, evidence, beams.outliers, grid, keep, minimum=1)
    back = np.argsort(order)
    return Boxes(lower[back], upper[back]), keep[back]
