import itertools

import numpy as np
import pytest

from ial.bouncing.automata.determinization import determinize
from ial.bouncing.automata.table import FilterTable
from ial.errors import StreamError
from tests.bouncing.worlds import cell_map, drawn, observations, random_mask, worlds

ROOMS = {
    "hall": cell_map(drawn("....... ....... ....... ..#.... ......."), 45, 8),
    "office": cell_map(drawn("##..... ..#.... ....... ..#.... ....###"), 45, 8),
    "store": cell_map(drawn(".....# ...... ..#... ...... #....."), 45, 8),
}
TABLES = {name: FilterTable.of(determinize(made.graph)) for name, made in ROOMS.items()}


@pytest.mark.parametrize("made", list(worlds(8)))
def test_own_streams_are_never_trapped_and_always_localized(made) -> None:  # type: ignore[no-untyped-def]
    automaton = determinize(made.graph)
    table = FilterTable.of(automaton)
    for start in range(len(made.graph)):
        states = table.run_closed(observations(made.graph, start, automaton.depth + 1)[0])
        assert table.is_localized(states[-1])
        assert table.uncertainty[states[-1]] >= 1


def test_colours() -> None:
    table = TABLES["hall"]
    assert table.colours[0] == 1
    assert table.colours[table.trap] == table.cycles + 2
    assert set(table.colours.tolist()) == set(range(1, table.cycles + 3))
    assert not table.is_localized(0)
    assert not table.is_localized(table.trap)


@pytest.mark.parametrize(("home", "other"), list(itertools.permutations(ROOMS, 2)))
def test_streams_of_another_environment_are_rejected(home: str, other: str) -> None:
    # What a filter rejects is decided within its depth and one round of its cycles against the periods of the stream.
    rejected = [TABLES[other].run(observations(ROOMS[home].graph, start, 400)[0])[-1] == TABLES[other].trap for start in range(200)]
    assert all(rejected)


def test_a_closed_world_does_not_contradict_itself() -> None:
    with pytest.raises(StreamError, match="observation 7 of the stream fits no place"):
        TABLES["hall"].run_closed([0] * 9)


def test_the_trap_is_left_only_by_restarting() -> None:
    table = TABLES["hall"]
    assert table.run([0] * 20 + [1, 0])[-1] == table.trap
    again = table.restarting()
    states = again.run([0] * 7 + [1])
    assert states[6] == again.trap
    assert states[7] == table.run([1])[0]
    own = observations(ROOMS["hall"].graph, 5, 60)[0]
    behind = states.index(again.trap) + 1
    assert again.run([0] * behind + own)[behind:] == table.run(own)


def test_a_random_room_is_told_from_itself_with_one_cell_more() -> None:
    free = random_mask(11)
    changed = free.copy()
    changed[np.unravel_index(np.flatnonzero(~free)[4], free.shape)] = True
    one, other = (determinize(cell_map(mask).graph) for mask in (free, changed))
    assert not np.array_equal(one.successors, other.successors)
