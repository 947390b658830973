"""`candidates`: where a robot may be that drove a chord of the polygon, turned, and drove another.

The robot starts at p_a = p_1 + a·E_1 on a first wall, stops at p_b = p_2 + b·E_2 on a second and at p_c = p_3 + c·E_3 on a third. With
w = p_b − p_a of length d_1, the second length d_2, and R the turn between, p_c = p_b + (d_2/d_1)·R·w. That p_c is on the line of the
third wall is linear, G·a + H·b + I = 0, and leaves a quadratic equation in one of them (O'Kane and LaValle, Localization with limited
sensing, IEEE Transactions on Robotics 2007, section IV-B; their equation 5 has the quotient upside down, and their constants divide by
coordinates that are 0 for walls along an axis). Here it is solved in intervals, so that the lengths and the turn may be intervals too, and
each box holds every solution that it stands for. Two cases are not isolated:

* all directions w are one: the three walls are parallel, and the robot slides along them (section IV-C there);
* G, H and I are all 0: the first and the third wall are at right angles for a right turn, and the second line passes through their common
  point, so that a curve of configurations fits, along which the heading varies (Cardan's motion; the paper misses it).

Both are told by intervals that hold 0, and become chains of boxes.
"""

import numpy as np

from ial.contractors.intervals.angle import direction, wrap_angle
from ial.contractors.intervals.arithmetic import add, div, mul, sqr, sqrt, sub
from ial.contractors.intervals.rotation import rotate
from ial.contractors.intervals.sets import intersect, mignitude
from ial.contractors.intervals.trigonometric import cos, hypot, sin
from ial.contractors.kernels import kernel
from ial.odometer.casting import COLUMNS, cast, cross
from ial.odometer.chords import blocked, wrapped

_PIECES = 64  # of a wall in a chain of boxes
_SLIDING = 1e-4  # of the first way: by how much it may change along a chain of one direction
_NARROW = 1e-7  # of the size: boxes narrower than this are first looked at in plain doubles, with a doubt a hundred times as large


@kernel
def _linear(fixed, sides, turn, ratio, found):  # type: ignore[no-untyped-def]
    """Write G, H, I of a triple; `fixed` holds p_2 − p_1 and p_2 − p_3, `sides` E_1, E_2, E_3, all as four bounds."""
    e3 = sides[2]
    for row in range(3):  # of E_1, E_2 and p_2 − p_1, turned
        v = sides[row] if row < 2 else fixed[0]
        xl, xu, yl, yu = rotate(turn[0], turn[1], turn[2], turn[3], v[0], v[1], v[2], v[3])
        al, au = cross(xl, xu, yl, yu, e3[0], e3[1], e3[2], e3[3])
        al, au = mul(al, au, ratio[0], ratio[1])
        if row == 0:
            found[0, 0], found[0, 1] = -au, -al
            continue
        o = sides[1] if row == 1 else fixed[1]
        bl, bu = cross(o[0], o[1], o[2], o[3], e3[0], e3[1], e3[2], e3[3])
        found[row, 0], found[row, 1] = add(al, au, bl, bu)


@kernel
def _affine(base, slope, low, high, result):  # type: ignore[no-untyped-def]
    """Write base + [low, high]·slope, two coordinates as four bounds."""
    for at in (0, 2):
        pl, pu = mul(low, high, slope[at], slope[at + 1])
        result[at], result[at + 1] = add(base[at], base[at + 1], pl, pu)


@kernel
def _finish(fixed, sides, turn, ratio, first, parts, way):  # type: ignore[no-untyped-def]
    """Narrow c in parts[2] by a, b and the first way w in `way`; return whether it is not empty and |w| is as read.

    parts: bounds of a, b, c.
    """
    al, au = hypot(way[0], way[1], way[2], way[3])
    if al > first[1] or au < first[0]:
        return False
    xl, xu, yl, yu = rotate(turn[0], turn[1], turn[2], turn[3], way[0], way[1], way[2], way[3])
    xl, xu = mul(xl, xu, ratio[0], ratio[1])
    yl, yu = mul(yl, yu, ratio[0], ratio[1])
    e2, e3 = sides[1], sides[2]
    bl, bu = mul(parts[1, 0], parts[1, 1], e2[0], e2[1])
    xl, xu = add(xl, xu, bl, bu)
    bl, bu = mul(parts[1, 0], parts[1, 1], e2[2], e2[3])
    yl, yu = add(yl, yu, bl, bu)
    xl, xu = add(xl, xu, fixed[1, 0], fixed[1, 1])  # p_c − p_3
    yl, yu = add(yl, yu, fixed[1, 2], fixed[1, 3])
    bl, bu = cross(xl, xu, yl, yu, e3[0], e3[1], e3[2], e3[3])
    if bl > 0.0 or bu < 0.0:
        return False
    bl, bu = mul(xl, xu, e3[0], e3[1])
    cl, cu = mul(yl, yu, e3[2], e3[3])
    bl, bu = add(bl, bu, cl, cu)
    xl, xu = sqr(e3[0], e3[1])
    yl, yu = sqr(e3[2], e3[3])
    xl, xu = add(xl, xu, yl, yu)
    bl, bu = div(bl, bu, xl, xu)
    parts[2, 0], parts[2, 1] = intersect(0.0, 1.0, bl, bu)
    return parts[2, 0] <= parts[2, 1]


@kernel
def _note(row, parts, way):  # type: ignore[no-untyped-def]
    """Write a, b, c and w into a row of ten bounds."""
    for at in range(3):
        row[2 * at], row[2 * at + 1] = parts[at, 0], parts[at, 1]
    for at in range(4):
        row[6 + at] = way[at]


@kernel
def _roots(fixed, sides, turn, ratio, first, lines, found):  # type: ignore[no-untyped-def]
    """Write boxes of a triple into `found`, rows of a, b, c and w (ten bounds); return how many, or −1 for a curve in a and b."""
    swap = mignitude(lines[1, 0], lines[1, 1]) > mignitude(lines[0, 0], lines[0, 1])
    one, other = (1, 0) if swap else (0, 1)  # the variable that is eliminated, and the one that is left
    if lines[one, 0] <= 0.0 <= lines[one, 1]:
        return 0 if lines[2, 0] > 0.0 or lines[2, 1] < 0.0 else -1
    gl, gu = div(lines[other, 0], lines[other, 1], lines[one, 0], lines[one, 1])
    hl, hu = div(lines[2, 0], lines[2, 1], lines[one, 0], lines[one, 1])
    gl, gu, hl, hu = -gu, -gl, -hu, -hl  # eliminated = g·left + h
    base, slope, way, eliminated, left = np.empty(4), np.empty(4), np.empty(4), np.empty(4), np.empty(4)
    parts = np.empty((3, 2))
    for at in range(4):
        eliminated[at] = sides[1, at] if swap else -sides[0, at ^ 1]
        left[at] = -sides[0, at ^ 1] if swap else sides[1, at]
    _affine(fixed[0], eliminated, hl, hu, base)
    _affine(left, eliminated, gl, gu, slope)
    al, au = sqr(slope[0], slope[1])
    bl, bu = sqr(slope[2], slope[3])
    square_l, square_u = add(al, au, bl, bu)
    count = 0
    pieces = 2
    sliding = not square_l > 0.0 or square_u < _SLIDING**2 * first[0] * first[0]
    if sliding:
        pieces = _PIECES
        root_l = root_u = middle_l = middle_u = 0.0
    else:
        al, au = cross(base[0], base[1], base[2], base[3], slope[0], slope[1], slope[2], slope[3])
        al, au = sqr(al, au)
        bl, bu = sqr(first[0], first[1])
        bl, bu = mul(bl, bu, square_l, square_u)
        al, au = sub(bl, bu, al, au)
        if au < 0.0:
            return 0
        root_l, root_u = sqrt(max(al, 0.0), au)
        if al <= 0.0:  # both roots, or none
            root_l, pieces = -root_u, 1
        al, au = mul(base[0], base[1], slope[0], slope[1])
        bl, bu = mul(base[2], base[3], slope[2], slope[3])
        middle_l, middle_u = add(al, au, bl, bu)
    for piece in range(pieces):
        if sliding:
            vl, vu = piece / _PIECES, (piece + 1) / _PIECES
        else:
            al, au = (root_l, root_u) if piece == 0 else (-root_u, -root_l)
            al, au = sub(al, au, middle_l, middle_u)
            al, au = div(al, au, square_l, square_u)
            vl, vu = intersect(0.0, 1.0, al, au)
        if not vl <= vu:
            continue
        al, au = mul(gl, gu, vl, vu)
        al, au = add(al, au, hl, hu)
        al, au = intersect(0.0, 1.0, al, au)
        if not al <= au:
            continue
        parts[other, 0], parts[other, 1], parts[one, 0], parts[one, 1] = vl, vu, al, au
        _affine(base, slope, vl, vu, way)
        if _finish(fixed, sides, turn, ratio, first, parts, way):
            _note(found[count], parts, way)
            count += 1
    return count


@kernel
def _curve(fixed, sides, turn, ratio, first, found):  # type: ignore[no-untyped-def]
    """Write boxes around the curve of a and b with |w| = d_1 and the third point on its wall: as `_roots`, by bisection."""
    stack = np.empty((4 * _PIECES, 4))
    stack[0, 0], stack[0, 1], stack[0, 2], stack[0, 3] = 0.0, 1.0, 0.0, 1.0
    size, count = 1, 0
    way, half, negative, parts = np.empty(4), np.empty(4), np.empty(4), np.empty((3, 2))
    for at in range(4):
        negative[at] = -sides[0, at ^ 1]
    while size:
        size -= 1
        al, au, bl, bu = stack[size, 0], stack[size, 1], stack[size, 2], stack[size, 3]
        _affine(fixed[0], negative, al, au, half)
        _affine(half, sides[1], bl, bu, way)
        parts[0, 0], parts[0, 1], parts[1, 0], parts[1, 1] = al, au, bl, bu
        if not _finish(fixed, sides, turn, ratio, first, parts, way):
            continue
        if max(au - al, bu - bl) <= 1.0 / _PIECES or count > len(found) - size - 4:
            _note(found[count], parts, way)
            count += 1
            continue
        for part in range(2):
            stack[size, 0], stack[size, 1], stack[size, 2], stack[size, 3] = al, au, bl, bu
            at = 0 if au - al >= bu - bl else 2
            middle = 0.5 * (stack[size, at] + stack[size, at + 1])
            stack[size, at + 1 - part] = middle
            size += 1
    return count


@kernel
def _may_see(corners, edges, i, j, found, way, doubt):  # type: ignore[no-untyped-def]
    """Return whether the ways of a narrow box are not plainly blocked, in doubles; `way` is the second one."""
    part = 0.5 * (found[2] + found[3])
    bx, by = corners[j, 0] + part * edges[j, 0], corners[j, 2] + part * edges[j, 2]
    part = 0.5 * (found[0] + found[1])
    ax, ay = corners[i, 0] + part * edges[i, 0], corners[i, 2] + part * edges[i, 2]
    if blocked(corners, edges, ax, ay, bx, by, doubt):
        return False
    return not blocked(corners, edges, bx, by, bx + way[0], by + way[1], doubt)


@kernel
def candidates(corners, edges, links, size, table, first, second, turn_l, turn_u):  # type: ignore[no-untyped-def]
    """Return rows of bounds of all robots that drove one chord, turned, and drove a second one; and rows of where they came from.

    The latter hold bounds of a, b and c as the equations give them, and the numbers of the three walls: float64 of shape (m, 9).

    Parameters
    ----------
    table
        What `ial.odometer.chords.chords` returns.
    first, second
        Bounds of the lengths of the two ways, greater than 0.
    turn_l, turn_u
        The turn between them, in radians.
    """
    n = len(corners)
    cl, cu = cos(turn_l, turn_u)
    sl, su = sin(turn_l, turn_u)
    turn = np.array([cl, cu, sl, su])
    ratio = np.empty(2)
    ratio[0], ratio[1] = div(second[0], second[1], first[0], first[1])
    fixed, sides, lines, found = np.empty((2, 4)), np.empty((3, 4)), np.empty((3, 2)), np.empty((16 * _PIECES, 10))
    room = np.empty((4, n, 2))
    starts, ends, start = np.empty((n, COLUMNS)), np.empty((n, COLUMNS)), np.zeros(COLUMNS)
    result, origins, count, way = np.empty((64, COLUMNS)), np.empty((64, 9)), 0, np.empty(2)
    middle = 0.5 * (turn_l + turn_u)
    for j in range(n):
        for i in range(n):
            one = table[i, j]
            if one[0] > first[1] or one[1] < first[0]:
                continue
            for k in range(n):
                two = table[j, k]
                if two[0] > second[1] or two[1] < second[0]:
                    continue
                if abs(wrapped(one[2] + middle - two[2])) > one[3] + two[3] + (turn_u - turn_l):
                    continue
                for at in range(2):
                    fixed[0, 2 * at], fixed[0, 2 * at + 1] = sub(
                        corners[j, 2 * at], corners[j, 2 * at + 1], corners[i, 2 * at], corners[i, 2 * at + 1]
                    )
                    fixed[1, 2 * at], fixed[1, 2 * at + 1] = sub(
                        corners[j, 2 * at], corners[j, 2 * at + 1], corners[k, 2 * at], corners[k, 2 * at + 1]
                    )
                sides[0], sides[1], sides[2] = edges[i], edges[j], edges[k]
                _linear(fixed, sides, turn, ratio, lines)
                boxes = _roots(fixed, sides, turn, ratio, first, lines, found)
                if boxes < 0:
                    boxes = _curve(fixed, sides, turn, ratio, first, found)
                for box in range(boxes):
                    row = found[box]
                    tl, tu = direction(row[8], row[9], row[6], row[7])
                    wide = max(max(row[7] - row[6], row[9] - row[8]), 0.25 * max(row[1] - row[0], row[3] - row[2]) * size)
                    if wide < _NARROW * size:  # all ways of the box are within a few widths of the middle one, times d_2/d_1 for the second
                        wx, wy = 0.5 * (row[6] + row[7]), 0.5 * (row[8] + row[9])
                        way[0] = 0.5 * (ratio[0] + ratio[1]) * (cl * wx - sl * wy)
                        way[1] = 0.5 * (ratio[0] + ratio[1]) * (sl * wx + cl * wy)
                        scale = max(1.0, ratio[1])
                        if not _may_see(corners, edges, i, j, row, way, 100.0 * scale * _NARROW * size):
                            continue
                    start[0], start[1], start[6], start[7], start[8] = row[0], row[1], tl, tu, i
                    hits = cast(corners, edges, links, start, first[0], first[1], room[0], room[1], room[2], room[3], starts, ends)
                    seen = False
                    for hit in range(hits):
                        seen = seen or ends[hit, 8] == j
                    if not seen:
                        continue
                    tl, tu = add(tl, tu, turn_l, turn_u)
                    start[0], start[1], start[8] = row[2], row[3], j
                    start[6], start[7] = wrap_angle(tl, tu)
                    hits = cast(corners, edges, links, start, second[0], second[1], room[0], room[1], room[2], room[3], starts, ends)
                    for hit in range(hits):
                        if ends[hit, 8] != k:
                            continue
                        if count == len(result):
                            result, origins = np.concatenate((result, result)), np.concatenate((origins, origins))
                        result[count] = ends[hit]
                        origins[count, :6] = row[:6]
                        origins[count, 6], origins[count, 7], origins[count, 8] = i, j, k
                        count += 1
    return result[:count].copy(), origins[:count].copy()
