import json
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from ial.compass.sequence_file import read_sequence, write_sequence

Cli = Callable[..., Any]


@pytest.mark.parametrize("start", ["1,1", "0,0", "5/2,0", "0.125,3.5"])
def test_a_robot_ends_where_every_robot_ends(ial: Cli, sequence: Path, start: str) -> None:
    result = ial("compass", "run", sequence, "--start", start)
    assert result.exit_code == 0
    assert "localized: the robot is where every robot is after this sequence, exactly" in result.stdout
    planned = read_sequence(sequence)
    record = json.loads(ial("compass", "run", sequence, "--start", start, "--json").stdout)
    assert record["localized"]
    assert [step["direction"] for step in record["steps"]] == [[str(each) for each in direction] for direction in planned.directions]
    assert record["steps"][-1]["place_m"] == [float(each) for each in planned.end]
    assert len(result.stdout.splitlines()) == len(planned) + 1


def test_a_robot_that_ends_elsewhere_is_not_localized(ial: Cli, sequence: Path) -> None:
    right = read_sequence(sequence)
    write_sequence(replace(right, end=(right.end[0] + Fraction(1, 9), right.end[1])), "forged.json")
    result = ial("compass", "run", "forged.json", "--start", "1,1")
    assert result.exit_code == 3
    assert "not localized" in result.stdout


def test_bad_starts_are_refused(refused: Callable[..., str], sequence: Path) -> None:
    assert "lies outside of the environment" in refused("compass", "run", sequence, "--start", "9,9")
    assert "give X,Y in metres" in refused("compass", "run", sequence, "--start", "1")
    assert "is no number" in refused("compass", "run", sequence, "--start", "1,x")
