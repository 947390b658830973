import random
from fractions import Fraction

import numpy as np
import pytest
import shapely

from ial.maps.polygons.environment import Environment
from ial.maps.polygons.raster import Raster, cover
from ial.maps.polygons.wall_contact import WallContact
from ial.maps.polygons.walls import Walls
from tests.bouncing.truth import random_environment

Point = tuple[Fraction, Fraction]


def wall_lines(environment: Environment) -> list[tuple[Point, Point]]:
    """The walls in the order of `Walls`."""
    rings = [ring for polygon in environment.polygons for ring in polygon.rings]
    return [(ring[at], ring[(at + 1) % len(ring)]) for ring in rings for at in range(len(ring))]


def square_to(wall: tuple[Point, Point], x: Fraction, y: Fraction) -> Fraction:
    """The squared distance of a point from a wall, exactly."""
    (ax, ay), (bx, by) = wall
    ex, ey = bx - ax, by - ay
    part = min(max(((x - ax) * ex + (y - ay) * ey) / (ex * ex + ey * ey), Fraction(0)), Fraction(1))
    return (x - ax - part * ex) ** 2 + (y - ay - part * ey) ** 2


def touching_points(wall: tuple[Point, Point], radius: Fraction, chooser: random.Random) -> list[Point]:
    """Points at exactly the radius from an end of a wall, at angles with rational sines, and beside it if it leads along an axis."""
    points = []
    for x, y in wall * 6:
        a, b = chooser.randint(-9, 9), chooser.randint(1, 9)
        points.append((x + radius * Fraction(2 * a * b, a * a + b * b), y + radius * Fraction(a * a - b * b, a * a + b * b)))
    (ax, ay), (bx, by) = wall
    part = Fraction(chooser.randint(0, 12), 12)
    if ax == bx or ay == by:
        x, y = ax + part * (bx - ax), ay + part * (by - ay)
        points += [(x + side * (ax == bx), y + side * (ay == by)) for side in (-radius, radius)]
    return points


def cells_of(raster: Raster, x: Fraction, y: Fraction) -> list[int]:
    """The numbers of the closed cells that hold a point."""
    column, row = (x - raster.x) / raster.cell, (y - raster.y) / raster.cell
    rows, columns = raster.free.shape
    return [
        r * columns + c
        for r in {row.__floor__(), row.__ceil__() - 1}
        for c in {column.__floor__(), column.__ceil__() - 1}
        if 0 <= r < rows and 0 <= c < columns
    ]


@pytest.mark.many
@pytest.mark.parametrize("seed", range(24))
def test_a_disk_that_touches_a_wall_stands_in_one_of_its_cells(seed: int) -> None:
    chooser = random.Random(seed)
    environment = random_environment(seed)
    raster = cover(environment, chooser.choice([Fraction(1, 2), Fraction(1, 3), Fraction(7, 10)]))
    radius = chooser.choice([Fraction(0), Fraction(1, 4), Fraction(1, 3), Fraction(1)])
    contact, lines = WallContact.of(Walls.of(environment), raster, radius), wall_lines(environment)
    tried = 0
    for number, wall in enumerate(lines):
        touching = set(contact.touching[number].tolist())
        for x, y in touching_points(wall, radius, chooser):
            cells = cells_of(raster, x, y)
            if square_to(wall, x, y) == radius**2 and cells:
                assert touching.issuperset(cells)
                if min(square_to(other, x, y) for other in lines) == radius**2:
                    assert not contact.overlapping.flat[cells].any()
                tried += 1
    assert tried > len(lines)
    for row, column in np.argwhere(contact.overlapping).tolist():
        x, y = (low + (at + Fraction(chooser.randint(0, 8), 8)) * raster.cell for low, at in ((raster.x, column), (raster.y, row)))
        assert min(square_to(wall, x, y) for wall in lines) < radius**2


@pytest.mark.parametrize("seed", range(6))
def test_no_cell_is_kept_that_is_too_near_or_too_far(seed: int) -> None:
    environment, radius = random_environment(seed), Fraction(1, 3)
    raster = cover(environment, Fraction(1, 4))
    contact = WallContact.of(Walls.of(environment), raster, radius)
    rows, columns = raster.free.shape
    x0, y0 = float(raster.x), float(raster.y)
    boxes = np.array([shapely.box(x0 + c / 4, y0 + r / 4, x0 + (c + 1) / 4, y0 + (r + 1) / 4) for r in range(rows) for c in range(columns)])
    corners = np.array([[shapely.Point(corner) for corner in box.exterior.coords[:4]] for box in boxes])
    for number, wall in enumerate(wall_lines(environment)):
        line = shapely.LineString([tuple(map(float, end)) for end in wall])
        least, most = shapely.distance(boxes, line), shapely.distance(corners, line).max(axis=1)
        expected = np.flatnonzero((least <= 1 / 3 + 1e-9) & (most >= 1 / 3 - 1e-9))
        assert contact.touching[number].tolist() == expected.tolist()
        assert contact.overlapping.ravel()[most < 1 / 3 - 1e-9].all()
