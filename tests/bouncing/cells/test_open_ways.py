from fractions import Fraction

import numpy as np
import pytest
import shapely

from ial.bouncing.cells.open_ways import open_ways
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.polygon import Polygon
from ial.maps.polygons.raster import cover
from ial.maps.polygons.walls import Walls
from tests.bouncing.rays.test_real_robot import ring
from tests.bouncing.truth import random_environment

OFFSETS = np.array([(dx, dy) for dx in range(-4, 5) for dy in range(-4, 5)], dtype=np.int64)


@pytest.mark.parametrize("seed", range(20))
def test_where_one_straight_way_is_free_the_way_is_open(seed: int) -> None:
    environment, cell = random_environment(seed), 0.4
    raster = cover(environment, Fraction(2, 5))
    ways = open_ways(Walls.of(environment), raster, OFFSETS)
    room = shapely.union_all([shapely.Polygon(each.outer, each.holes) for each in environment.polygons])
    chooser = np.random.default_rng(seed)
    begins = np.argwhere(raster.free)[chooser.integers(0, int(raster.free.sum()), 12_000)]
    numbers = chooser.integers(0, len(OFFSETS), 12_000)
    ends = begins + OFFSETS[numbers][:, ::-1]
    kept = ((ends >= 0) & (ends < raster.free.shape)).all(axis=1)
    begins, ends, numbers = begins[kept], ends[kept], numbers[kept]
    origin = np.array([float(raster.x), float(raster.y)])
    corner = chooser.integers(0, 2, (2, len(begins), 2)) * (chooser.random((2, len(begins), 1)) < 0.5)
    where = np.where(chooser.random((2, len(begins), 1)) < 0.5, corner, chooser.random((2, len(begins), 2)))
    lines = shapely.linestrings(
        np.stack([origin + cell * (each[:, ::-1] + at) for each, at in zip((begins, ends), where, strict=True)], axis=1)
    )
    free = shapely.covers(room, lines) & raster.free[tuple(ends.T)]
    assert free.sum() > 100
    opened = ways[numbers, begins[:, 0], begins[:, 1]]
    assert opened[free].all()


def test_no_way_leads_through_a_thin_wall() -> None:
    """Two rooms of 4 m × 4 m with a wall of 10 cm between them, and a door of 1 m."""
    rooms = Environment((Polygon(ring((0, 0), (8.5, 0), (8.5, 4), (0, 4)), (ring((4.2, 1), (4.2, 3.75), (4.3, 3.75), (4.3, 1)),)),))
    raster = cover(rooms, Fraction(1, 2))
    offsets = np.array([(2, 0), (0, 2)], dtype=np.int64)
    across, up = open_ways(Walls.of(rooms), raster, offsets)
    assert raster.free.all()
    assert np.flatnonzero(~across[4]).tolist() == [*range(7, 8), *range(15, 17)], (
        "from the cells before the wall, and beside the right edge"
    )
    assert up[:6].all()


def test_a_way_ends_in_a_free_cell() -> None:
    rooms = random_environment(1)
    raster = cover(rooms, Fraction(1, 2))
    for (dx, dy), way in zip(OFFSETS.tolist(), open_ways(Walls.of(rooms), raster, OFFSETS), strict=True):
        rows, columns = np.nonzero(way)
        assert raster.free[rows, columns].all()
        assert raster.free[rows + dy, columns + dx].all()
