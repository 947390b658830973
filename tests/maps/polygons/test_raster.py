from fractions import Fraction

import numpy as np
import pytest
import shapely
from hypothesis import assume, given
from hypothesis import strategies as st

from ial.errors import ConfigError, MapError
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.polygon import Polygon
from ial.maps.polygons.raster import rasterize

quarters = st.integers(0, 32).map(lambda n: Fraction(n, 4))


@st.composite
def polygons(draw: st.DrawFn) -> Polygon:
    ring = draw(st.lists(st.tuples(quarters, quarters), min_size=3, max_size=7, unique=True))
    hole = draw(st.lists(st.tuples(quarters, quarters), min_size=3, max_size=3, unique=True))
    try:
        outer = Polygon(tuple(ring))
    except MapError:
        assume(False)
    try:
        return Polygon(tuple(ring), (tuple(hole),))
    except MapError:
        return outer


@pytest.mark.slow
@given(polygons(), st.sampled_from([Fraction(1, 2), Fraction(1), Fraction(2)]))
def test_cells_are_free_exactly_if_they_lie_in_the_polygon(polygon: Polygon, cell: Fraction) -> None:
    area = shapely.Polygon(polygon.outer, polygon.holes)  # quarters are exact in doubles, and so are these predicates
    for rule in ("inside", "centre"):
        raster = rasterize(Environment((polygon,)), cell, rule)  # type: ignore[arg-type]
        for (row, column), free in np.ndenumerate(raster.free):
            x, y = float(raster.x + column * cell), float(raster.y + row * cell)
            size = float(cell)
            square = shapely.box(x, y, x + size, y + size)
            expected = area.covers(square) if rule == "inside" else area.covers(square.centroid)
            assert free == expected, (rule, row, column)


def test_a_wall_off_by_a_trillionth_is_off() -> None:
    almost = Fraction(4) - Fraction(1, 10**30)
    for height, rows in ((Fraction(4), 4), (almost, 3)):
        room = Polygon(((Fraction(0), Fraction(0)), (Fraction(4), Fraction(0)), (Fraction(4), height), (Fraction(0), height)))
        assert int(rasterize(Environment((room,)), Fraction(1), "inside").free.sum()) == 4 * rows


def test_inside_is_within_centre_and_finer_cells_lose_less() -> None:
    triangle = Polygon(((Fraction(0), Fraction(0)), (Fraction(9), Fraction(2)), (Fraction(3), Fraction(8))))
    environment = Environment((triangle,))
    areas = []
    for cell in (Fraction(1), Fraction(1, 2), Fraction(1, 4)):
        inside, centre = (rasterize(environment, cell, rule).free for rule in ("inside", "centre"))  # type: ignore[arg-type]
        assert not (inside & ~centre).any()
        areas.append(inside.sum() * cell**2)
    assert areas == sorted(areas)
    assert areas[-1] < triangle.area


def test_bad_cells_are_refused() -> None:
    environment = Environment((Polygon(((Fraction(0), Fraction(0)), (Fraction(9), Fraction(2)), (Fraction(3), Fraction(8)))),))
    with pytest.raises(ConfigError, match="width of a cell is -1"):
        rasterize(environment, Fraction(-1))
    with pytest.raises(MapError, match="too small"):
        rasterize(environment, Fraction(1, 10**6))
    with pytest.raises(ConfigError, match="rule 'middle'"):
        rasterize(environment, Fraction(1), "middle")  # type: ignore[arg-type]
