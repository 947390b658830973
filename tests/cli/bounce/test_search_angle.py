import json
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.cli.bounce.hall import Cli


def test_a_table_of_all_angles_and_the_best(ial: Cli, hall: Path) -> None:
    result = ial("bounce", "search-angle", hall, "--cell", "1", "--headings", 4)
    assert result.exit_code == 0
    lines = result.stdout.splitlines()
    assert lines[0] == "hall: 196 configurations, 4 headings, cells of 1 m"
    assert lines[1].split() == ["angle", "states", "cycles", "least", "mean", "worst", "depth"]
    assert {line.split()[0] for line in lines[2:5]} == {"90°", "180°", "270°"}
    assert ["90°", "177", "2"] in [line.split()[:3] for line in lines[2:5]]  # as `ial bounce build` says
    assert lines[-1].startswith(f"best: {lines[2].split()[0]}; a robot ends in ")


def test_sequences(ial: Cli, hall: Path) -> None:
    record = json.loads(ial("bounce", "search-angle", hall, "--headings", 8, "--sequence", 2, "--json").stdout)
    assert record["best"] == record["sequences"][0]
    assert len(record["sequences"]) == 7 + 7 * 6
    single = [each for each in record["sequences"] if len(each["angles_deg"]) == 1]
    assert record["best"]["worst_configurations"] == 1 < min(each["worst_configurations"] for each in single)
    text = ial("bounce", "search-angle", hall, "--headings", 8, "--sequence", 2).stdout
    first, second = record["best"]["angles_deg"]
    assert f"best: {first:g}°, then {second:g}°; a robot ends in 1 configuration at worst" in text
    assert "and 32 more; --json lists all" in text


def test_some_angles_of_several_environments(ial: Cli, hall: Path) -> None:
    Path("room.svg").write_text('<svg><polygon points="0,0 6,0 6,5 0,5"/></svg>')
    result = ial("bounce", "search-angle", hall, "room.svg", "--angle", "45", "--angle", "135", "--cell", "1/2", "--radius", "1/4")
    assert result.stdout.startswith("hall, room: ")
    assert [line.split()[0] for line in result.stdout.splitlines()[2:4]] in (["45°", "135°"], ["135°", "45°"])


def test_no_longer_sequence_than_needed(ial: Cli) -> None:
    Path("nook.wkt").write_text("POLYGON ((0 0, 3 0, 3 2, 2 2, 2 3, 0 3, 0 0))")
    result = ial("bounce", "search-angle", "nook.wkt", "--headings", 8, "--sequence", 5)
    assert "no longer sequence was tried: one angle leaves no robot uncertain" in result.stdout


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--headings", "1"], "no bouncing angle can be chosen"),
        (["--headings", "360", "--sequence", "2"], "more than 20000 sequences"),
        (["--angle", "50"], "not a multiple of 45°"),
        (["--angle", "fifty"], "--angle"),
        (["--radius", "9"], "no cell is free"),
        (["--most-states", "5"], "more than 5 states"),
    ],
)
def test_bad_searches_are_refused(refused: Callable[..., str], hall: Path, options: list[str], message: str) -> None:
    assert message in refused("bounce", "search-angle", hall, *options)
