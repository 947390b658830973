"""`WallTable`: the walls of a polygon as intervals of doubles, for kernels that round outward."""

import math
from fractions import Fraction

import numpy as np
import numpy.typing as npt

from ial.contractors.intervals.angle import direction
from ial.contractors.intervals.trigonometric import PI_UPPER
from ial.maps.polygons.polygon import Polygon

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]


def enclosed(number: Fraction) -> tuple[float, float]:
    """Return the nearest doubles below and above a number; twice the same, if it is a double."""
    nearest = number.numerator / number.denominator  # rounded once, unlike the quotient of two doubles
    exact = Fraction(nearest)
    return (nearest if exact <= number else math.nextafter(nearest, -math.inf)), (
        nearest if exact >= number else math.nextafter(nearest, math.inf)
    )


class WallTable:
    """The walls of a polygon, numbered as by `ial.maps.polygons.exact.shooter.Shooter`; the free space is on the left of each.

    Parameters
    ----------
    polygon
        The free space.

    Attributes
    ----------
    origin
        Where the frame of the table is in that of the polygon, x and y in metres: two doubles near the middle.
    corners
        Bounds of the corner at which each wall begins, (least x, greatest x, least y, greatest y), float64 of shape (n, 4).
    edges
        The same of the vector from there to the end.
    facing
        Bounds of the headings that lead into the wall, in radians: half a turn, float64 of shape (n, 2).
    links
        For each wall the next one, the one before, and whether its first corner is reflex, int64 of shape (n, 3).
    lengths
        About the length of each wall in metres.
    size
        About the larger side of the polygon's bounding box, in metres.
    """

    def __init__(self, polygon: Polygon) -> None:
        self.polygon = polygon
        low_x, low_y, high_x, high_y = polygon.bounds
        self.origin = float((low_x + high_x) / 2), float((low_y + high_y) / 2)
        self.size = float(max(high_x - low_x, high_y - low_y))
        ox, oy = Fraction(self.origin[0]), Fraction(self.origin[1])
        corners: list[tuple[float, ...]] = []
        edges: list[tuple[float, ...]] = []
        links: list[tuple[int, int, int]] = []
        facing: list[tuple[float, float]] = []
        for ring in polygon.rings:
            first, count = len(corners), len(ring)
            for at, (x, y) in enumerate(ring):
                (bx, by), (ax, ay) = ring[(at + 1) % count], ring[at - 1]
                ex, ey = bx - x, by - y
                corners.append((*enclosed(x - ox), *enclosed(y - oy)))
                edges.append((*enclosed(ex), *enclosed(ey)))
                reflex = (x - ax) * ey - (y - ay) * ex < 0
                links.append((first + (at + 1) % count, first + (at - 1) % count, int(reflex)))
                xl, xu, yl, yu = edges[-1]
                lower, upper = direction(yl, yu, xl, xu)
                facing.append((math.nextafter(lower - PI_UPPER, -math.inf), upper))
        self.corners: FloatArray = np.array(corners)
        self.edges: FloatArray = np.array(edges)
        self.links: IntArray = np.array(links, dtype=np.int64)
        self.facing: FloatArray = np.array(facing)
        self.lengths: FloatArray = np.hypot(self.edges[:, 0], self.edges[:, 2])

    def __repr__(self) -> str:
        return f"<WallTable of {len(self)} walls>"

    def __len__(self) -> int:
        return len(self.corners)
