import json
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from ial.compass.robot import CompassRobot
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


def test_a_file_that_proves_nothing_is_no_word_about_a_robot(refused: Callable[..., str], sequence: Path) -> None:
    """Signed anew: another end, and only the first motion with its own end, which one of the robots reaches."""
    right = read_sequence(sequence)
    write_sequence(replace(right, end=(right.end[0] + Fraction(1, 9), right.end[1])), "forged.json")
    robot = CompassRobot(right.polygon, (1, 1))
    short = replace(right, directions=right.directions[:1], sizes=right.sizes[:2], end=robot.drive(*right.directions[0]))
    write_sequence(short, "short.json")
    for name, said in (("forged.json", "which is not exactly that"), ("short.json", "more than one place at the end")):
        assert said in refused("compass", "run", name, "--start", "1,1")
        assert said in refused("compass", "show", name, "--out", "a.png")


def test_bad_starts_are_refused(refused: Callable[..., str], sequence: Path) -> None:
    assert "lies outside of the environment" in refused("compass", "run", sequence, "--start", "9,9")
    assert "give X,Y in metres" in refused("compass", "run", sequence, "--start", "1")
    assert "is no number" in refused("compass", "run", sequence, "--start", "1,x")
