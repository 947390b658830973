from fractions import Fraction

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

from ial.errors import MapError
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.outline import MaskArray, outlines
from ial.maps.polygons.polygon import Polygon
from ial.maps.polygons.raster import rasterize

masks = arrays(np.bool_, array_shapes(min_dims=2, max_dims=2, max_side=9)).filter(np.any)


def drawn(text: str) -> MaskArray:
    """A mask as one sees it: the first line is the top row, a dot is free."""
    return np.array([[char == "." for char in line] for line in text.split()][::-1])


@given(masks, st.sampled_from(["inside", "centre"]))
def test_rasterizing_the_outline_gives_the_grid_back(free: MaskArray, rule: str) -> None:
    rows, columns = np.nonzero(free)
    raster = rasterize(Environment(outlines(free, Fraction(1, 3))), Fraction(1, 3), rule)  # type: ignore[arg-type]
    assert (raster.x * 3, raster.y * 3) == (columns.min(), rows.min())
    assert np.array_equal(raster.free, free[rows.min() : rows.max() + 1, columns.min() : columns.max() + 1])


@given(masks)
def test_outlines_are_valid_polygons_that_do_not_overlap(free: MaskArray) -> None:
    polygons = outlines(free)
    for polygon in polygons:
        assert Polygon(polygon.outer, polygon.holes) == polygon  # as its own exact check says
        assert shapely.Polygon(polygon.outer, polygon.holes).is_valid
    assert sum(polygon.area for polygon in polygons) == np.count_nonzero(free)
    for ring in (ring for polygon in polygons for ring in polygon.rings):
        for a, b, c in zip(ring, ring[1:] + ring[:1], ring[2:] + ring[:2], strict=True):
            assert (a[0] == b[0]) != (b[0] == c[0]), "every corner is a turn"


def test_free_cells_that_meet_in_a_corner_are_apart() -> None:
    assert len(outlines(drawn(".# #."))) == 2


def test_obstacles_that_meet_in_a_corner_hang_together() -> None:
    (polygon,) = outlines(drawn("..... .#... ..#.. ....."))
    assert sorted(len(hole) for hole in polygon.holes) == [4, 4]
    (ring, inner) = outlines(drawn("..... ..#.. .#.#. ..#.. ....."))
    assert ring.area == 20
    assert inner.area == 1


def test_a_hole_that_meets_the_wall_in_a_corner() -> None:
    (polygon,) = outlines(drawn("#... .#.. .... ...."))
    assert len(polygon.holes) == 1
    assert polygon.area == 14


def test_no_free_cell_has_no_outline() -> None:
    with pytest.raises(MapError, match="no cell of the grid is free"):
        outlines(np.zeros((2, 3), dtype=np.bool_))
