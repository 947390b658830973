from itertools import combinations, permutations

import numpy as np
import pytest

from ial.compass.wall_distances import WallDistances
from ial.maps.polygons.exact.rational import rational
from ial.maps.polygons.exact.shooter import Shooter
from ial.maps.polygons.exact.shortest_path import ShortestPaths
from ial.maps.polygons.exact.visibility import Visibility
from ial.maps.polygons.polygon import Polygon
from tests.maps.polygons.known_polygons import HOLED, SQUARE, serpentine
from tests.maps.polygons.random_polygons import random_polygon


@pytest.mark.parametrize("polygon", [SQUARE, HOLED, serpentine(3), random_polygon(20, 1)])
def test_walls_are_as_far_apart_as_the_paths_between_their_middles_have_parts(polygon: Polygon) -> None:
    shooter = Shooter(polygon)
    paths = ShortestPaths(Visibility(shooter))
    distances = WallDistances(paths)
    middles = [shooter.on_edge(edge, rational(1) / 2).place for edge in range(len(shooter))]
    same = [
        distances.table[one, other] == len(paths.path(middles[one], middles[other])) - 1
        for one, other in combinations(range(len(shooter)), 2)
    ]
    assert np.mean(same) > 0.97  # where two paths are as long as each other, either may be taken
    assert (distances.table == distances.table.T).all()
    assert (np.diag(distances.table) == 0).all()


def test_a_span_is_the_least_tree() -> None:
    table = WallDistances(ShortestPaths(Visibility(Shooter(serpentine(3)))))
    rows = np.array([[0, 3, 5, 9], [2, 2, 7, 7], [1, 4, 6, 8]])
    for walls, span in zip(rows, table.spans(rows), strict=True):
        between = table.table[np.ix_(walls, walls)]
        trees = [
            sum(min(between[new, old] for old in order[:at]) for at, new in enumerate(order) if at) for order in permutations(range(4))
        ]
        assert span == min(trees)
    assert table.spans(np.array([[4]])).tolist() == [0.0]
