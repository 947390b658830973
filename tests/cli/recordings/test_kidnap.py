from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from ial.datasets.opening import open_recording
from ial.datasets.trajectory import read_tum


@pytest.mark.slow
def test_a_kidnapped_recording_and_its_reference_are_written(ial: Callable[..., Any], sample: Path, tmp_path: Path) -> None:
    ial("localize", "--out", "run")
    result = ial("kidnap", sample, "carried.mcap", "--at", "10:25", "--at", "30:3", "--truth", tmp_path / "run" / "trajectory.tum")
    assert "51 scans written to carried.mcap, 2 kidnappings" in result.stdout
    assert len(list(open_recording(tmp_path / "carried.mcap").readings())) == 51
    assert len(read_tum(tmp_path / "carried.tum")) == 51


@pytest.mark.parametrize(
    ("at", "message"), [("10", "give two numbers of scans"), ("a:3", "give two numbers of scans"), ("10:11", "follows scan 10 anyway")]
)
def test_a_jump_that_makes_no_sense_is_refused(refused: Callable[..., str], sample: Path, at: str, message: str) -> None:
    assert message in refused("kidnap", sample, "carried.mcap", "--at", at)


@pytest.mark.slow
def test_the_reference_is_never_replaced(ial: Callable[..., Any], refused: Callable[..., str], sample: Path, tmp_path: Path) -> None:
    ial("localize", "--out", "run")
    truth = tmp_path / "run" / "trajectory.tum"
    before = truth.read_bytes()
    command = ("kidnap", sample, truth.with_suffix(".mcap"), "--at", "10:25", "--truth", truth)
    assert "an input of the command" in refused(*command, "--overwrite")
    assert truth.read_bytes() == before
