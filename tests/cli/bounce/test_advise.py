import json
import shlex
from collections.abc import Callable
from pathlib import Path

import pytest

from ial.bouncing.exports.c_tables import CTables
from ial.bouncing.exports.exported_filter import ExportedFilter
from ial.bouncing.exports.piece_source import PieceTables
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.bouncing.filters.filter_file import read_filter
from ial.bouncing.filters.piece_filter import PieceFilter
from tests.cli.bounce.hall import Cli


@pytest.mark.parametrize(
    "options", [("--radius", "1/2"), ("--angle", 100, "--turn-error", 2, "--step-error", "0.02", "--count-error", 1), ("--step", "1/2")]
)
def test_what_is_advised_can_be_built_and_is_what_was_said(ial: Cli, hall: Path, options: tuple[object, ...]) -> None:
    record = json.loads(ial("bounce", "advise", hall, *options, "--json").stdout)
    (row,) = [each for each in (*record["cells"], *record["rays"]) if each["advised"]]
    printed = ial("bounce", "advise", hall, *options).stdout.splitlines()
    assert printed[-1] == record["command"]
    assert printed[-2] == f"take the row marked *: {record['reason']}"
    (marked,) = [line for line in printed if line.startswith("* ")]
    assert f"{row['flash_bytes']:,}" in marked.split()
    assert ial(*shlex.split(record["command"])[1:]).exit_code == 0
    made = read_filter(Path("hall.npz"))
    if isinstance(made, PieceFilter):
        tables = PieceTables.of(made.map, "bounce")
        assert (row["pieces"], row["flash_bytes"], row["ram_bytes"]) == (len(made.map), tables.flash_bytes, tables.ram_bytes)
    else:
        assert isinstance(made, BounceFilter)
        assert row["states"] == len(made.table) - 1
        assert row["flash_bytes"] == CTables.of(ExportedFilter.of(made), "bounce").flash_bytes


def test_advice_that_cannot_be_given_says_so(ial: Cli, hall: Path, refused: Callable[..., str]) -> None:
    result = ial("bounce", "advise", hall, "--radius", "9", "--turn-error", 1)
    assert result.exit_code == 0
    assert "take none of these: there is no exact filter here; a robot of radius 9 m fits nowhere" in result.stdout
    record = json.loads(ial("bounce", "advise", hall, "--radius", "1/2", "--turn-error", 1, "--most-states", 9, "--json").stdout)
    assert "--radius 1/2" in record["command"]
    assert {each["more_than_states"] for each in record["cells"]} == {9}
    assert ial("bounce", "advise", hall, "--radius", "1/2", "--turn-error", 1, "--most-states", 9).stdout.count("> 9 ") == 8
    assert "multiple of 360°" in refused("bounce", "advise", hall, "--angle", "360")
    assert "radius of the robot is -1" in refused("bounce", "advise", hall, "--radius=-1")
