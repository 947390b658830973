from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from ial.bouncing.exports.c_source import c_header
from ial.bouncing.exports.csv_table import csv_text
from ial.bouncing.exports.exported_filter import ExportedFilter
from ial.bouncing.exports.jflap import read_jff
from ial.bouncing.exports.verilog import memory_image, verilog_module
from ial.bouncing.filters.filter_file import read_filter
from tests.cli.bounce.hall import Cli


def test_c(ial: Cli, built: Path) -> None:
    result = ial("bounce", "export", built, "--prefix", "hall", "--out", "hall.h")
    assert (result.exit_code, result.stderr) == (0, "")
    assert result.stdout.splitlines() == [
        "177 states and a trap in hall.h",
        "flash: 534 bytes for steps and colours, 1,198 with all tables",
        "RAM: 1 byte",
    ]
    assert Path("hall.h").read_text() == c_header(ExportedFilter.of(read_filter(built)), "hall")


def test_options_reach_the_export(ial: Cli, built: Path) -> None:
    ending = ["--format", "c", "--restart", "--minimize", "localized", "--out", "small.txt"]
    assert ial("bounce", "export", built, *ending).stdout.startswith("135 states")
    assert Path("small.txt").read_text() == c_header(ExportedFilter.of(read_filter(built), "localized", restart=True))


def test_a_small_flash_is_a_warning(ial: Cli, built: Path) -> None:
    result = ial("bounce", "export", built, "--out", "hall.h", "--flash", 1000)
    assert result.exit_code == 0
    assert result.stderr.startswith("warning: the tables take 1,198 bytes of flash, and the budget is 1,000; 534 of them")
    assert "--minimize colours" in result.stderr
    assert "a larger cell" in result.stderr
    assert Path("hall.h").exists()
    assert ial("bounce", "export", built, "--out", "hall.h", "--flash", 1198, "--overwrite").stderr == ""


def test_verilog(ial: Cli, built: Path) -> None:
    result = ial("bounce", "export", built, "--out", "hall.v")
    assert result.stdout == "177 states and a trap in hall.v and hall.hex\n"
    exported = ExportedFilter.of(read_filter(built))
    assert Path("hall.v").read_text() == verilog_module(exported, "hall.hex")
    assert Path("hall.hex").read_text() == memory_image(exported)


def test_other_tools(ial: Cli, built: Path) -> None:
    for form in ("dot", "jff", "csv", "npz"):
        assert ial("bounce", "export", built, "--format", form, "--out", f"out.{form}.x").exit_code == 0
    table = read_filter(built).table
    assert Path("out.csv.x").read_text() == csv_text(table)
    assert len(read_jff("out.jff.x").names) == len(table)
    assert Path("out.dot.x").read_text().startswith("digraph filter {")
    with np.load("out.npz.x") as archive:
        assert np.array_equal(archive["next"], table.successors)


def test_a_large_graph_is_forced(ial: Cli, hall: Path, refused: Callable[..., str]) -> None:
    assert ial("bounce", "build", hall, "--cell", "1/10", "--angle", 45, "--out", "large.npz").exit_code == 0
    assert "and a picture of more than 2,000 cannot be read" in refused("bounce", "export", "large.npz", "--out", "large.dot")
    assert ial("bounce", "export", "large.npz", "--out", "large.dot", "--force").exit_code == 0


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--out", "hall.txt"], "hall.txt: no format has the suffix '.txt'; use one of .h, .v"),
        (["--out", "hall.h", "--prefix", "9"], "the prefix '9' is no identifier"),
        (["--out", "hall.npz"], "hall.npz: this is an input of the command"),
        (["--out", "nowhere/hall.h"], "there is no folder nowhere"),
    ],
)
def test_bad_input_is_refused(refused: Callable[..., str], built: Path, options: list[str], message: str) -> None:
    assert message in refused("bounce", "export", built, *options)


def test_an_unknown_format_and_a_negative_flash_are_refused(ial: Cli, built: Path) -> None:
    for options in (["--format", "vhdl"], ["--flash", "-1"]):  # the command line itself refuses them
        result = ial("bounce", "export", built, "--out", "hall.h", *options)
        assert result.exit_code == 2
        assert not Path("hall.h").exists()


def test_files_that_are_no_filters_are_refused(ial: Cli, refused: Callable[..., str], built: Path) -> None:
    Path("cut.npz").write_bytes(built.read_bytes()[:500])
    assert "truncated" in refused("bounce", "export", "cut.npz", "--out", "hall.h")
    assert "cannot be read" in refused("bounce", "export", "nowhere.npz", "--out", "hall.h")
    assert ial("bounce", "export", built, "--out", "plain.npz").exit_code == 0
    assert "no filter that ial has written" in refused("bounce", "export", "plain.npz", "--out", "hall.h")


def test_a_filter_of_another_name_is_the_same_file(built: Path, refused: Callable[..., str]) -> None:
    Path("link.npz").hardlink_to(built)
    before = built.read_bytes()
    assert "this is an input of the command" in refused("bounce", "export", built, "--out", "link.npz")
    assert built.read_bytes() == before


def test_a_set_filter_is_exported_as_c_alone(ial: Cli, sets: Path) -> None:
    result = ial("bounce", "export", sets, "--prefix", "hall", "--out", "sets.h")
    assert result.exit_code == 0
    assert "10944 pieces of walls in sets.h" in result.stdout
    assert "static inline int hall_update(hall_filter *filter, int bump)" in Path("sets.h").read_text()
    for more in (("--out", "sets.v"), ("--out", "b.h", "--restart"), ("--out", "b.h", "--minimize", "colours")):
        result = ial("bounce", "export", sets, *more)
        assert result.exit_code == 2
        assert "give --format c or npz, without --minimize and --restart" in result.stderr
    result = ial("bounce", "show", sets, "--out", "a.png")
    assert result.exit_code == 2
    assert "no cycles and no basins" in result.stderr


def test_a_set_filter_is_exported_as_plain_arrays(ial: Cli, sets: Path) -> None:
    assert "10944 pieces of walls in a.npz" in ial("bounce", "export", sets, "--out", "a.npz").stdout
    with np.load("a.npz") as arrays:
        assert arrays["arc_start"].shape == (10945,)
        assert arrays["box_m"].shape == (152, 4)
        assert len(arrays["arc_part"]) == len(arrays["arc_least"]) == len(arrays["arc_most"]) == 42182
        assert len(arrays["first"]) == 0
        assert arrays["turn"].tolist() == [19, 21]
