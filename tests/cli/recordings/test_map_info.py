import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

Cli = Callable[..., Any]


def test_the_map_of_the_sample(ial: Cli, sample_map: Path) -> None:
    result = ial("map", "info", sample_map)
    assert (result.exit_code, result.stderr) == (0, "")
    for part in ("72.90 × 18.80 m, 1458 × 376 cells", "0.05 m per cell", "x -36.7 m, y -15.6 m, yaw 0 rad", "occupied    4012 cells"):
        assert part in result.stdout


def test_json(ial: Cli, room: Path) -> None:
    record = json.loads(ial("map", "info", room, "--json").stdout)
    assert (record["columns"], record["rows"], record["resolution_m"]) == (80, 60, 0.1)


def test_a_map_that_cannot_serve_is_described_all_the_same(ial: Cli, room: Path) -> None:
    room.with_suffix(".pgm").write_bytes(b"P5\n80 60\n255\n" + bytes([254]) * 4800)
    result = ial("map", "info", room)
    assert result.exit_code == 2
    assert "4800 cells" in result.stdout
    assert "no occupied cell" in result.stderr


def test_warnings_are_single_lines(ial: Cli, room: Path) -> None:
    room.write_text(room.read_text().replace("0.196", "0.25"))
    room.with_suffix(".pgm").write_bytes(b"P5\n80 60\n255\n" + bytes([205]) * 4700 + bytes(100))
    result = ial("map", "info", room)
    assert result.exit_code == 0
    (line,) = result.stderr.splitlines()
    assert line.startswith("warning: ")
    assert "free_thresh: 0.196" in line


def test_a_missing_map(refused: Callable[..., str]) -> None:
    assert "nowhere.yaml: the map does not exist; check the path" in refused("map", "info", "nowhere.yaml")
