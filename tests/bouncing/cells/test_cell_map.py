from fractions import Fraction

import numpy as np
import pytest

from ial.bouncing.cells.cell_map import CellMap
from ial.bouncing.cells.headings import Headings
from ial.contractors import threads
from ial.errors import ConfigError, MapError
from ial.maps.polygons.raster import Raster
from tests.bouncing.worlds import cell_map, drawn, random_mask, twin_next, worlds


@pytest.mark.parametrize("seed", range(12))
def test_every_arc_is_what_the_definition_says(seed: int) -> None:
    made = list(worlds(seed + 1))[-1]
    successors, labels = made.graph.successors, made.graph.labels
    for vertex in range(len(made.graph)):
        row, column, mode = (int(each) for each in made.configurations(vertex))
        for heading in made.classes.members(mode):
            assert made.vertex(row, column, heading) == vertex
            r, c, turned, bump = twin_next(made, row, column, heading)
            assert (made.vertex(r, c, turned), bump) == (successors[vertex], labels[vertex])


def test_a_robot_at_a_wall_stays_and_turns() -> None:
    made = cell_map(drawn(".. .."))
    at = made.vertex(0, 1, 0)
    assert made.graph.labels[at]
    assert made.graph.successors[at] == made.vertex(0, 1, 1)
    assert made.graph.successors[made.vertex(0, 0, 0)] == at
    corner = made.vertex(1, 1, 0)  # faces one wall, then the other: a double bounce
    assert made.graph.labels[[corner, made.graph.successors[corner]]].tolist() == [True, True]


def test_merged_headings_stand_for_the_same_configurations() -> None:
    free = random_mask(3)
    whole, merged = cell_map(free, 90, 24), cell_map(free, 90, 24, merge=True)
    assert merged.graph.configurations == len(whole.graph) == 24 * len(whole.cells[0])
    for vertex in range(len(whole.graph)):
        row, column, heading = (int(each) for each in whole.configurations(vertex))
        other = merged.vertex(row, column, heading)
        r, c, turned = (int(each) for each in whole.configurations(whole.graph.successors[vertex]))
        assert merged.graph.successors[other] == merged.vertex(r, c, turned)
        assert merged.graph.labels[other] == whole.graph.labels[vertex]


def test_the_number_of_threads_changes_nothing() -> None:
    free = np.random.default_rng(1).random((120, 90)) > 0.1
    try:
        threads.set_threads(1)
        alone = cell_map(free, 45, 16).graph.arcs
        threads.set_threads(3)
        assert np.array_equal(cell_map(free, 45, 16).graph.arcs, alone)
    finally:
        threads.set_threads(None)


def test_centres_are_in_the_frame_of_the_environment() -> None:
    made = CellMap(Raster(drawn("..."), Fraction(1, 3), Fraction(-1), Fraction(5)), Headings.of_angle(Fraction(90)))
    assert made.centre(0, 2) == (Fraction(-1, 6), Fraction(31, 6))


@pytest.mark.slow
def test_what_cannot_be_mapped_is_refused() -> None:
    with pytest.raises(MapError, match="no cell is free, so the robot can be nowhere"):
        cell_map(drawn("## ##"))
    with pytest.raises(MapError, match="too many vertices"):
        cell_map(np.ones((300, 300), dtype=np.bool_), 90, 32_000)
    with pytest.raises(ConfigError, match="row 0, column 1, heading 0 is no configuration"):
        cell_map(drawn(".#")).vertex(0, 1, 0)
    with pytest.raises(ConfigError, match="is no configuration"):
        cell_map(drawn("..")).vertex(0, 1, 4)
