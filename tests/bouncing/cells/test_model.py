import numpy as np
import pytest

from ial.bouncing.automata.determinization import determinize
from ial.bouncing.automata.table import FilterTable
from ial.bouncing.cells.cell_map import CellMap
from ial.bouncing.cells.model import BouncingModel
from ial.membership import Rejection, SetMembershipFilter
from tests.bouncing.worlds import cell_map, drawn, observations, random_mask, twin_information_states, worlds


@pytest.mark.parametrize("made", list(worlds(8)))
def test_the_sets_are_those_of_the_automaton_and_hold_the_truth(made: CellMap) -> None:
    model = BouncingModel(made.graph)
    arcs, sets = twin_information_states(made.graph)
    for start in range(0, len(made.graph), 5):
        running = SetMembershipFilter(model, "restart")
        stream, passed = observations(made.graph, start, 40)
        state = 0
        for reading, truth in zip(stream, passed[1:], strict=True):
            predicted = set(model.predict(running.states, None).tolist())
            assert running.update(None, reading) is None, "a stream of the environment is never rejected"
            state = arcs[state][reading]  # type: ignore[assignment]
            held = set(running.states.tolist())
            assert held == sets[state]
            assert truth in held
            assert len(held) == len(running.states)
            assert held <= predicted


def test_the_trap_is_a_rejection_and_restarting_is_that_of_the_table() -> None:
    graph = cell_map(random_mask(7)).graph
    model, table = BouncingModel(graph), FilterTable.of(determinize(graph)).restarting()
    stream = np.random.default_rng(3).integers(0, 2, 400).tolist()
    running = SetMembershipFilter(model, "restart")
    rejections = [running.update(None, reading) for reading in stream]
    trapped = [state == table.trap for state in table.run(stream)]
    assert [each is not None for each in rejections] == trapped
    assert sum(trapped) > 10
    first = next(each for each in rejections if each is not None)
    assert first == Rejection(trapped.index(True))


def test_an_absorbing_trap_is_never_left() -> None:
    model = BouncingModel(cell_map(drawn("... ...")).graph)
    running = SetMembershipFilter(model, "absorb")
    assert [running.update(None, reading) is None for reading in (0, 0, 0, 1, 1)] == [True, True, False, False, False]
    assert model.empty(running.states)


def test_a_set_is_not_changed_by_a_step() -> None:
    model = BouncingModel(cell_map(random_mask(1)).graph)
    universe = model.universe()
    kept = universe.copy()
    assert len(model.step(universe, None, 0)) + len(model.step(universe, None, 1)) >= len(model.predict(universe, None))
    assert np.array_equal(universe, kept)
