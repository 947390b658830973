import numpy as np
import pytest

from ial.bouncing.automata.determinization import determinize
from ial.bouncing.automata.minimal import minimize
from ial.bouncing.automata.table import FilterTable
from tests.bouncing.automata.test_partition import twin
from tests.bouncing.worlds import observations, worlds


@pytest.mark.parametrize("made", list(worlds(6)))
def test_minimal_filters_answer_like_the_whole_one(made) -> None:  # type: ignore[no-untyped-def]
    table = FilterTable.of(determinize(made.graph))
    by_colour, by_end = minimize(table), minimize(table, "localized")
    assert len(by_end) <= len(by_colour) <= len(table)
    assert len(by_colour) == len(set(twin(table.successors.tolist(), table.colours.tolist())))
    chooser = np.random.default_rng(0)
    streams = [chooser.integers(0, 2, 60).tolist() for _ in range(20)]
    streams += [observations(made.graph, start, 80)[0] for start in range(0, len(made.graph), 7)]
    for stream in streams:
        whole, small, end = (each.run(stream) for each in (table, by_colour, by_end))
        assert by_colour.colours[small].tolist() == table.colours[whole].tolist()
        assert [by_end.is_localized(state) for state in end] == [table.is_localized(state) for state in whole]
        assert [state == by_end.trap for state in end] == [state == table.trap for state in whole]
        assert (by_colour.uncertainty[small] >= table.uncertainty[whole]).all()
        on_cycle = table.colours[whole] > 1
        assert np.array_equal(by_colour.uncertainty[small][on_cycle], table.uncertainty[whole][on_cycle])
