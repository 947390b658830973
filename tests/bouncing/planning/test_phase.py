import numpy as np

from ial.bouncing.automata.determinization import determinize
from ial.bouncing.cells.cell_map import CellMap
from ial.bouncing.planning.information_sets import InformationSets
from ial.bouncing.planning.phase import Phase
from ial.maps.polygons.raster import Raster
from tests.bouncing.planning.test_angle_search import comes_back
from tests.bouncing.worlds import HALL, cell_map, worlds


def test_one_angle_says_what_its_automaton_says() -> None:
    for map_ in worlds(20):
        phase = Phase.of(map_.graph)
        automaton, known = determinize(map_.graph), phase.after(InformationSets.everything(map_.graph))
        sizes = known.uncertainty(map_.graph)
        assert (sizes.min(), sizes.max()) == (automaton.cycles.uncertainty.min(), automaton.cycles.uncertainty.max())
        assert known.elapsed.max() == automaton.depth
        assert known.weights.sum() == map_.graph.configurations


def test_a_phase_begins_in_any_set() -> None:
    graph = CellMap(Raster(HALL), cell_map(HALL).headings).graph
    held = np.arange(0, len(graph), 7, dtype=np.int32)
    known = InformationSets(np.array([0, len(held)]), held, np.ones(len(held), dtype=np.int64), np.array([5]))
    ends = Phase.of(graph).after(known)
    for number in range(len(ends)):
        members = frozenset(ends.members[ends.starts[number] : ends.starts[number + 1]].tolist())
        assert comes_back(graph, members)
    assert ends.weights.sum() == len(held)
    assert ends.elapsed.min() >= 5
