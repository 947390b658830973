import csv
import io
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from ial.bouncing.automata.table import FilterTable
from ial.bouncing.exports.archive import plain_archive
from ial.bouncing.exports.csv_table import csv_text
from ial.bouncing.exports.dot import dot_text
from ial.bouncing.exports.exported_filter import ExportedFilter
from ial.bouncing.exports.formats import export, format_of
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.errors import ConfigError, OutputError

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


def test_csv_holds_the_table(small: BounceFilter) -> None:
    table = small.table
    rows = list(csv.DictReader(io.StringIO(csv_text(table))))
    assert [int(row["state"]) for row in rows] == list(range(len(table)))
    for names, array in ((("next_0", "next_1"), table.successors), (("colour",), table.colours), (("size",), table.uncertainty)):
        assert np.array_equal([[int(row[name]) for name in names] for row in rows], array.reshape(len(table), -1))


def test_the_archive_holds_plain_arrays(small: BounceFilter) -> None:
    with np.load(io.BytesIO(plain_archive(ExportedFilter.of(small))), allow_pickle=False) as archive:
        arrays = dict(archive)
    table = small.table
    for name, array in (("next", table.successors), ("colour", table.colours), ("size", table.uncertainty)):
        assert np.array_equal(arrays[name], array)
    assert np.array_equal(arrays["environments"], table.environments)
    for state in range(len(table)):
        told = []
        for place in arrays["place"][arrays["place_start"][state] : arrays["place_start"][state + 1]]:
            environment, kind = arrays["place_environment"][place], arrays["place_class"][place]
            cell = np.array([arrays["place_column"][place], arrays["place_row"][place]])
            x, y = arrays["corner_m"][environment] + (cell + 0.5) * arrays["cell_m"]
            headings = arrays["heading"][arrays["class_start"][kind] : arrays["class_start"][kind + 1]]
            told.append((str(arrays["name"][environment]), x, y, tuple(arrays["heading_deg"][headings])))
        assert told == [(each.environment, each.x_m, each.y_m, each.headings_deg) for each in small.where(state)]


def test_a_minimized_archive_has_no_places(corner: BounceFilter) -> None:
    with np.load(io.BytesIO(plain_archive(ExportedFilter.of(corner, "colours")))) as archive:
        assert {name for name in archive if "place" in name} == set()


@pytest.mark.parametrize(
    ("name", "form"),
    [("a.h", "c"), ("a.v", "verilog"), ("a.DOT", "dot"), ("a.gv", "dot"), ("a.jff", "jff"), ("a.csv", "csv"), ("a.npz", "npz")],
)
def test_suffixes_stand_for_formats(name: str, form: str, corner: BounceFilter, tmp_path: Path) -> None:
    assert format_of(Path(name)) == form
    files = export(ExportedFilter.of(corner), tmp_path / name)
    assert sorted(tmp_path.iterdir()) == sorted(files)
    assert {file.suffix for file in files} == ({".v", ".hex"} if form == "verilog" else {Path(name).suffix})


def test_what_cannot_be_exported_is_refused(corner: BounceFilter, tmp_path: Path) -> None:
    exported = ExportedFilter.of(corner)
    with pytest.raises(ConfigError, match=r"a\.txt: no format has the suffix '\.txt'; use one of \.h, \.v"):
        export(exported, tmp_path / "a.txt")
    with pytest.raises(ConfigError, match="the format 'vhdl' is unknown; use one of c, verilog"):
        export(exported, tmp_path / "a.v", "vhdl")  # type: ignore[arg-type]
    with pytest.raises(ConfigError, match=r"the memory image gets the suffix \.hex"):
        export(exported, tmp_path / "a.hex", "verilog")
    with pytest.raises(OutputError, match=r"a\.v: the export cannot be written"):
        export(exported, tmp_path / "nowhere" / "a.v")
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError, match="cannot be written"):
        export(exported, tmp_path / "file" / "a.h")
    (tmp_path / "folder.h").mkdir()
    with pytest.raises(OutputError, match=r"folder\.h: the export cannot be written"):
        export(exported, tmp_path / "folder.h")
    (tmp_path / "b.hex").mkdir()
    with pytest.raises(OutputError, match=r"b\.hex: the export cannot be written \(Is a directory\)"):
        export(exported, tmp_path / "b.v")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["b.hex", "file", "folder.h"]
