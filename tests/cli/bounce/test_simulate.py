import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.cli.bounce.hall import Cli


def test_simulate_writes_a_stream_that_run_reads(ial: Cli, hall: Path, built: Path) -> None:
    command = ("bounce", "simulate", hall, "--angle", 90, "--step", 1, "--seed", 4, "--steps", 30, "--out", "stream.txt")
    result = ial(*command, "--truth", "truth.csv")
    assert result.exit_code == 0
    assert re.fullmatch(r"30 observations, \d+ of them bumps, in stream.txt\nthe poses after them in truth.csv\n", result.stdout)
    lines = Path("truth.csv").read_text().splitlines()
    assert lines[0] == "observation,x_m,y_m,heading_deg"
    stream = Path("stream.txt").read_text()
    assert stream.strip() == "".join(line[0] for line in lines[1:])
    assert "after 30 observations" in ial("bounce", "run", built, "--file", "stream.txt").stdout
    assert ial(*command, "--overwrite").exit_code == 0
    assert Path("stream.txt").read_text() == stream


def test_simulate_starts_where_it_is_told(ial: Cli, hall: Path) -> None:
    ial("bounce", "simulate", hall, "--start", "1/2", "0.5", "0", "--steps", 9, "--out", "s.txt", "--truth", "t.csv", "--radius", "1/4")
    assert Path("s.txt").read_text() == "000000001\n"
    assert Path("t.csv").read_text().splitlines()[-1] == "1,8.75,0.5,90.0"


@pytest.mark.parametrize("kind", [("--angle", 90), ("--angle", 45, "--radius", "1/2"), ("--angle", 45, "--step", 2, "--headings", 16)])
def test_a_robot_of_cells_is_always_where_its_filter_says(ial: Cli, hall: Path, kind: tuple[object, ...]) -> None:
    assert ial("bounce", "build", hall, "--cell", "1/2", *kind, "--out", "f.npz").exit_code == 0
    localized = 0
    for seed in range(10):
        outputs = ("--seed", seed, "--steps", 120, "--out", "s.txt", "--truth", "t.csv", "--overwrite")
        assert ial("bounce", "simulate", hall, "--cell", "1/2", *kind, *outputs).exit_code == 0
        record = json.loads(ial("bounce", "run", "f.npz", "--file", "s.txt", "--json").stdout)
        assert record["rejected_at"] == []
        x, y, heading = map(float, Path("t.csv").read_text().splitlines()[-1].split(",")[1:])
        localized += record["localized"]
        if record["localized"]:
            assert (x, y, heading) in [(each["x_m"], each["y_m"], turn) for each in record["places"] for turn in each["headings_deg"]]
    assert localized > 5


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--turn-error", "190"], "error of a turn is 190°"),
        (["--step-error", "2"], "error of a step is 2 of its length"),
        (["--count-error", "-1"], "error of a count is -1"),
        (["--start", "2.5", "3", "0"], "cannot start at (2.5, 3)"),
        (["--step", "0"], "step is 0 m"),
        (["--angle", "0"], "multiple of 360°"),
        (["--angle", "x"], "--angle: 'x' is no number"),
        (["--radius", "5"], "no free place was found"),
        (["--headings", "4"], "are for a robot of cells; give --cell, too"),
        (["--rule", "inside"], "are for a robot of cells; give --cell, too"),
        (["--cell", "1", "--turn-error", "1"], "--log and errors are for robots with real geometry"),
        (["--cell", "1", "--log", "l.csv", "--speed", "1", "--clock-error", "1"], "--log and errors are for robots with real geometry"),
        (["--cell", "0"], "the width of a cell is 0"),
        (["--cell", "1", "--headings", "3"], "is not a multiple of 120°"),
        (["--cell", "1", "--start", "2.5", "3", "0"], "give a place in a free cell"),
    ],
)
def test_bad_simulations_are_refused(refused: Callable[..., str], hall: Path, options: list[str], message: str) -> None:
    assert message in refused("bounce", "simulate", hall, "--out", "s.txt", *options)


def test_nothing_that_is_read_is_overwritten_and_no_output_is_lost(refused: Callable[..., str], hall: Path, built: Path) -> None:
    read, filtered = hall.read_bytes(), built.read_bytes()
    assert "an input of the command" in refused("bounce", "build", hall, "--out", hall)
    assert "an input of the command" in refused("bounce", "show", built, hall, "--out", hall)
    assert "an input of the command" in refused("bounce", "show", built, "--out", built)
    assert "an input of the command" in refused("bounce", "simulate", hall, "--out", "s.txt", "--truth", hall)
    assert "written twice" in refused("bounce", "simulate", hall, "--out", "s.txt", "--truth", "s.txt")
    assert "no folder nowhere" in refused("bounce", "simulate", hall, "--out", "s.txt", "--truth", "nowhere/t.csv")
    for out in (".", "", "/"):
        assert "is a folder" in refused("bounce", "build", hall, "--out", out)
    assert (hall.read_bytes(), built.read_bytes()) == (read, filtered)
    assert not Path("s.txt").exists()
