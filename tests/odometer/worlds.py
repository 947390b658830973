"""Environments and starts for robots with odometers."""

import math
import random
from fractions import Fraction

from ial.errors import ConfigError
from ial.maps.polygons.polygon import Polygon
from ial.odometer import OdometerBounds, OdometerRobot
from tests.maps.polygons.random_polygons import random_polygon, rectilinear_polygon


def ring(*corners: tuple[float | str, float | str]) -> tuple[tuple[Fraction, Fraction], ...]:
    return tuple((Fraction(str(x)), Fraction(str(y))) for x, y in corners)


def regular(count: int) -> Polygon:
    """A regular polygon, but for the rounding of its corners to doubles."""
    angles = [2.0 * math.pi * at / count for at in range(count)]
    return Polygon(tuple((Fraction(math.cos(each)), Fraction(math.sin(each))) for each in angles))


def comb(teeth: int) -> Polygon:
    """A corridor with equal branches."""
    corners = [(0, 0), (2 * teeth, 0)]
    for tooth in reversed(range(teeth)):
        corners += [(2 * tooth + 2, 3), (2 * tooth + 1, 3), (2 * tooth + 1, 1), (2 * tooth, 1)]
    return Polygon(ring(*corners[:-1], (0, 1)))


CARDAN = Polygon(ring((-1.8, -1.8), (-0.2, -0.2), (0, -0.1), (0, 2), (-1.6, 2.2), (-2, 0), (-4, 0), (-4.2, -2)))
"""The first wall of a robot at (−3, 0) and its third one, along the axes, meet where the line of the second one passes: (0, 0)."""

L_SHAPE = Polygon(ring((0, 0), (5, 0), (5, 2), (2, 2), (2, 4), (0, 4)))
SQUARE = Polygon(ring((0, 0), (3, 0), (3, 3), (0, 3)))
S_SHAPE = Polygon(ring((0, 0), (4, 0), (4, 3), (6, 3), (6, 5), (2, 5), (2, 2), (0, 2)))
"""Half a turn lays it upon itself."""
HALL = Polygon(
    ring((0, 0), (9, 0), (9, 6), (0, 6)),
    (ring((2, 2), (2, 4), (4, 4), (4, 2)), ring((6, 1), (5.5, 3), (7, 3.5))),
)
SERPENTINE = Polygon(
    ring((0, 0), (8, 0), (8, 3), (1, 3), (1, 4), (8, 4), (8, 7), (0, 7), (0, 6), (7, 6), (7, 5), (0, 5), (0, 2), (7, 2), (7, 1), (0, 1))
)
WORLDS = {
    "cardan": CARDAN,
    "comb": comb(4),
    "hall": HALL,
    "L": L_SHAPE,
    "pentagon": regular(5),
    "S": S_SHAPE,
    "serpentine": SERPENTINE,
    "square": SQUARE,
    "random 8": random_polygon(corners=8, seed=1),
    "random 14": random_polygon(corners=14, seed=2),
    "columns": rectilinear_polygon(6, seed=3),
}


def robot(polygon: Polygon, seed: int, bounds: OdometerBounds | None = None) -> OdometerRobot:
    """A robot at a random start: free, at a corner or on a wall, with any heading, along an axis or a wall, or towards a corner."""
    chooser = random.Random(seed)
    corners = [(x, y) for each in polygon.rings for x, y in each]
    low_x, low_y, high_x, high_y = polygon.bounds
    while True:
        x, y = (Fraction(chooser.randrange(1001), 1000) * (high - low) + low for low, high in ((low_x, high_x), (low_y, high_y)))
        kind = chooser.randrange(6)
        if kind == 0:
            x, y = chooser.choice(corners)
        if kind == 1:
            at = chooser.randrange(len(polygon.outer))
            (ax, ay), (bx, by) = polygon.outer[at - 1], polygon.outer[at]
            part = Fraction(chooser.randrange(33), 32)
            x, y = ax + part * (bx - ax), ay + part * (by - ay)
        heading: Fraction | float = chooser.choice([Fraction(15 * chooser.randrange(24)), 360.0 * chooser.random()])
        if kind == 2:
            cx, cy = chooser.choice(corners)
            heading = math.degrees(math.atan2(cy - y, cx - x))
        try:
            return OdometerRobot(polygon, x, y, heading, bounds, seed)
        except ConfigError:
            continue
