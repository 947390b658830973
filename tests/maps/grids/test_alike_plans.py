import pytest
from scipy import ndimage

from ial.errors import MapError
from ial.maps.grids.alike_plans import alike_plan, plan_names
from ial.maps.grids.occupancy_grid import FREE
from ial.maps.grids.symmetry import symmetries


@pytest.mark.parametrize("name", plan_names())
def test_free_space_is_one_piece_inside_of_walls(name: str) -> None:
    grid = alike_plan(name)
    free = grid.mask(FREE)
    assert not free[[0, -1]].any()
    assert not free[:, [0, -1]].any()
    assert ndimage.label(free)[1] == 1
    clear = ndimage.binary_erosion(free, iterations=8)
    assert ndimage.label(clear, [[1] * 3] * 3)[1] == 1, "and so is what a robot of 0.4 m can reach"
    assert free.sum() * grid.resolution**2 > 20.0


def test_only_the_ring_looks_the_same_from_several_sides() -> None:
    assert {name: len(symmetries(alike_plan(name), (FREE,))) for name in plan_names()} == {
        name: 3 if name == "ring" else 0 for name in plan_names()
    }


def test_another_name_is_refused() -> None:
    with pytest.raises(MapError, match="no plan called 'castle'; give one of rooms, office"):
        alike_plan("castle")
