"""`ContactWall`: where a driving disk touches one wall of the simulation, in whole numbers: lengths in units of 2^-112 m.

Touching counts where the heading leads into what is not free. Passing at a distance of exactly the radius is a graze, and no contact.
"""

import math
from dataclasses import dataclass
from fractions import Fraction

from ial.maps.polygons.direction import BITS, ONE

TINY = 1 << (BITS - 80)
"""Lengths that differ by no more are equal, and so are sines: far more than what is rounded off, far below what a filter could tell."""


@dataclass(frozen=True)
class ContactWall:
    """A wall from a corner to the next one of its ring, with free space on its left.

    Parameters
    ----------
    ax, ay, bx, by
        Where it starts and ends.
    before_x, before_y
        Where the wall before it starts, which ends where this one starts.
    """

    ax: int
    ay: int
    bx: int
    by: int
    before_x: int
    before_y: int

    def square_from(self, x: int, y: int) -> Fraction:
        """Return the squared distance of a point."""
        ex, ey, px, py = self.bx - self.ax, self.by - self.ay, x - self.ax, y - self.ay
        part = min(max(Fraction(px * ex + py * ey, ex * ex + ey * ey), Fraction(0)), Fraction(1))
        return (px - part * ex) ** 2 + (py - part * ey) ** 2

    def is_crossed_leftwards_of(self, x: int, y: int) -> bool:
        """Return whether the half line from a point along −x crosses the wall: an odd number of walls is crossed from inside."""
        ex, ey, px, py = self.bx - self.ax, self.by - self.ay, x - self.ax, y - self.ay
        return (self.ay > y) != (self.by > y) and (ex * py - px * ey > 0) == (self.by > self.ay)

    def way_to_side(self, x: int, y: int, dx: int, dy: int, radius: int) -> int | None:
        """Return how far a disk drives until it touches the wall between its ends; None if the wall is not in its way.

        Parameters
        ----------
        x, y
            Where the centre starts; the disk overlaps nothing there.
        dx, dy
            The direction, a vector of length 2^112.
        radius
            The radius of the disk; 0 for a point.
        """
        ex, ey = self.bx - self.ax, self.by - self.ay
        length = math.isqrt(ex * ex + ey * ey)
        into = (dx * ey - dy * ex) // length
        gap = ((self.ax - x) * ey - (self.ay - y) * ex) // length - radius
        if into <= TINY or gap < -TINY:
            return None
        way = max(gap, 0) * ONE // into
        foot = ((x - self.ax + (way * dx >> BITS)) * ex + (y - self.ay + (way * dy >> BITS)) * ey) // length
        beyond = TINY if radius else -TINY  # of a point, the corner itself decides
        return way if -beyond <= foot <= length + beyond else None

    def way_to_corner(self, x: int, y: int, dx: int, dy: int, radius: int) -> int | None:
        """Return how far a disk drives until it touches the corner where the wall starts; None if the corner is not in its way."""
        mx, my = self.ax - x, self.ay - y
        ahead, aside = (mx * dx + my * dy) >> BITS, abs(mx * dy - my * dx) >> BITS
        if radius:
            return max(ahead - math.isqrt(radius * radius - aside * aside), 0) if ahead > 0 and radius - aside > TINY else None
        return max(ahead, 0) if ahead >= -TINY and aside <= TINY and self._stops_at_corner(dx, dy) else None

    def _stops_at_corner(self, dx: int, dy: int) -> bool:
        """Return whether a point at the corner has no free space ahead."""
        ex, ey = self.bx - self.ax, self.by - self.ay
        cx, cy = self.ax - self.before_x, self.ay - self.before_y
        into, into_before = ((dx * vy - dy * vx) // math.isqrt(vx * vx + vy * vy) > TINY for vx, vy in ((ex, ey), (cx, cy)))
        reflex = cx * ey - cy * ex < 0
        return (into and into_before) if reflex else (into or into_before)
