"""Tests of the embedded sample: it is what the script in the repository makes of MRPT's demo."""

from pathlib import Path

import numpy as np
import pytest

from ial.datasets.sample import make_sample, sample_grid, sample_map_path, sample_recording, sample_recording_path
from ial.datasets.scan import BeamClass
from ial.datasets.trajectory import read_tum
from ial.maps.grids.map_file import read_map


def test_the_sample_holds_the_demo(data_folder: Path) -> None:
    readings = list(sample_recording().readings())
    reference = read_tum(data_folder / "mrpt_malaga" / "pseudo_reference_map_demo.tum")
    assert [reading.stamp_ns for reading in readings] == reference.stamps_ns.tolist()
    with np.load(data_folder / "mrpt_malaga" / "log_for_map_demo.npz") as arrays:
        for reading, ranges, invalid, pose in zip(readings, arrays["ranges"], arrays["invalid"], arrays["odom"], strict=True):
            assert (reading.scan.ranges[~invalid] == ranges[~invalid]).all()
            assert (reading.scan.classes()[invalid] == BeamClass.NO_RETURN).all()
            at = reading.odometry.pose
            assert (at.x, at.y, at.theta) == pytest.approx(tuple(pose.tolist()), abs=1e-12)
            lower, upper = reading.scan.bearings()
            assert (lower <= arrays["angles"]).all()
            assert (arrays["angles"] <= upper).all()
    assert readings[0].scan.mounting.x == 0.78


def test_the_map_is_the_map_of_the_demo(data_folder: Path) -> None:
    original = read_map(data_folder / "mrpt_malaga" / "map_demo.yaml")
    grid = sample_grid()
    assert (grid.cells == original.cells).all()
    assert (grid.resolution, grid.origin) == (original.resolution, original.origin)


def test_the_script_makes_the_committed_recording(
    data_folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, canonical_steps
) -> None:  # type: ignore[no-untyped-def]
    from ial.datasets.opening import open_recording

    monkeypatch.setenv("IAL_DATA", str(data_folder))
    monkeypatch.setattr(make_sample, "sample_recording_path", lambda: tmp_path / "sample.mcap")
    monkeypatch.setattr(make_sample, "sample_map_path", lambda: tmp_path / "map.yaml")
    make_sample.main()
    assert canonical_steps(open_recording(tmp_path / "sample.mcap")) == canonical_steps(sample_recording())
    assert (read_map(tmp_path / "map.yaml").cells == sample_grid().cells).all()
    assert (tmp_path / "map.yaml").read_text() == sample_map_path().read_text()


def test_the_notice_lies_beside_it() -> None:
    notice = sample_recording_path().with_name("LICENSE-MRPT").read_text()
    assert "University of Malaga" in notice
    assert "Redistributions in binary form must reproduce" in notice
