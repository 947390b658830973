import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from ial.datasets.recording import Recording, steps
from ial.datasets.sample import sample_grid, sample_recording
from ial.errors import OutputError, RecordingError
from ial.lidar.checkpoint import Checkpoint, fingerprint
from ial.lidar.configuration.config import LocalizerConfig
from ial.lidar.localizer import Localizer
from ial.lidar.output_end import OutputEnd
from ial.lidar.run import localize


@pytest.fixture(scope="module")
def recording() -> Recording:
    return sample_recording()


@pytest.mark.slow
def test_a_run_goes_on_as_if_it_had_not_been_stopped(recording: Recording, tmp_path: Path) -> None:
    whole = list(localize(recording, Localizer(sample_grid()), start=1, every=3))
    first = Localizer(sample_grid())
    begun = list(localize(recording, first, start=1, stop=12, every=3))
    Checkpoint(begun[-1][0].mark, first.poses, OutputEnd("answers", 77, "ab", "é\n"), fingerprint(first)).save(tmp_path / "state")
    second = Localizer(sample_grid())
    checkpoint = Checkpoint.load(tmp_path / "state", second)
    assert checkpoint is not None
    assert checkpoint.output == OutputEnd("answers", 77, "ab", "é\n")
    second.resume(checkpoint.poses)
    ended = list(localize(recording, second, start=1, every=3, after=checkpoint.mark))
    assert [step.index for step, _ in (*begun, *ended)] == [step.index for step, _ in whole]
    for (_, one), (_, other) in zip((*begun, *ended), whole, strict=True):
        assert one.hypotheses == other.hypotheses
        for name in ("lower", "upper"):
            assert np.array_equal(getattr(one.poses.boxes, name), getattr(other.poses.boxes, name))
    assert list(tmp_path.iterdir()) == [tmp_path / "state"]


def test_every_part_of_the_set_is_kept(recording: Recording, tmp_path: Path) -> None:
    localizer = Localizer(sample_grid())
    step = next(steps(recording, localizer.config.bounds.motion))
    localizer.update(None, step.scan)
    poses = replace(localizer.poses, unconfirmed=np.arange(len(localizer.poses)) % 2 == 0, limited="time")
    Checkpoint(step.mark, poses, None, fingerprint(localizer)).save(tmp_path / "state")
    checkpoint = Checkpoint.load(tmp_path / "state", localizer)
    assert checkpoint is not None
    assert checkpoint.mark == step.mark
    for name in ("unconfirmed", "bad"):
        assert np.array_equal(getattr(checkpoint.poses, name), getattr(poses, name))
    assert (checkpoint.poses.limited, checkpoint.poses.outliers) == ("time", poses.outliers)


def test_without_a_file_there_is_no_checkpoint(tmp_path: Path) -> None:
    assert Checkpoint.load(tmp_path / "state", Localizer(sample_grid())) is None


def test_a_state_of_another_map_or_configuration_is_refused(recording: Recording, tmp_path: Path) -> None:
    localizer = Localizer(sample_grid())
    step, _ = next(localize(recording, localizer))
    Checkpoint(step.mark, localizer.poses, None, fingerprint(localizer)).save(tmp_path / "state")
    grid = sample_grid()
    cells = grid.cells.copy()
    cells[0, 0] = 1 - min(cells[0, 0], 1)
    for other in (Localizer(sample_grid(), config=LocalizerConfig(max_beams=179)), Localizer(replace(grid, cells=cells))):
        with pytest.raises(RecordingError, match="another map, configuration"):
            Checkpoint.load(tmp_path / "state", other)


@pytest.mark.parametrize("share", [0.0, 0.1, 0.5, 0.99])
def test_a_damaged_state_is_refused(share: float, recording: Recording, tmp_path: Path) -> None:
    localizer = Localizer(sample_grid())
    step, _ = next(localize(recording, localizer))
    path = tmp_path / "state"
    Checkpoint(step.mark, localizer.poses, None, fingerprint(localizer)).save(path)
    path.write_bytes(path.read_bytes()[: int(share * path.stat().st_size)])
    with pytest.raises(RecordingError, match="damaged"):
        Checkpoint.load(path, localizer)


def test_a_state_that_cannot_be_written_is_an_error(recording: Recording, tmp_path: Path) -> None:
    localizer = Localizer(sample_grid())
    step, _ = next(localize(recording, localizer))
    with pytest.raises(OutputError, match="cannot be written"):
        Checkpoint(step.mark, localizer.poses, None, "x").save(tmp_path / "nowhere" / "state")


@pytest.mark.parametrize("part", ["index", "unconfirmed", "bad", "fewer"])
def test_a_state_with_wrong_numbers_is_refused(part: str, recording: Recording, tmp_path: Path) -> None:
    localizer = Localizer(sample_grid())
    step, _ = next(localize(recording, localizer))
    path = tmp_path / "state"
    Checkpoint(step.mark, localizer.poses, None, fingerprint(localizer)).save(path)
    with np.load(path) as kept:
        content = dict(kept)
    if part == "index":
        about = json.loads(content["about"].tobytes()) | {"index": float("inf")}
        content["about"] = np.frombuffer(json.dumps(about).encode(), dtype=np.uint8)
    elif part == "fewer":
        content["unconfirmed"] = content["unconfirmed"][1:]
    else:
        content[part] = content[part].astype(np.float64)
    with path.open("wb") as file:
        np.savez(file, **content)
    with pytest.raises(RecordingError, match="damaged"):
        Checkpoint.load(path, localizer)
