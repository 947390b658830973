"""Where a bundle of rays may end: robots on a piece of a wall, or in a box of the plane, that drive straight on in an interval of headings.

All of it is rounded outward by the interval operations. A bundle ends on a wall only if a ray of it crosses the wall from the left to the
right, its corners included: that covers corners that are hit, walls that a robot slides along, and reflex corners that it leaves (see
`ial.maps.polygons.exact.shooter`). What lies behind a wall that every ray of the bundle crosses is no end.
"""

import numpy as np

from ial.contractors.intervals.angle import direction, intersect_angle
from ial.contractors.intervals.arithmetic import add, div, mul, sqr, sub
from ial.contractors.intervals.sets import intersect
from ial.contractors.intervals.trigonometric import cos, hypot, sin
from ial.contractors.kernels import kernel

COLUMNS = 9
"""A row has bounds of the part of the wall, of x, of y and of the heading, and the number of the wall, −1 for a robot in the plane."""
ROUNDS = 3  # of narrowing the ends of a bundle; more narrow little


@kernel
def cross(axl, axu, ayl, ayu, bxl, bxu, byl, byu):  # type: ignore[no-untyped-def]
    """Return a_x·b_y − a_y·b_x."""
    pl, pu = mul(axl, axu, byl, byu)
    ql, qu = mul(ayl, ayu, bxl, bxu)
    return sub(pl, pu, ql, qu)


@kernel
def along(cl, cu, part_l, part_u, el, eu):  # type: ignore[no-untyped-def]
    """Return c + part·e: a coordinate of a point on a wall."""
    pl, pu = mul(part_l, part_u, el, eu)
    return add(cl, cu, pl, pu)


@kernel
def place(corners, edges, start):  # type: ignore[no-untyped-def]
    """Return the box of a row: bounds of x and of y."""
    wall = int(start[8])
    if wall < 0:
        return start[2], start[3], start[4], start[5]
    c, e = corners[wall], edges[wall]
    xl, xu = along(c[0], c[1], start[0], start[1], e[0], e[1])
    yl, yu = along(c[2], c[3], start[0], start[1], e[2], e[3])
    return xl, xu, yl, yu


@kernel
def read_sides(corners, edges, wall, start, ul, uu, vl, vu, sides, into, heights):  # type: ignore[no-untyped-def]
    """Write for each wall on which side of the ray it begins, cross(u, c − p), cross(u, e), and cross(c − p, e)."""
    if wall >= 0:
        bxl, bxu, byl, byu = corners[wall, 0], corners[wall, 1], corners[wall, 2], corners[wall, 3]
        own_l, own_u = cross(ul, uu, vl, vu, edges[wall, 0], edges[wall, 1], edges[wall, 2], edges[wall, 3])
        shift_l, shift_u = mul(start[0], start[1], own_l, own_u)
    else:
        bxl, bxu, byl, byu = start[2], start[3], start[4], start[5]
        shift_l = shift_u = 0.0
    for j in range(len(corners)):
        exl, exu, eyl, eyu = edges[j, 0], edges[j, 1], edges[j, 2], edges[j, 3]
        xl, xu = sub(corners[j, 0], corners[j, 1], bxl, bxu)
        yl, yu = sub(corners[j, 2], corners[j, 3], byl, byu)
        sl, su = cross(ul, uu, vl, vu, xl, xu, yl, yu)
        sides[j, 0], sides[j, 1] = sub(sl, su, shift_l, shift_u)
        into[j, 0], into[j, 1] = cross(ul, uu, vl, vu, exl, exu, eyl, eyu)
        hl, hu = cross(xl, xu, yl, yu, exl, exu, eyl, eyu)
        heights[j, 0], heights[j, 1] = hl, hu
        if wall >= 0 and j != wall:
            gl, gu = cross(edges[wall, 0], edges[wall, 1], edges[wall, 2], edges[wall, 3], exl, exu, eyl, eyu)
            gl, gu = mul(start[0], start[1], gl, gu)
            heights[j, 0], heights[j, 1] = sub(hl, hu, gl, gu)
    if wall >= 0:  # exact zeros, where the robot stands
        sides[wall, 0], sides[wall, 1] = -shift_u, -shift_l
        heights[wall, 0] = heights[wall, 1] = 0.0


@kernel
def free_way(links, wall, start, sides, into, heights, ways, most):  # type: ignore[no-untyped-def]
    """Return a distance that no ray of the bundle exceeds, `most` at most; write how far each wall's line is ahead."""
    before, after = -1, -1
    if wall >= 0:
        after, before = links[wall, 0], links[wall, 1]
        low_end = start[0] > 0.0 or links[wall, 2] == 0  # from a reflex corner, a robot may leave behind the wall
        high_end = start[1] < 1.0 or links[after, 2] == 0
        if into[wall, 0] > 0.0 and low_end and high_end:
            return 0.0
    for j in range(len(sides)):
        ways[j, 0], ways[j, 1] = -np.inf, np.inf
        if into[j, 0] > 0.0:
            ways[j, 0], ways[j, 1] = div(heights[j, 0], heights[j, 1], into[j, 0], into[j, 1])
    for j in range(len(sides)):
        if j == wall or not into[j, 0] > 0.0:
            continue
        # On the wall next to a convex corner, a ray begins on the inner side of the other wall; if it does not cross that, then its own.
        low = sides[j, 1] < 0.0 or (j == after and links[j, 2] == 0)
        k = links[j, 0]
        high = sides[k, 0] > 0.0 or (j == before and links[wall, 2] == 0)
        ahead = ways[j, 0] > 0.0 or ((j == after and links[j, 2] == 0) or (j == before and links[wall, 2] == 0))
        if low and high and ahead:
            most = min(most, ways[j, 1])
        elif low and ahead and into[k, 0] > 0.0 and k != wall and ways[k, 0] > 0.0 and sides[links[k, 0], 0] > 0.0:
            most = min(most, max(ways[j, 1], ways[k, 1]))  # one of two walls that follow each other
    return most


@kernel
def _narrow_end(corners, edges, start, j, ul, uu, vl, vu, sides, into, way, end):  # type: ignore[no-untyped-def]
    """Narrow the end of a bundle on wall j, and the start and the way that lead there, all in place; return whether any is left.

    `start` is a row of bounds; `end` takes the part of wall j and the heading: four bounds.
    """
    wall = int(start[8])
    cxl, cxu, cyl, cyu = corners[j, 0], corners[j, 1], corners[j, 2], corners[j, 3]
    exl, exu, eyl, eyu = edges[j, 0], edges[j, 1], edges[j, 2], edges[j, 3]
    xx_l, xx_u = sqr(exl, exu)
    yy_l, yy_u = sqr(eyl, eyu)
    square_l, square_u = add(xx_l, xx_u, yy_l, yy_u)
    tl, tu = 0.0, 1.0
    if into[j, 0] > 0.0:
        al, au = div(-sides[j, 1], -sides[j, 0], into[j, 0], into[j, 1])
        tl, tu = intersect(tl, tu, al, au)
    for _ in range(ROUNDS):
        pxl, pxu, pyl, pyu = place(corners, edges, start)
        dxl, dxu = sub(pxl, pxu, cxl, cxu)
        dyl, dyu = sub(pyl, pyu, cyl, cyu)
        # the height above the wall is way · cross(u, e)
        if wall >= 0:
            bxl, bxu = sub(cxl, cxu, corners[wall, 0], corners[wall, 1])
            byl, byu = sub(cyl, cyu, corners[wall, 2], corners[wall, 3])
            hl, hu = cross(bxl, bxu, byl, byu, exl, exu, eyl, eyu)
            gl, gu = cross(edges[wall, 0], edges[wall, 1], edges[wall, 2], edges[wall, 3], exl, exu, eyl, eyu)
            rl, ru = mul(way[0], way[1], into[j, 0], into[j, 1])
            rl, ru = sub(hl, hu, rl, ru)
            if gl > 0.0 or gu < 0.0:
                al, au = div(rl, ru, gl, gu)
                start[0], start[1] = intersect(start[0], start[1], al, au)
            gl, gu = mul(start[0], start[1], gl, gu)
            hl, hu = sub(hl, hu, gl, gu)
        else:
            hl, hu = cross(-dxu, -dxl, -dyu, -dyl, exl, exu, eyl, eyu)
        if into[j, 0] > 0.0:
            al, au = div(hl, hu, into[j, 0], into[j, 1])
            way[0], way[1] = intersect(way[0], way[1], al, au)
        else:
            rl, ru = mul(way[0], way[1], into[j, 0], into[j, 1])
            if rl > hu or ru < hl:
                return False
        if not (way[0] <= way[1] and start[0] <= start[1] and tl <= tu):
            return False
        # p + way·u = c + t·e
        qxl, qxu = mul(way[0], way[1], ul, uu)
        qyl, qyu = mul(way[0], way[1], vl, vu)
        qxl, qxu = add(dxl, dxu, qxl, qxu)
        qyl, qyu = add(dyl, dyu, qyl, qyu)
        al, au = mul(qxl, qxu, exl, exu)
        bl, bu = mul(qyl, qyu, eyl, eyu)
        al, au = add(al, au, bl, bu)
        al, au = div(al, au, square_l, square_u)
        tl, tu = intersect(tl, tu, al, au)
        if not tl <= tu:
            return False
        # the heading is the direction from the start to the end
        qxl, qxu = mul(tl, tu, exl, exu)
        qyl, qyu = mul(tl, tu, eyl, eyu)
        qxl, qxu = sub(qxl, qxu, dxl, dxu)
        qyl, qyu = sub(qyl, qyu, dyl, dyu)
        al, au = hypot(qxl, qxu, qyl, qyu)
        way[0], way[1] = intersect(way[0], way[1], al, au)
        al, au = direction(qyl, qyu, qxl, qxu)
        start[6], start[7] = intersect_angle(start[6], start[7], al, au)
        if not (way[0] <= way[1] and start[6] <= start[7]):
            return False
        ul, uu = cos(start[6], start[7])
        vl, vu = sin(start[6], start[7])
        into[j, 0], into[j, 1] = cross(ul, uu, vl, vu, exl, exu, eyl, eyu)
        if not into[j, 1] > 0.0:
            return False
    end[0], end[1], end[2], end[3] = tl, tu, start[6], start[7]
    return True


@kernel
def cast(corners, edges, links, start, least, most, sides, into, heights, ways, starts, ends):  # type: ignore[no-untyped-def]
    """Write where robots may come to that drive by more than nothing, from `least` to `most`; return how many rows were written.

    Parameters
    ----------
    start
        A row of bounds, its heading that of the drive.
    sides, into, heights, ways
        Room, float64 of shape (n, 2) each.
    starts, ends
        Room for n rows of bounds: of the start of each end, narrowed, and the end on its wall.
    """
    wall = int(start[8])
    ul, uu = cos(start[6], start[7])
    vl, vu = sin(start[6], start[7])
    read_sides(corners, edges, wall, start, ul, uu, vl, vu, sides, into, heights)
    most = free_way(links, wall, start, sides, into, heights, ways, most)
    if not (least <= most and most > 0.0):
        return 0
    count = 0
    way, end = np.empty(2), np.empty(4)
    for j in range(len(corners)):
        k = links[j, 0]
        if j == wall or not (into[j, 1] > 0.0 and sides[j, 0] <= 0.0 and sides[k, 1] >= 0.0):
            continue
        if ways[j, 0] > most or ways[j, 1] < least:
            continue
        starts[count] = start
        way[0], way[1] = least, most
        if _narrow_end(corners, edges, starts[count], j, ul, uu, vl, vu, sides, into, way, end):
            ends[count, 0], ends[count, 1], ends[count, 6], ends[count, 7], ends[count, 8] = end[0], end[1], end[2], end[3], j
            ends[count, 2], ends[count, 3], ends[count, 4], ends[count, 5] = place(corners, edges, ends[count])
            count += 1
    return count
