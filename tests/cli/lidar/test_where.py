import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from ial.datasets.sample import sample_map_path
from ial.maps.grids.floor_plan import floor_plan
from ial.maps.grids.map_file import write_map


@pytest.fixture
def other() -> Path:
    path = Path("other.yaml")
    write_map(floor_plan(20.0, 15.0, 0.05, 1), path)
    return path


def test_the_map_of_the_sample_is_told_from_another(ial: Callable[..., Any], other: Path) -> None:
    result = ial("where", "--map", other, "--map", sample_map_path(), "--out", "where.jsonl", "--to", 6)
    assert result.exit_code == 0, result.stderr
    said = result.stdout.splitlines()
    assert said[0].startswith("in map, at x ")
    assert any(line.startswith("other: impossible since scan") for line in said)
    lines = [json.loads(line) for line in Path("where.jsonl").read_text().splitlines()]
    assert [line["index"] for line in lines] == list(range(6))
    assert lines[-1]["map"] == "map"
    assert lines[-1]["maps"]["other"] == []
    assert len(lines[-1]["maps"]["map"]) == 1


@pytest.mark.slow
def test_as_json_and_a_robot_that_is_in_none_of_the_maps(ial: Callable[..., Any], other: Path) -> None:
    result = ial("where", "--map", other, "--json", "--to", 4, "--set", "max_outliers=0.15")
    record = json.loads(result.stdout)
    assert record["map"] is None
    assert result.exit_code == 3


def test_what_is_refused(refused: Callable[..., str], other: Path) -> None:
    assert "once for each map" in refused("where")
    assert "given twice" in refused("where", "--map", other, "--map", other)
    assert "does not exist" in refused("where", "--map", "nowhere.yaml.bak")
    assert "no folder nowhere" in refused("where", "--map", other, "--out", "nowhere/a.jsonl")
