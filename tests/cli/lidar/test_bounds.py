import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from ial.cli.lidar.config_file import resolve
from ial.datasets.sample import sample_map_path
from ial.lidar.configuration.config import LocalizerConfig


@pytest.mark.slow
def test_bounds_of_the_sample_are_measured_and_suggested(ial: Callable[..., Any]) -> None:
    result = ial("bounds", "--out", "found", "--to", 12)
    assert result.exit_code == 0, result.stderr
    assert "circular" in result.stdout
    assert "the motion bounds hold in" in result.stdout
    assert sorted(path.name for path in Path("found").iterdir()) == ["bounds.json", "config.yaml", "failures.npz", "picture.png"]
    record = json.loads(Path("found/bounds.json").read_text())
    assert record["circular"] is True
    suggested = resolve(Path("found/config.yaml"), environment={})
    assert suggested.bounds.map_error_m == record["suggestion"]["map_error_m"]
    assert ial("localize", "--config", "found/config.yaml", "--to", 2, "--out", "run").exit_code in (0, 3)


@pytest.mark.slow
def test_against_a_reference(ial: Callable[..., Any]) -> None:
    ial("simulate", "--map", sample_map_path(), "--out", "run.mcap", "--seed", 1, "--scans", 6)
    result = ial("bounds", "run.mcap", "--map", sample_map_path(), "--truth", "run.tum", "--out", "found", "--json")
    record = json.loads(result.stdout)
    assert (record["circular"], record["scans"], record["motion"]["held"]) == (False, 6, 1.0)


def test_what_is_refused(refused: Callable[..., str], sample: Path) -> None:
    assert "give --map" in refused("bounds", sample)
    Path("far.tum").write_text("1.0 0 0 0 0 0 0 1\n")
    assert "do not meet those of the scans" in refused("bounds", sample, "--map", sample_map_path(), "--truth", "far.tum", "--out", "b")


@pytest.mark.slow
def test_motion_is_measured_from_each_scan_to_the_next_and_beams_where_wanted(ial: Callable[..., Any]) -> None:
    ial("simulate", "--map", sample_map_path(), "--out", "run.mcap", "--seed", 1, "--scans", 9)
    given = ("bounds", "run.mcap", "--map", sample_map_path(), "--every", 4, "--json")
    record = json.loads(ial(*given, "--truth", "run.tum", "--out", "true").stdout)
    assert (record["scans"], record["steps_of"], record["motion"]["steps"]) == (3, 1, 8)
    own = ial(*given[:-1], "--out", "own")
    assert json.loads(Path("own/bounds.json").read_text())["steps_of"] == 4
    assert "over steps of 4 scans" in own.stderr


@pytest.mark.slow
def test_a_reference_of_another_place_is_doubted(ial: Callable[..., Any]) -> None:
    ial("simulate", "--map", sample_map_path(), "--out", "run.mcap", "--seed", 1, "--scans", 6)
    moved = [line.split() for line in Path("run.tum").read_text().splitlines() if not line.startswith("#")]
    Path("far.tum").write_text("".join(f"{row[0]} {float(row[1]) + 3.0} {float(row[2]) + 2.0} {' '.join(row[3:])}\n" for row in moved))
    fits = ial("bounds", "run.mcap", "--map", sample_map_path(), "--truth", "run.tum", "--out", "fits")
    far = ial("bounds", "run.mcap", "--map", sample_map_path(), "--truth", "far.tum", "--out", "far")
    assert "probably does not belong" in far.stderr
    assert "probably does not belong" not in fits.stderr
    # No total that is tried explains beams that far away, and 0.3 m would be of no use.
    assert "no bound that was tried leaves at most 10% of the beams bad in 95% of the scans (0.3 m, the largest, in 0.0%)" in far.stderr
    assert "no bound that was tried" not in fits.stderr
    assert "so that 99 % of these steps hold" in far.stdout
    suggested, default = resolve(Path("far/config.yaml"), environment={}), LocalizerConfig()
    assert suggested.max_outliers == default.max_outliers
    assert suggested.bounds.map_error_m == default.bounds.map_error_m
