import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ial.cli.config_file import resolve
from ial.datasets.sample import sample_map_path


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


def test_against_a_reference(ial: Callable[..., Any]) -> None:
    ial("simulate", "--map", sample_map_path(), "--out", "run.mcap", "--seed", 1, "--scans", 6)
    result = ial("bounds", "run.mcap", "--map", sample_map_path(), "--truth", "run.tum", "--out", "found", "--json")
    record = json.loads(result.stdout)
    assert (record["circular"], record["scans"], record["motion"]["held"]) == (False, 6, 1.0)


def test_what_is_refused(refused: Callable[..., str], sample: Path) -> None:
    assert "give --map" in refused("bounds", sample)
    Path("far.tum").write_text("1.0 0 0 0 0 0 0 1\n")
    assert "do not meet those of the scans" in refused("bounds", sample, "--map", sample_map_path(), "--truth", "far.tum", "--out", "b")
