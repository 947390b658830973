import pytest
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch

from ial.results.compass.ground import draw_polygon, shape
from tests.maps.polygons.known_polygons import HOLED


def test_the_free_space_is_drawn_without_its_holes() -> None:
    axes = Figure().add_subplot()
    draw_polygon(axes, HOLED)
    (patch,) = axes.patches
    assert isinstance(patch, PathPatch)
    assert len(patch.get_path().vertices) == 6 + 1 + 4 + 1
    assert axes.get_xlim()[0] < 0 < 9 < axes.get_xlim()[1]
    assert shape(HOLED) == pytest.approx(7 / 9)
