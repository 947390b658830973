"""Shortest paths against all ways over corners, by sight that is computed in another way."""

import math
import random
from itertools import combinations, pairwise

import pytest

from ial.maps.polygons.exact.shooter import Shooter
from ial.maps.polygons.exact.shortest_path import ShortestPaths
from ial.maps.polygons.exact.visibility import Visibility
from ial.maps.polygons.polygon import ExactPoint, Polygon
from tests.maps.polygons.exact.test_shooter import starts
from tests.maps.polygons.exact.test_visibility import POLYGONS, sees
from tests.maps.polygons.known_polygons import HOLED, Z_SHAPE


def distance(one: ExactPoint, other: ExactPoint) -> float:
    return math.hypot(*(float(a - b) for a, b in zip(one, other, strict=True)))


def lengths(polygon: Polygon, places: list[ExactPoint]) -> dict[tuple[ExactPoint, ExactPoint], float]:
    """Relax over all corners (Floyd and Warshall)."""
    nodes = list(dict.fromkeys([*places, *(corner for ring in polygon.rings for corner in ring)]))
    between = {(one, one): 0.0 for one in nodes}
    for one, other in combinations(nodes, 2):
        between[one, other] = between[other, one] = distance(one, other) if sees(polygon, one, other) else math.inf
    for middle in nodes:
        for one in nodes:
            for other in nodes:
                between[one, other] = min(between[one, other], between[one, middle] + between[middle, other])
    return between


@pytest.mark.parametrize("polygon", POLYGONS)
def test_no_way_over_corners_is_shorter(polygon: Polygon) -> None:
    paths = ShortestPaths(Visibility(Shooter(polygon)))
    places = starts(polygon, random.Random(7), 6)
    shortest = lengths(polygon, places)
    turns = 0
    for one in places:
        for other in places:
            length, path = paths.route(one, other)
            assert length == paths.length(one, other) == pytest.approx(shortest[one, other])
            assert path == paths.path(one, other)
            assert (path[0], path[-1]) == (one, other)
            assert len(set(path)) == len(path)
            assert all(sees(polygon, *part) for part in pairwise(path))
            assert sum(distance(*part) for part in pairwise(path)) == pytest.approx(length)
            turns += len(path) > 2
    assert turns or len(paths.visibility.turns) < 2


def test_between_corners() -> None:
    paths = ShortestPaths(Visibility(Shooter(HOLED)))
    turns, corners = paths.visibility.turns, paths.visibility.shooter.corners
    for at, one in enumerate(turns):
        for to, other in enumerate(turns):
            assert paths.between[at, to] == pytest.approx(paths.length(corners[one], corners[other]))
            assert paths.hops[at, to] == len(paths.path(corners[one], corners[other])) - 1


def test_a_path_has_exact_corners_and_passes_both_ends_of_a_bitangent() -> None:
    paths = ShortestPaths(Visibility(Shooter(Z_SHAPE)))
    assert [str(x) for x, _ in paths.path((4, 0), (5, 9))] == ["4", "4", "5", "5"]
