import numpy as np
import pytest

from ial.bouncing.automata.determinization import determinize
from ial.bouncing.automata.table import FilterTable
from ial.bouncing.cells.graph import disjoint_union
from ial.bouncing.filters.bank import FilterBank
from ial.errors import ConfigError
from tests.bouncing.automata.test_table import ROOMS, TABLES
from tests.bouncing.worlds import observations


def test_the_filter_of_the_union_and_the_filters_side_by_side_agree() -> None:
    union = FilterTable.of(determinize(disjoint_union([made.graph for made in ROOMS.values()]), verify=True))
    names = list(ROOMS)
    chooser = np.random.default_rng(5)
    streams = [chooser.integers(0, 2, 30).tolist() for _ in range(100)]
    streams += [observations(made.graph, start, 60)[0] for made in ROOMS.values() for start in range(0, len(made.graph), 9)]
    for stream in streams:
        bank, state = FilterBank(TABLES), 0
        for reading in stream:
            bank.update(reading)
            state = union.step(state, reading)
            assert [names[number] for number in union.possible(state)] == bank.possible
            assert union.uncertainty[state] == bank.uncertainty
            assert (state == union.trap) == (bank.possible == [])


def test_a_bank_needs_a_filter() -> None:
    with pytest.raises(ConfigError, match="no environment"):
        FilterBank({})
