import numpy as np
import pytest

from ial.lidar.search.outer_faces import outer_faces
from tests.lidar.search.test_border_refinement import WORLDS, Case


@pytest.mark.slow
def test_outer_faces_are_those_without_a_neighbour() -> None:
    for seed in range(WORLDS):
        case = Case(seed, at_the_cut=seed % 2 == 0)
        case.cells = case.cells[np.random.default_rng(seed).random(len(case.cells)) < 0.7]
        outer = outer_faces(case.cells, case.lattice)
        places = case.places()
        for number, place in enumerate(places):
            for axis in range(3):
                for side, step in enumerate((-1, 1)):
                    assert outer[number, side, axis] == (case.neighbour(place, axis, step) not in places)
