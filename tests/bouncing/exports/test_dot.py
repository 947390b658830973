import re
import shutil
import subprocess

import numpy as np
import pytest

from ial.bouncing.automata.table import FilterTable
from ial.bouncing.exports.dot import dot_text
from ial.bouncing.exports.exported_filter import ExportedFilter
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.errors import ConfigError

NODE = re.compile(r'  (\d+) \[label="([^"]*)"([^]]*)\];')
ARC = re.compile(r'  (\d+) -> (\d+) \[label="([01])"\];')


def drawn(text: str) -> tuple[dict[int, str], dict[tuple[int, int], int]]:
    """The labels and the arcs of a graph; every line must be understood."""
    head, *lines, tail = text.splitlines()
    assert (head, tail) == ("digraph filter {", "}")
    nodes, arcs = {}, {}
    for line in lines:
        if node := NODE.fullmatch(line):
            nodes[int(node[1])] = node[2]
        elif arc := ARC.fullmatch(line):
            arcs[int(arc[1]), int(arc[3])] = int(arc[2])
        else:
            assert line in {"  rankdir=LR;", "  node [shape=circle];"}
    return nodes, arcs


@pytest.mark.parametrize("restart", [False, True])
def test_dot_holds_the_table(small: BounceFilter, restart: bool) -> None:
    exported = ExportedFilter.of(small, restart=restart)
    table = exported.table
    nodes, arcs = drawn(dot_text(exported))
    assert arcs == {(state, letter): table.step(state, letter) for state in range(len(table)) for letter in (0, 1)}
    assert nodes.pop(table.trap) == "trap"
    for state, label in nodes.items():
        colour = f"colour {table.colours[state]}, " if table.is_localized(state) else ""
        assert label == f"{state}\\n{colour}size {table.uncertainty[state]}"


def test_graphviz_reads_it(corner: BounceFilter) -> None:
    if shutil.which("dot") is None:
        pytest.skip("Graphviz is not installed")
    # Parsed and written anew, without a layout, which takes seconds.
    done = subprocess.run(["dot", "-Tcanon"], input=dot_text(ExportedFilter.of(corner)), capture_output=True, text=True, check=True)
    arcs = {(int(start), int(letter)): int(end) for start, end, letter in re.findall(r"(\d+) -> (\d+)\s+\[label=([01])\]", done.stdout)}
    assert arcs == {(state, letter): corner.table.step(state, letter) for state in range(len(corner.table)) for letter in (0, 1)}


def chain(states: int) -> FilterTable:
    """A filter that knows nothing until it traps."""
    following = np.minimum(np.arange(1, states + 2), states)
    colours = np.r_[np.ones(states, dtype=np.int32), np.int32(2)]
    return FilterTable(
        np.column_stack([following, following]).astype(np.int32), colours, np.r_[np.ones(states, dtype=np.int64), 0], colours
    )


def test_no_more_than_2000_states_are_drawn(corner: BounceFilter) -> None:
    assert len(drawn(dot_text(ExportedFilter(chain(2000), None, corner.setting)))[0]) == 2001
    large = ExportedFilter(chain(2001), None, corner.setting)
    with pytest.raises(ConfigError, match=r"has 2,001 states, and a picture of more than 2,000 cannot be read; .*--force"):
        dot_text(large)
    assert len(drawn(dot_text(large, force=True))[0]) == 2002
