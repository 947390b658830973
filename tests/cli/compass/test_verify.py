import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from ial.compass.sequence_file import read_sequence, write_sequence

Cli = Callable[..., Any]


def test_a_sequence_is_proved(ial: Cli, sequence: Path, room_l: Path) -> None:
    steps = len(read_sequence(sequence))
    result = ial("compass", "verify", sequence)
    assert result.exit_code == 0
    assert f"proved: after {steps} motions a robot is at x " in result.stdout
    assert ial("compass", "verify", sequence, room_l).stdout == result.stdout
    assert json.loads(ial("compass", "verify", sequence, "--json").stdout)["motions"] == steps


def test_a_file_that_was_changed_is_refused_at_its_step(refused: Callable[..., str], sequence: Path) -> None:
    content = json.loads(sequence.read_text())
    content["steps"][1]["direction"] = ["7", "5"]
    Path("changed.json").write_text(json.dumps(content))
    assert "changed.json: step 2: it was changed" in refused("compass", "verify", "changed.json")
    assert "changed.json: step 2: it was changed" in refused("compass", "run", "changed.json", "--start", "1,1")


def test_a_sequence_that_is_wrong_is_refused_at_its_step(refused: Callable[..., str], sequence: Path) -> None:
    """Signed anew, so that only the geometry can tell."""
    right = read_sequence(sequence)
    (x, y), *others = right.directions
    write_sequence(replace(right, directions=((-x, -y), *others)), "forged.json")
    assert "forged.json: step 1: " in refused("compass", "verify", "forged.json")


def test_an_end_beyond_all_doubles_is_refused_in_a_line(refused: Callable[..., str], sequence: Path) -> None:
    right = read_sequence(sequence)
    write_sequence(replace(right, end=(-(10**400), right.end[1])), "far.json")
    assert "the end that is claimed is (-1e400 or so, " in refused("compass", "verify", "far.json")


def test_it_does_not_matter_at_which_corner_a_ring_begins(ial: Cli, sequence: Path) -> None:
    (*corners,) = read_sequence(sequence).polygon.outer
    text = ", ".join(f"{x} {y}" for x, y in [*corners[2:], *corners[:3]])
    Path("turned.wkt").write_text(f"POLYGON (({text}))")
    assert ial("compass", "verify", sequence, "turned.wkt").exit_code == 0


def test_a_sequence_of_another_environment_is_refused(refused: Callable[..., str], sequence: Path) -> None:
    Path("other.wkt").write_text("POLYGON ((0 0, 5 0, 5 2, 2 2, 1 4, 0 4, 0 0))")
    assert "step 0: the sequence is one of another environment than other.wkt" in refused("compass", "verify", sequence, "other.wkt")


def test_what_is_no_sequence_is_refused(refused: Callable[..., str], room_l: Path) -> None:
    assert "cannot be read" in refused("compass", "verify", "nowhere.json")
    assert "not JSON" in refused("compass", "verify", room_l)
