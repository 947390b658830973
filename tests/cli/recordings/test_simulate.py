import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Cli = Callable[..., Any]


@pytest.mark.slow
def test_a_simulated_run_is_localized_with_the_truth_inside(ial: Cli, room: Path) -> None:
    result = ial("simulate", "--map", room, "--out", "run.mcap", "--scans", 20, "--beams", 61, "--seed", 3, "--outliers", 3)
    assert (result.exit_code, result.stderr) == (0, "")
    assert result.stdout.splitlines()[0] == "20 scans written to run.mcap, the truth to run.tum"
    bounds = ["--set", "range_error_m=0.02", "--set", "bearing_error_rad=0.002", "--outliers", 3]
    command = result.stdout.splitlines()[1].split()[1:]
    localized = ial(*command, *bounds, "--out", "result", "--json")
    measures = json.loads(localized.stdout)["measures"]
    assert (measures["scans_with_reference"], measures["assumptions_hold"], measures["contained"]) == (20, 1.0, 1.0)


def test_the_same_seed_gives_the_same_bytes(ial: Cli, room: Path, tmp_path: Path) -> None:
    for name, seed in (("a", 1), ("b", 1), ("c", 2)):
        ial("simulate", "--map", room, "--out", f"{name}.mcap", "--scans", 5, "--seed", seed)
    a, b, c = ((tmp_path / f"{name}.tum").read_bytes() + (tmp_path / f"{name}.mcap").read_bytes() for name in "abc")
    assert a == b != c


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--map", "nowhere.yaml", "--out", "run.mcap"], "nowhere.yaml: the map does not exist"),
        (["--map", "room.yaml", "--out", "run.txt"], "must end in .mcap"),
        (["--map", "room.yaml", "--out", "run.mcap", "--step-m", "nan"], "--step-m is nan; give a finite number above 0"),
        (["--map", "room.yaml", "--out", "run.mcap", "--range-error-m", "-1"], "range_error_m is -1.0: give a finite number"),
    ],
)
def test_bad_input(refused: Callable[..., str], room: Path, options: list[str], message: str) -> None:
    assert room.exists()
    assert message in refused("simulate", *options)
