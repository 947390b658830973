"""`load_map` chooses the reader by the name."""

from pathlib import Path

import numpy as np
import pytest

from ial.errors import MapError
from ial.maps import load_map
from ial.maps.grids import grid_message, map_file
from ial.maps.grids.occupancy_grid import OccupancyGrid

GRID = OccupancyGrid(np.array([[0, 1, 2]], np.uint8), 0.5)


@pytest.mark.parametrize("name", ["map.yaml", "map.yml"])
def test_map_files(tmp_path: Path, name: str) -> None:
    map_file.write_map(GRID, tmp_path / name)
    assert load_map(str(tmp_path / name)).cells.tolist() == GRID.cells.tolist()


@pytest.mark.parametrize("name", ["run.bag", "run.db3", "run.mcap", "folder"])
def test_recordings(tmp_path: Path, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[object] = []
    monkeypatch.setattr(grid_message, "read_map_topic", lambda *arguments: asked.append(arguments) or GRID)
    path = tmp_path / name
    if name == "folder":
        path.mkdir()
    assert load_map(path, topic="/map") is GRID
    assert asked == [(path, "/map")]


def test_semantics_reach_the_map_file(tmp_path: Path) -> None:
    map_file.write_map(GRID, tmp_path / "map.yaml")
    with pytest.raises(MapError, match="'nav2' or 'ros1'"):
        load_map(tmp_path / "map.yaml", "ros9")  # type: ignore[arg-type]


def test_other_files_are_refused(tmp_path: Path) -> None:
    (tmp_path / "map.pgm").write_bytes(b"P5 1 1 255 x")
    with pytest.raises(MapError, match=r"\.yaml file beside the image"):
        load_map(tmp_path / "map.pgm")
    for name in ("nowhere", "nowhere.yaml", "nowhere.bag"):
        with pytest.raises(MapError, match="does not exist"):
            load_map(tmp_path / name)
