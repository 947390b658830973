from fractions import Fraction

import numpy as np
import pytest

from ial.maps.polygons.clearance import Clearance
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.polygon import Polygon
from ial.maps.polygons.walls import Walls
from tests.bouncing.rays.test_real_robot import ring
from tests.bouncing.truth import random_environment
from tests.maps.polygons.test_contact_edge import distances


def test_a_point_can_stand_everywhere() -> None:
    room = Environment((Polygon(ring((0, 0), (4, 0), (4, 2), (0, 2))),))
    walls = Walls.of(room)
    four = np.arange(4, dtype=np.int32)
    assert Clearance.of(room, Fraction(0)).of_parts(walls, four, np.zeros(4), np.ones(4)).all()


@pytest.mark.parametrize("seed", range(40))
def test_a_part_is_left_out_only_if_one_wall_is_too_near_to_all_of_it(seed: int) -> None:
    there, random = random_environment(seed), np.random.default_rng(seed)
    x0, y0, x1, y1 = there.bounds
    radius = min(Fraction(int(random.integers(50, 800)), 1000), min(x1 - x0, y1 - y0) / 2)
    edges = Walls.of(there, radius)
    walls = np.repeat(np.flatnonzero(edges.stopping).astype(np.int32), 8)
    first = random.random(len(walls))
    last = np.minimum(first + random.choice([0.0, 0.05, 0.3], len(walls)), 1.0)
    kept = Clearance.of(there, radius).of_parts(edges, walls, first, last)
    dx, dy = edges.x[edges.after] - edges.x, edges.y[edges.after] - edges.y
    origin = np.array([float(each) for each in edges.origin])
    near = np.zeros(len(walls))
    for part in np.linspace(0.0, 1.0, 9):
        along = first + part * (last - first)
        here = np.stack([edges.x[walls] + along * dx[walls], edges.y[walls] + along * dy[walls]], axis=1) + origin
        near = np.maximum(near, distances(there, here) + edges.bulge[walls])
    assert (near[~kept] < float(radius)).all()
    points = first == last  # of these, the nearest wall decides
    assert (near[points & kept] > float(radius) - 1e-9).all()
