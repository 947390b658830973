"""Sets of configurations moved: each box turned, driven on, and bisected where its image is too wide."""

import numpy as np

from ial.contractors.intervals.angle import intersect_angle, wrap_angle
from ial.contractors.intervals.arithmetic import add, mul
from ial.contractors.intervals.trigonometric import cos, sin
from ial.contractors.kernels import kernel
from ial.odometer.casting import COLUMNS, cast, free_way, place, read_sides

_ARCS = 3
_CROWD = 128
_PAYS = 0.7  # a box that was narrowed to less than this share is tried again before it is bisected


@kernel
def turned(rows, turn_l, turn_u):  # type: ignore[no-untyped-def]
    """Return rows of bounds with their headings turned by an interval of angles."""
    result = rows.copy()
    for i in range(len(rows)):
        tl, tu = add(rows[i, 6], rows[i, 7], turn_l, turn_u)
        result[i, 6], result[i, 7] = wrap_angle(tl, tu)
    return result


@kernel
def stayed(corners, edges, links, facing, rows):  # type: ignore[no-untyped-def]
    """Return rows of those robots that cannot drive on at all: their headings lead into a wall or out of a corner."""
    result = np.empty((3 * _ARCS * len(rows), COLUMNS))
    count = 0
    for i in range(len(rows)):
        wall = int(rows[i, 8])
        if wall < 0:
            result[count] = rows[i]
            count += 1
            continue
        after, before = links[wall, 0], links[wall, 1]
        for number in range(3):
            part_l, part_u, other = rows[i, 0], rows[i, 1], wall
            if number == 1:  # at the end of the wall, the next one stops a robot, too, if the corner is convex
                if part_u < 1.0 or links[after, 2]:
                    continue
                part_l, part_u, other = 1.0, 1.0, after
            if number == 2:
                if part_l > 0.0 or links[wall, 2]:
                    continue
                part_l, part_u, other = 0.0, 0.0, before
            for half in range(_ARCS):  # each shorter than half a turn, so that it leads into the wall in one piece
                step = (rows[i, 7] - rows[i, 6]) / _ARCS
                low = rows[i, 6] if half == 0 else rows[i, 6] + half * step
                high = rows[i, 7] if half == _ARCS - 1 else rows[i, 6] + (half + 1) * step
                tl, tu = intersect_angle(low, high, facing[other, 0], facing[other, 1])
                if tl <= tu:
                    result[count] = rows[i]
                    result[count, 0], result[count, 1], result[count, 6], result[count, 7] = part_l, part_u, tl, tu
                    result[count, 2], result[count, 3], result[count, 4], result[count, 5] = place(corners, edges, result[count])
                    count += 1
    return result[:count].copy()


@kernel
def _driven(corners, edges, links, start, least, most, sides, into, heights, ways, ends):  # type: ignore[no-untyped-def]
    """Write the row of robots that were stopped by no wall, but by their command; return 1, or 0 if a wall stops all of them."""
    wall = int(start[8])
    ul, uu = cos(start[6], start[7])
    vl, vu = sin(start[6], start[7])
    read_sides(corners, edges, wall, start, ul, uu, vl, vu, sides, into, heights)
    most = free_way(links, wall, start, sides, into, heights, ways, most)
    if not least <= most:
        return 0
    pxl, pxu, pyl, pyu = place(corners, edges, start)
    ql, qu = mul(least, most, ul, uu)
    ends[0, 2], ends[0, 3] = add(pxl, pxu, ql, qu)
    ql, qu = mul(least, most, vl, vu)
    ends[0, 4], ends[0, 5] = add(pyl, pyu, ql, qu)
    ends[0, 0], ends[0, 1], ends[0, 6], ends[0, 7], ends[0, 8] = 0.0, 0.0, start[6], start[7], -1.0
    return 1


@kernel
def _width(row, lengths):  # type: ignore[no-untyped-def]
    """Return how wide a row is in the plane, in metres, and which side of it is the widest."""
    wall = int(row[8])
    if wall >= 0:
        return (row[1] - row[0]) * lengths[wall], 0
    x, y = row[3] - row[2], row[5] - row[4]
    return (x, 2) if x >= y else (y, 4)


@kernel
def _is_small(row, lengths, fine_m, fine_rad):  # type: ignore[no-untyped-def]
    return _width(row, lengths)[0] <= fine_m and row[7] - row[6] <= fine_rad


@kernel
def _halve(queue, at, tail, lengths, fine_m, fine_rad):  # type: ignore[no-untyped-def]
    """Cut a row in two at the side that is the widest beside what is wanted; return whether it could be cut."""
    row = queue[at]
    wide, side = _width(row, lengths)
    if (row[7] - row[6]) * fine_m > wide * fine_rad:
        side = 6
    middle = 0.5 * (row[side] + row[side + 1])
    if not row[side] < middle < row[side + 1]:
        return False
    queue[tail] = row
    queue[tail, side], row[side + 1] = middle, middle
    return True


@kernel
def advanced(corners, edges, links, lengths, rows, limits, free, fine, budget):  # type: ignore[no-untyped-def]
    """Return the rows to which robots come that drive by more than nothing, and how many of them are wider than was wanted.

    Parameters
    ----------
    rows
        Where they start, headings those of the drive.
    limits
        The least and the greatest distance.
    free
        Whether they stop of their own accord, and not at a wall.
    fine
        The wanted widths in metres and in radians: a row with wider images is bisected, until it is itself as small. Then the same for
        crowds: where more than `_CROWD` rows are as small as these, they are many because they lie along a curve, and are left so.
    budget
        How many rows are tried at most before the rest is left as wide as it is.
    """
    n, least, most, fine_m, fine_rad = len(corners), limits[0], limits[1], fine[0], fine[1]
    sides, into, heights, ways = np.empty((n, 2)), np.empty((n, 2)), np.empty((n, 2)), np.empty((n, 2))
    starts, ends = np.empty((n, COLUMNS)), np.empty((n, COLUMNS))
    budget = max(budget, 2 * len(rows))
    queue = np.empty((len(rows) + budget + 1, COLUMNS))
    queue[: len(rows)] = rows
    head, tail = 0, len(rows)
    result, count, wide = np.empty((64, COLUMNS)), 0, 0
    end_of_generation, crowded = 0, False
    while head < tail:
        if head >= end_of_generation:
            end_of_generation, crowded = tail, tail - head > _CROWD
        row = queue[head]
        if free:
            hits = _driven(corners, edges, links, row, least, most, sides, into, heights, ways, ends)
        else:
            hits = cast(corners, edges, links, row, least, most, sides, into, heights, ways, starts, ends)
        small = True
        for hit in range(hits):
            small = small and _is_small(ends[hit], lengths, fine_m, fine_rad)
        small = small or (crowded and _is_small(row, lengths, fine[2], fine[3]))
        if hits and not small and not _is_small(row, lengths, fine_m, fine_rad) and tail < len(queue):
            if not free:  # what leads to none of the ends is left out
                before = _width(row, lengths)[0], row[7] - row[6]
                for side in (0, 6):
                    row[side], row[side + 1] = starts[:hits, side].min(), starts[:hits, side + 1].max()
                after = _width(row, lengths)[0], row[7] - row[6]
                if after[0] < _PAYS * before[0] or after[1] < _PAYS * before[1]:
                    continue
            if _halve(queue, head, tail, lengths, fine_m, fine_rad):
                tail += 1
                continue
        for hit in range(hits):
            if count == len(result):
                grown = np.empty((2 * len(result), COLUMNS))
                grown[:count] = result
                result = grown
            result[count] = ends[hit]
            count += 1
            wide += not _is_small(ends[hit], lengths, fine_m, fine_rad)
        head += 1
    return result[:count].copy(), wide
