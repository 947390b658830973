"""Where the centre of a disk can be in a contact, against distances from the walls themselves."""

import math
from fractions import Fraction
from random import Random

import numpy as np
import numpy.typing as npt
import pytest

from ial.errors import MapError
from ial.maps.polygons.contact_edge import BARRIER, NO_FACT, ContactEdge, contact_edges
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.polygon import Polygon
from ial.maps.polygons.walls import Walls
from tests.bouncing.rays.test_real_robot import ring
from tests.bouncing.truth import random_environment

HALF = Fraction(1, 2)


def distances(there: Environment, points: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """How far points are from the nearest wall, each wall sampled at no place but its nearest."""
    nearest = np.full(len(points), np.inf)
    for polygon in there.polygons:
        for corners in polygon.rings:
            for a, b in zip(np.array(corners, dtype=float), np.roll(np.array(corners, dtype=float), -1, axis=0), strict=True):
                part = np.clip((points - a) @ (b - a) / ((b - a) @ (b - a)), 0.0, 1.0)
                nearest = np.minimum(nearest, np.hypot(*(points - a - part[:, None] * (b - a)).T))
    return nearest


def places(edges: list[ContactEdge]) -> list[tuple[float, float]]:
    return [(float(edge.x), float(edge.y)) for edge in edges]


def test_the_edges_of_a_point_are_the_walls() -> None:
    corners = ring((0, 0), (4, 0), (4, 2), (3, 2), (2, 2), (2, 1), (0, 1))
    assert contact_edges(corners, Fraction(0)) == [
        ContactEdge(x, y, bend) for (x, y), bend in zip(corners, [1, 1, 1, 0, 1, -1, 1], strict=True)
    ]


def test_edges_are_cut_off_at_convex_corners_and_go_around_reflex_ones() -> None:
    edges = contact_edges(ring((0, 0), (9, 0), (9, 4), (5, 4), (5, 7), (0, 7)), HALF)
    assert [edge.bend for edge in edges] == [1, 1, 1] + 7 * [-1] + [1, 1]
    assert places(edges)[:4] == pytest.approx(np.array([(0.5, 0.5), (8.5, 0.5), (8.5, 3.5), (5.0, 3.5)]))
    assert places(edges)[9:] == pytest.approx(np.array([(4.5, 4.0), (4.5, 6.5), (0.5, 6.5)]))
    for x, y in places(edges)[3:10]:
        assert math.hypot(x - 5, y - 4) == pytest.approx(0.5, abs=1e-15)
    chords = [edge for edge in edges if edge.bulge_m]
    assert len(chords) == 6
    assert all(math.radians(7.5) < edge.tilt < math.radians(7.5) + 1e-9 for edge in chords)
    assert all(0.5 * (1 - math.cos(math.radians(7.5))) < edge.bulge_m < 0.0043 for edge in chords)


def test_walls_too_short_to_be_cut_off_keep_their_parallels() -> None:
    """A niche of half a metre: a disk of that radius touches its end from nowhere, and rings close around it all the same."""
    edges = contact_edges(
        ring((0, 0), (4, 0), (4, 2), (3, 2), (3, Fraction(5, 2)), (Fraction(5, 2), Fraction(5, 2)), (Fraction(5, 2), 2), (0, 2)), HALF
    )
    barriers = [at for at, edge in enumerate(edges) if edge.tilt == BARRIER]
    assert len(barriers) == 2
    assert [(edges[at].bend, edges[at + 1].bend) for at in barriers] == 2 * [(NO_FACT, NO_FACT)]
    assert places(edges)[barriers[0]] == pytest.approx((2.5, 2.5))
    assert places(edges)[barriers[0] + 1] == pytest.approx((3.0, 2.0))


@pytest.mark.parametrize("seed", range(60))
def test_no_edge_leaves_the_radius_of_the_walls(seed: int) -> None:
    """So the centre can cross none of them; and arcs are nowhere farther before their chords than is said."""
    there, radius = random_environment(seed), Fraction(Random(seed).randint(1, 900), 1000)
    for polygon in there.polygons:
        for corners in polygon.rings:
            edges = contact_edges(corners, radius)
            starts = np.array(places(edges))
            ends = np.roll(starts, -1, axis=0)
            for part in (0.0, 0.2, 0.5, 0.9):
                assert distances(there, starts + part * (ends - starts)).max() <= float(radius) + 1e-12
            for edge, a, b in zip(edges, starts, ends, strict=True):
                if edge.bulge_m:
                    half = 0.5 * math.dist(a, b)
                    assert float(radius) - math.sqrt(float(radius) ** 2 - half**2) <= edge.bulge_m
                    assert math.asin(half / float(radius)) <= edge.tilt


def test_walls_that_nearly_fold_back_are_not_cut_off() -> None:
    needle = Polygon(ring((0, 0), (4, 0), (0, Fraction(1, 10**7))))
    edges = contact_edges(needle.outer, Fraction(1, 10))
    assert any(edge.tilt == BARRIER for edge in edges)
    assert distances(Environment((needle,)), np.array(places(edges))).max() <= 0.1 + 1e-12


def test_a_corner_on_a_straight_wall_is_none_however_near_to_another() -> None:
    plain, told = (
        contact_edges(ring((0, 0), *between, (4, 0), (4, 3), (0, 3)), Fraction(1, 5)) for between in ((), ((Fraction(1, 10), 0),))
    )
    assert [edge.bend for edge in told].count(0) == 1
    assert {edge.bend for edge in plain} == {1}
    walls = Walls.of(Environment((Polygon(ring((0, 0), (Fraction(1, 10), 0), (4, 0), (4, 3), (0, 3))),)), Fraction(1, 5))
    assert walls.lengths.min() > 0.05


def test_radii_that_fit_nowhere_or_are_too_small_are_named() -> None:
    room = Environment((Polygon(ring((0, 0), (9, 0), (9, 4), (5, 4), (5, 7), (0, 7))),))
    for radius in (Fraction(4), Fraction(10**9), Fraction(10**300)):
        with pytest.raises(MapError, match="fits nowhere"):
            Walls.of(room, radius)
    with pytest.raises(MapError, match=r"radius 1e-13 m has .* to go around a corner"):
        Walls.of(room, Fraction(1, 10**13))
