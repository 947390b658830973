"""`ial explore --compare`."""

import csv
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any, get_args

import pytest

from ial.cli.active.comparison import COLUMNS, FILES
from ial.cli.active.options import PlannerName

Cli = Callable[..., Any]
Refused = Callable[..., str]
RING = ("explore", "--compare", "--map", "plan:ring", "--starts", 2, "--seed", 1, "--drives", 3)


@pytest.mark.slow
def test_every_planner_drives_from_the_same_starts(ial: Cli) -> None:
    result = ial(*RING, "--out", "compared")
    assert result.exit_code == 0
    head, *lines, medians, last = result.stdout.splitlines()
    assert head.split()[:3] == ["planner", "localized", "symmetric"]
    assert [line.split()[0] for line in lines] == list(get_args(PlannerName))
    assert all(sum(map(int, line.split()[1:5])) == 2 for line in lines)
    assert medians == "medians of 10 runs; the set did not hold the truth after 0 scans; 0 collisions"
    assert last == "results in compared"
    assert sorted(file.name for file in Path("compared").iterdir()) == sorted(FILES)
    with Path("compared/comparison.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert tuple(rows[0]) == COLUMNS
    assert [(row["start"], row["planner"]) for row in rows] == [(start, name) for start in "12" for name in get_args(PlannerName)]
    record = json.loads(Path("compared/summary.json").read_text())
    assert [str(each["drives"]) for each in record["runs"]] == [row["drives"] for row in rows]
    again = json.loads(ial(*RING, "--out", "again", "--json").stdout)
    kept = [key for key in COLUMNS if key != "decided_ms"]
    assert [[each[key] for key in kept] for each in again["runs"]] == [[each[key] for key in kept] for each in record["runs"]]


def test_what_is_not_compared(refused: Refused) -> None:
    assert "--start, --raw: not with --compare" in refused("explore", "--compare", "--start", 1, 1, 0, "--raw")
    assert "--planner: not with --compare" in refused("explore", "--compare", "--planner", "random")
    assert "--starts is 0" in refused("explore", "--compare", "--starts", 0)
    assert "--drives is -1" in refused("explore", "--compare", "--drives", -1)
    assert "--starts needs --compare" in refused("explore", "--starts", 3)
