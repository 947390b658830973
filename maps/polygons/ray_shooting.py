"""Shooting beams: every wall that a robot can bump into that starts somewhere on a piece of wall, in some heading of an interval.

A *beam* holds all rays from the points of a piece of a wall in the headings of an interval. Numbers are computed to nearest and widened:
lengths by `Walls.margin`, directions by the slant of their wall, angles, parts of walls and quotients by `margins.ROUNDINGS` of what they
are made of. Every length here is a sum of at most eight products of a coordinate and a sine or cosine, each rounded. Nothing that the true
robot can do is lost.

A corner is *certainly* on one side of a beam if it is on that side of every ray. Between a corner on the right and one on the left, every
ray crosses the chain of walls from one to the other, and none gets farther: that is how far a beam can reach.
"""

import numpy as np

from ial.contractors.intervals.trigonometric import sincos
from ial.contractors.kernels import kernel
from ial.contractors.margins import ABOVE, ROUNDINGS
from ial.maps.polygons.contact_edge import NO_FACT

_X, _Y, _DX, _DY, _LENGTH, _ANGLE, _SLANT, _BULGE, _TILT = range(9)
_AFTER, _BEFORE, _BEND = range(3)
_PI, _TWO_PI = np.pi, 2.0 * np.pi


@kernel
def _turned(low, high, cosine, sine):  # type: ignore[no-untyped-def]
    """Return bounds of cos α·a for a in an interval, and of |sin α|·b added by the caller: the part that shrinks."""
    return min(low, cosine * low) - sine, max(high, cosine * high) + sine


@kernel
def sort_out(wall, low, high, table):  # type: ignore[no-untyped-def]
    """Split an interval of headings at a wall: (free from, to, against the wall from, to); empty ones have from > to.

    Both hold the headings along the wall, which a robot may follow or not; where the wall is a chord, those along all of its arc.
    """
    slant = table[wall, _SLANT]
    shift = table[wall, _ANGLE] + _TWO_PI * np.floor((0.5 * (low + high) - table[wall, _ANGLE] + 0.5 * _PI) / _TWO_PI)
    pad = slant + table[wall, _TILT] + ROUNDINGS * (8.0 + abs(low) + abs(high))
    free_low, free_high = max(low, shift - pad), min(high, shift + _PI + pad)
    middle = 0.5 * (low + high) - shift  # from −π/2 to 3π/2
    against_low = low if middle <= 0.5 * _PI else max(low, shift + _PI - pad)
    against_high = min(high, shift + pad) if middle <= 0.5 * _PI else high
    return free_low, free_high, against_low, against_high


@kernel
def _measure(wall, first, last, low, high, table, links, margin, sides, fronts, spans, cuts):  # type: ignore[no-untyped-def]
    """Fill in where corners and walls lie with respect to a beam from a piece of a wall.

    Parameters
    ----------
    wall, first, last, low, high
        The piece, as parts of the wall, and the headings, which must not lead into the wall and differ by less than a quarter turn.
    sides, fronts
        For each corner, how far it lies to the left of the rays and in front of their starts: (lower, upper).
    spans
        For each wall, how far from the start rays cross it: (lower, upper); lower > upper if none does.
    cuts
        For each wall, the sine of the angle at which rays cross it, positive if they lead out of the free space: (lower, upper).
    """
    mid = 0.5 * (low + high)
    width = max(high - mid, mid - low) + ROUNDINGS * (1.0 + abs(mid))
    s, c = sincos(mid)
    cosine, sine = max(1.0 - 0.5 * width * width - ROUNDINGS, 0.0), min(width, 1.0)
    x0, y0 = table[wall, _X] + first * table[wall, _DX], table[wall, _Y] + first * table[wall, _DY]
    x1, y1 = table[wall, _X] + last * table[wall, _DX], table[wall, _Y] + last * table[wall, _DY]
    own = margin + table[wall, _BULGE]  # of where a ray starts
    for i in range(len(table)):
        dx0, dy0, dx1, dy1 = table[i, _X] - x0, table[i, _Y] - y0, table[i, _X] - x1, table[i, _Y] - y1
        l0, f0, l1, f1 = c * dy0 - s * dx0, c * dx0 + s * dy0, c * dy1 - s * dx1, c * dx1 + s * dy1
        a, b = _turned(l0, l0, cosine, sine * abs(f0))
        d, e = _turned(l1, l1, cosine, sine * abs(f1))
        sides[i, 0], sides[i, 1] = min(a, d) - own, max(b, e) + own
        a, b = _turned(f0, f0, cosine, sine * abs(l0))
        d, e = _turned(f1, f1, cosine, sine * abs(l1))
        fronts[i, 0], fronts[i, 1] = min(a, d) - own, max(b, e) + own
    after, own_x, own_y = links[wall, _AFTER], table[wall, _DX] / table[wall, _LENGTH], table[wall, _DY] / table[wall, _LENGTH]
    rise, run = own_x * s - own_y * c, own_x * c + own_y * s
    least_rise, slant = min(rise, cosine * rise) - sine * abs(run), table[wall, _SLANT]
    least_run, most_run = _turned(run, run, cosine, sine * abs(rise))
    leaving, forward, backward = least_rise > slant, least_run > slant, most_run < -slant  # certainly; leaving is not along the wall
    # Headings do not lead into the wall itself, so its start is never to the right and its end never to the left. From an arc that holds
    # only of headings that are not near the direction of the chord that leads there: from a tangent, by at most two tilts.
    bent = 2.0 * table[wall, _TILT] + slant
    if bent == slant or least_rise > bent or backward:
        sides[wall, 0] = max(sides[wall, 0], 0.0)
    if bent == slant or least_rise > bent or forward:
        sides[after, 1] = min(sides[after, 1], 0.0)
    for j in range(len(table)):
        spans[j, 0], spans[j, 1] = np.inf, -np.inf
        k, bulge = links[j, _AFTER], table[j, _BULGE]
        if j == wall or (sides[j, 0] > bulge and sides[k, 0] > bulge) or (sides[j, 1] < -bulge and sides[k, 1] < -bulge):
            continue
        length, slant = table[j, _LENGTH], table[j, _SLANT]
        ex, ey = table[j, _DX] / length, table[j, _DY] / length
        cut, along = c * ey - s * ex, c * ex + s * ey
        cut_low, cut_high = _turned(cut, cut, cosine, sine * abs(along))
        cut_low, cut_high = cut_low - slant, cut_high + slant
        cuts[j, 0], cuts[j, 1] = cut_low, cut_high
        near, far = min(fronts[j, 0], fronts[k, 0]), max(fronts[j, 1], fronts[k, 1])
        if cut_low > 0.0:
            # The distance is a quotient of the height over the wall, which depends on the start alone, and the sine of the angle.
            h0 = (table[j, _X] - x0) * ey - (table[j, _Y] - y0) * ex
            h1 = (table[j, _X] - x1) * ey - (table[j, _Y] - y1) * ex
            slack = own + slant * (abs(table[j, _X] - x0) + abs(table[j, _Y] - y0) + abs(table[j, _X] - x1) + abs(table[j, _Y] - y1))
            h_low, h_high = min(h0, h1) - slack, max(h0, h1) + slack
            bend = links[j, _BEND] if j == after else links[k, _BEND] if k == wall else NO_FACT
            if bend == 1:
                h_low, h_high = max(h_low, 0.0), max(h_high, 0.0)
            elif bend != NO_FACT:
                h_low, h_high = min(h_low, 0.0), min(h_high, 0.0)
            low_quotient = h_low / cut_high if h_low >= 0.0 else h_low / cut_low
            high_quotient = h_high / cut_low if h_high >= 0.0 else h_high / cut_high
            near = max(near, low_quotient - ROUNDINGS * abs(low_quotient))
            far = min(far, high_quotient + ROUNDINGS * abs(high_quotient))
        # A wall behind a convex corner of the wall itself lies on its free side, so rays cross it in front of their start.
        if (j == after and links[j, _BEND] == 1 and (leaving or forward)) or (k == wall and links[k, _BEND] == 1 and (leaving or backward)):
            near = max(near, 0.0)
        spans[j, 0], spans[j, 1] = near, far


@kernel
def _reach(wall, links, sides, spans):  # type: ignore[no-untyped-def]
    """Return how far a beam can get at most, from what `_measure` found: infinity if no chain of walls certainly stops it."""
    reach = np.inf
    count = len(links)
    start = 0
    while start < count:
        stop = start + 1  # the ring: corners start … stop − 1
        while stop < count and links[stop, _BEFORE] == stop - 1:
            stop += 1
        chained, bound = False, -np.inf
        for step in range(2 * (stop - start)):
            i = start + step % (stop - start)
            j = links[i, _BEFORE]
            if chained:
                if j == wall or (spans[j, 0] <= spans[j, 1] and spans[j, 0] < 0.0):
                    chained = False  # rays may cross it behind their start
                elif spans[j, 0] <= spans[j, 1]:
                    bound = max(bound, spans[j, 1])
            if sides[i, 0] >= 0.0:
                if chained and bound >= 0.0:
                    reach = min(reach, bound)
                chained = False
            if sides[i, 1] <= 0.0:
                chained, bound = True, -np.inf
        start = stop
    return reach


@kernel
def reaches(walls, lower, upper, back, table, links, margin):  # type: ignore[no-untyped-def]
    """Return how far a robot can get from each piece of wall, float64 of shape (pieces,); −1 if its headings all lead into the wall.

    Where `back` is true, the headings are those of arrivals at the piece, and the distance is how far back the robot can have come from.
    """
    count, corners = len(walls), len(table)
    reach = np.empty(count)
    sides, fronts, spans, cuts = np.empty((corners, 2)), np.empty((corners, 2)), np.empty((corners, 2)), np.empty((corners, 2))
    for row in range(count):
        shift = _PI if back[row] else 0.0  # a rounding or two more, which `sort_out` and `_measure` have room for
        low, high, against_low, against_high = sort_out(walls[row], lower[row, 1] + shift, upper[row, 1] + shift, table)
        reach[row] = -1.0 if back[row] or against_low > against_high else 0.0
        if low <= high:
            _measure(walls[row], lower[row, 0], upper[row, 0], low, high, table, links, margin, sides, fronts, spans, cuts)
            reach[row] = max(_reach(walls[row], links, sides, spans), 0.0)
    return reach


@kernel
def _hit_part(x, y, angle, j, table, margin):  # type: ignore[no-untyped-def]
    """Return where a ray crosses the line of a wall, as bounds of the part of the wall; everything if it is nearly parallel."""
    s, c = sincos(angle)
    across = c * table[j, _DY] - s * table[j, _DX]
    if across <= 4.0 * margin:
        return -np.inf, np.inf
    part = -(c * (table[j, _Y] - y) - s * (table[j, _X] - x)) / across
    error = ABOVE * margin * (1.0 + abs(part)) / (across - margin) + ROUNDINGS * abs(part)
    return part - error, part + error


@kernel
def shoot(begin, walls, lower, upper, nearest, farthest, table, links, margin, out_rows, out_walls, out_lower, out_upper):  # type: ignore[no-untyped-def]
    """Write where robots bump that start from pieces of walls, from piece `begin` on; return (pieces done, pieces written).

    A robot drives at least `nearest` and at most `farthest`. Stops when the room left may not hold the hits of the next piece. What is
    written is the number of the piece, the wall, and bounds of the part of it and of the heading *before* the robot turns.
    """
    corners = len(table)
    sides, fronts, spans, cuts = np.empty((corners, 2)), np.empty((corners, 2)), np.empty((corners, 2)), np.empty((corners, 2))
    count = 0
    for row in range(begin, len(walls)):
        if count + corners + 1 > len(out_rows):
            return row, count
        wall, first, last = walls[row], lower[row, 0], upper[row, 0]
        low, high, against_low, against_high = sort_out(wall, lower[row, 1], upper[row, 1], table)
        if against_low <= against_high and nearest[row] <= 0.0:
            out_rows[count], out_walls[count] = row, wall
            out_lower[count, 0], out_upper[count, 0] = first, last
            out_lower[count, 1], out_upper[count, 1] = against_low, against_high
            count += 1
        if low > high:
            continue
        _measure(wall, first, last, low, high, table, links, margin, sides, fronts, spans, cuts)
        reach = min(_reach(wall, links, sides, spans), farthest[row])
        x0, y0 = table[wall, _X] + first * table[wall, _DX], table[wall, _Y] + first * table[wall, _DY]
        x1, y1 = table[wall, _X] + last * table[wall, _DX], table[wall, _Y] + last * table[wall, _DY]
        own = margin + table[wall, _BULGE]
        for j in range(corners):
            if spans[j, 0] == np.inf:
                continue  # nothing was measured of it
            # An arc is met before its chord: on the way by more than it bulges, if at an angle.
            length, slant, bulge = table[j, _LENGTH], table[j, _SLANT], table[j, _BULGE]
            early = bulge / min(cuts[j, 0], 1.0) if cuts[j, 0] > 0.0 else bulge
            near, far = max(max(spans[j, 0] - ABOVE * early, 0.0), nearest[row]), min(spans[j, 1] + bulge, reach)
            if near > far or cuts[j, 1] < -table[j, _TILT]:
                continue
            part_low, part_high = 0.0, 1.0
            if cuts[j, 0] > bulge / length:
                # For one start the part is monotone in the heading, for one heading it is linear in the start: corners bound it.
                a, b = _hit_part(x0, y0, low, j, table, own)
                d, e = _hit_part(x0, y0, high, j, table, own)
                part_low, part_high = min(a, d), max(b, e)
                a, b = _hit_part(x1, y1, low, j, table, own)
                d, e = _hit_part(x1, y1, high, j, table, own)
                beside = ABOVE * early / length
                part_low, part_high = max(0.0, min(part_low, min(a, d)) - beside), min(1.0, max(part_high, max(b, e)) + beside)
            # Along the wall, the robot moves by the distance times the cosine of the angle.
            ex, ey = table[j, _DX] / length, table[j, _DY] / length
            p0 = (x0 - table[j, _X]) * ex + (y0 - table[j, _Y]) * ey
            p1 = (x1 - table[j, _X]) * ex + (y1 - table[j, _Y]) * ey
            mid = 0.5 * (low + high)
            width = max(high - mid, mid - low) + ROUNDINGS * (1.0 + abs(mid))
            s, c = sincos(mid)
            cosine, sine = max(1.0 - 0.5 * width * width - ROUNDINGS, 0.0), min(width, 1.0)
            along, cut = c * ex + s * ey, c * ey - s * ex
            along_low, along_high = _turned(along, along, cosine, sine * abs(cut))
            along_low, along_high = along_low - slant, along_high + slant
            slack = own + slant * (abs(table[j, _X] - x0) + abs(table[j, _Y] - y0) + abs(table[j, _X] - x1) + abs(table[j, _Y] - y1) + far)
            moved_low = min(near * along_low, far * along_low) - slack
            moved_high = max(near * along_high, far * along_high) + slack
            part_low = max(part_low, (min(p0, p1) + moved_low) / length - ROUNDINGS)
            part_high = min(part_high, (max(p0, p1) + moved_high) / length + ROUNDINGS)
            if part_low <= part_high:
                out_rows[count], out_walls[count] = row, j
                out_lower[count, 0], out_upper[count, 0] = part_low, part_high
                out_lower[count, 1], out_upper[count, 1] = low, high
                count += 1
    return len(walls), count
