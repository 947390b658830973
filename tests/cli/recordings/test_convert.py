from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from ial.datasets.opening import open_recording
from ial.results.lidar.enclosures import read_enclosures

Cli = Callable[..., Any]


@pytest.mark.slow
@pytest.mark.parametrize("suffix", ["mcap", "bag"])
def test_a_converted_recording_gives_the_same_enclosures(ial: Cli, sample: Path, sample_map: Path, tmp_path: Path, suffix: str) -> None:
    result = ial("convert", sample, f"copy.{suffix}")
    assert (result.exit_code, result.stdout) == (0, f"37 scans written to copy.{suffix}\n")
    ial("localize", sample, "--map", sample_map, "--out", "first", "--to", 3)
    ial("localize", f"copy.{suffix}", "--map", sample_map, "--out", "second", "--to", 3)
    first, second = (list(read_enclosures(tmp_path / run / "enclosures.jsonl")) for run in ("first", "second"))
    assert [(each.stamp_ns, each.hypotheses) for each in first] == [(each.stamp_ns, each.hypotheses) for each in second]


def test_a_mounting_from_the_command_line_is_written(ial: Cli, sample: Path) -> None:
    ial("convert", sample, "copy.mcap", "--laser-pose", 0.1, -0.2, 0.3)
    mounting = next(open_recording("copy.mcap").readings()).scan.mounting
    assert (mounting.x, mounting.y, mounting.yaw) == (0.1, -0.2, pytest.approx(0.3))


@pytest.mark.parametrize(("target", "message"), [("copy.txt", "must end in .mcap"), ("nowhere/copy.bag", "choose another folder")])
def test_a_target_that_cannot_be(refused: Callable[..., str], sample: Path, target: str, message: str) -> None:
    assert message in refused("convert", sample, target)


def test_a_recording_is_not_written_over_itself(ial: Cli, refused: Callable[..., str], sample: Path) -> None:
    ial("convert", sample, "copy.mcap")
    before = Path("copy.mcap").read_bytes()
    assert "an input of the command" in refused("convert", "copy.mcap", "copy.mcap", "--overwrite")
    assert Path("copy.mcap").read_bytes() == before


def test_skipped_scans_are_told(ial: Cli, bag: Any) -> None:
    assert ial("convert", bag.write(), "copy.bag").stderr == ""
    assert "no scan can be used: 3 × " in ial("convert", bag.write(ranges=[]), "none.bag").stderr
