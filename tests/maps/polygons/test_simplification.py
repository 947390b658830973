"""Fewer walls: what is left, by how much it moved, and what was left out."""

from fractions import Fraction
from typing import Any

import numpy as np
import pytest
import shapely

from ial.errors import ConfigError, MapError
from ial.maps.polygons import simplification
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.outline import outlines
from ial.maps.polygons.polygon import ExactRing, Polygon
from ial.maps.polygons.simplification import simplified
from ial.maps.polygons.wkt import parse_wkt

TENTH = Fraction(1, 10)


def cave(seed: int, rows: int = 40, columns: int = 50) -> np.ndarray:
    """Return free cells with slanted walls, round pillars and specks."""
    rng = np.random.default_rng(seed)
    y, x = np.mgrid[:rows, :columns]
    free = (x + y > 15) & (2 * x - y < 75) & (x > 1) & (y > 1) & (x < columns - 2) & (y < rows - 2)
    for _ in range(4):
        cx, cy, r = rng.uniform(10, 40), rng.uniform(10, 30), rng.uniform(1, 4)
        free &= (x - cx) ** 2 + (y - cy) ** 2 > r * r
    return free ^ (rng.random(free.shape) < 0.01)


def shape(polygon: Polygon) -> shapely.Polygon:
    rings = [[(float(x), float(y)) for x, y in ring] for ring in polygon.rings]
    return shapely.Polygon(rings[0], rings[1:])


def test_a_stair_becomes_a_slope() -> None:
    free = np.tri(30, dtype=bool)
    environment = Environment(outlines(free, TENTH), TENTH)
    made = simplified(environment, Fraction(1, 5))
    assert made.walls == (62, 3)
    assert made.environment.cell == TENTH
    # A stair of cells of 0.1 m has corners 0.1/√2 m away from a line through its other ones.
    assert Fraction(7, 100) < made.moved_m < Fraction(1, 5)
    assert (made.parts, made.holes, made.parts_m2, made.holes_m2) == (0, 0, 0, 0)


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("tolerance", ["1/10", "0.15", "0.31", "1"])
def test_outlines_move_no_further_than_is_said_and_corners_stay_corners(seed: int, tolerance: str) -> None:
    environment = Environment(outlines(cave(seed), TENTH, (Fraction(-1, 3), Fraction(1, 7))), TENTH)
    made = simplified(environment, Fraction(tolerance))
    corners = {point for polygon in environment.polygons for ring in polygon.rings for point in ring}
    left = [point for polygon in made.environment.polygons for ring in polygon.rings for point in ring]
    assert set(left) <= corners
    assert made.walls == (sum(len(r) for p in environment.polygons for r in p.rings), len(left))
    assert made.walls[1] < made.walls[0]
    assert 0 <= made.moved_m <= Fraction(tolerance)
    furthest = 0.0
    for polygon in made.environment.polygons:
        assert Polygon(polygon.outer, polygon.holes) == polygon  # in order, by exact comparisons
        for ring in polygon.rings:
            # The old ring, by a corner that both have; both densified, and compared by shapely.
            old = next(r for p in environment.polygons for r in p.rings if set(ring) <= set(r))
            lines = [shapely.LinearRing([(float(x), float(y)) for x, y in each]) for each in (old, ring)]
            furthest = max(furthest, shapely.hausdorff_distance(*lines, densify=0.05))
    assert furthest <= float(made.moved_m) + 1e-9
    assert furthest >= 0.5 * float(made.moved_m)  # it is no idle bound


@pytest.mark.parametrize("seed", range(4))
def test_what_was_left_out_and_what_is_left_make_the_whole(seed: int) -> None:
    environment = Environment(outlines(cave(seed), TENTH), TENTH)
    # So small a tolerance takes away the corners in straight lines only, of which outlines have none.
    made = simplified(environment, TENTH / 100)
    assert made.environment.polygons == environment.polygons
    assert made.moved_m == 0
    made = simplified(environment, TENTH)
    rings = sum(len(polygon.rings) for polygon in environment.polygons)
    assert len(made.environment.polygons) + made.parts == len(environment.polygons)
    assert sum(len(polygon.rings) for polygon in made.environment.polygons) + made.parts + made.holes <= rings
    assert made.holes + made.parts > 0
    single = [p for p in environment.polygons if min(p.bounds[2] - p.bounds[0], p.bounds[3] - p.bounds[1]) <= TENTH]
    assert (made.parts, made.parts_m2) == (len(single), sum(p.area for p in single))


def test_a_long_thin_wall_stays_and_a_speck_goes() -> None:
    environment = Environment(
        parse_wkt("POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (1 1, 1 8, 1.1 8, 1.1 1, 1 1), (5 5, 5 5.1, 5.1 5.1, 5.1 5, 5 5))")
        + parse_wkt("POLYGON ((10 0, 10.1 0, 10.1 9, 10 9, 10 0))")
        + parse_wkt("POLYGON ((12 0, 12.5 0, 12.5 9, 12 9, 12 0))")
    )
    made = simplified(environment, Fraction("0.1"))
    assert [len(polygon.holes) for polygon in made.environment.polygons] == [1, 0]
    assert (made.parts, made.parts_m2, made.holes, made.holes_m2) == (1, Fraction(9, 10), 1, Fraction(1, 100))
    assert made.walls == (20, 11)  # of the thin wall a wedge is left, whose sides have moved by no more than the tolerance
    assert simplified(environment, Fraction("0.1"), Fraction("0.5")).parts == 1  # it just fits
    assert simplified(environment, Fraction("0.1"), Fraction("0.51")).parts == 2


def test_coordinates_that_no_double_holds_stay_as_they_are() -> None:
    third = Fraction(1, 3)
    ring = ((Fraction(0), Fraction(0)), (third, Fraction(1, 10**6)), (4 * third, Fraction(0)), (4 * third, third), (Fraction(0), third))
    made = simplified(Environment((Polygon(ring),)), Fraction(1, 1000))
    assert made.environment.polygons == (Polygon((ring[0], *ring[2:])),)
    assert made.moved_m == Fraction(1, 10**6)


def test_what_cannot_be_simplified_is_refused() -> None:
    square = Environment(parse_wkt("POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0))"))
    with pytest.raises(ConfigError, match="tolerance of a simplification is 0 m"):
        simplified(square, Fraction(0))
    with pytest.raises(MapError, match=r"narrower than 1 m, so a simplification by 1 m leaves nothing; use a smaller tolerance"):
        simplified(square, Fraction(1))
    fine = Environment(parse_wkt("POLYGON ((0 0, 1 0, 1 1, 1e-20 1, 0 0))"))
    with pytest.raises(MapError, match="doubles do not hold together"):
        simplified(fine, Fraction(1, 10))


OUTER, HOLE = [(0, 0), (90, 0), (90, 90), (45, 100), (0, 90)], [(45, 98), (60, 60), (30, 60)]
BAY, WEDGE = [(0, 0), (90, 0), (90, 90), (45, 80), (0, 90)], [(45, 82), (60, 100), (30, 100)]


@pytest.mark.parametrize(
    ("parts", "result", "message"),
    [
        ([(OUTER, [HOLE])], [(OUTER[:3] + OUTER[4:], [HOLE])], "simplified by 10 m: .*cross.*; or use another tolerance"),
        ([(BAY, []), (WEDGE, [])], [(BAY[:3] + BAY[4:], []), (WEDGE, [])], "simplified by 10 m, parts of the free space overlap"),
        ([(OUTER, [HOLE])], [(OUTER, [])], "simplified by 10 m, a part of the free space or a hole vanishes; use another tolerance"),
    ],
)
def test_a_result_that_is_no_environment_is_refused(
    parts: list[Any], result: list[Any], message: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def exact(ring: list[tuple[int, int]]) -> ExactRing:
        return tuple((Fraction(x), Fraction(y)) for x, y in ring)

    environment = Environment(tuple(Polygon(exact(outer), tuple(map(exact, holes))) for outer, holes in parts))
    assert simplified(environment, Fraction(10)).walls[1] >= 3  # GEOS itself makes no such fault
    monkeypatch.setattr(shapely, "simplify", lambda *_, **__: shapely.MultiPolygon(result))
    with pytest.raises(MapError, match=message):
        simplified(environment, Fraction(10))


def test_a_ring_that_was_turned_round_is_compared_all_the_same() -> None:
    ring = [(0, 0), (5, 1), (10, 0), (10, 10), (4, 12), (0, 10)]
    left = [(0, 0), (10, 0), (10, 10), (0, 10)]
    for limit, corners, squared in ((4, [0, 2, 3, 5], 4), (3, [0, 2, 3, 4, 5], 1), (Fraction(1, 2), [0, 1, 2, 3, 4, 5], 0)):
        for order in (left, left[::-1], left[2:] + left[:2]):
            assert simplification._within(ring, order, Fraction(limit)) == (corners, squared)


def test_a_corner_beyond_the_ends_of_an_edge_is_as_far_off_as_the_nearer_end() -> None:
    for corner, squared in (((14, 1), 17), ((-3, 2), 13), ((10, 5), 25), ((5, 5), 25)):
        ring = [(0, 0), corner, (10, 0), (10, -10), (0, -10)]
        assert simplification._within(ring, [*ring[:1], *ring[2:]], Fraction(squared)) == ([0, 2, 3, 4], squared)
        assert simplification._within(ring, [*ring[:1], *ring[2:]], Fraction(squared - 1)) == ([0, 1, 2, 3, 4], 0)
