"""Maps in messages and bags, of ROS 1 and ROS 2."""

import math
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from rosbags.typesys import Stores, get_typestore

from ial.errors import MapError
from ial.maps.grids.grid_message import MESSAGE_TYPE, grid_from_message, grid_to_message_fields, read_map_topic
from ial.maps.grids.map_warning import MapWarning
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, UNKNOWN, OccupancyGrid
from ial.pose import Pose

GRID = OccupancyGrid(np.random.default_rng(11).integers(0, 3, (5, 7), dtype=np.uint8), 0.5, Pose(-1.5, 2.25, 0.75))


def plain(**changes: Any) -> SimpleNamespace:
    """Return something with the fields of a message: 3 × 2 cells, unless changed."""
    values: dict[str, Any] = {
        "width": 3,
        "height": 2,
        "resolution": np.float32(0.05),
        "data": np.array([0, 19, 20, 64, 65, 100], np.int8),
        "at": (1.0, 2.0, 0.0),
        "turn": (0.0, 0.0, 0.0, 1.0),
        **changes,
    }
    position = SimpleNamespace(**dict(zip("xyz", values["at"], strict=True)))
    orientation = SimpleNamespace(**dict(zip("xyzw", values["turn"], strict=True)))
    origin = SimpleNamespace(position=position, orientation=orientation)
    info = SimpleNamespace(width=values["width"], height=values["height"], resolution=values["resolution"], origin=origin)
    return SimpleNamespace(info=info, data=values["data"])


def test_values_become_classes_by_the_thresholds() -> None:
    grid = grid_from_message(plain())
    assert grid.cells.tolist() == [[FREE, FREE, UNKNOWN], [UNKNOWN, OCCUPIED, OCCUPIED]]
    grid = grid_from_message(plain(), free_thresh=0.0, occupied_thresh=1.0)
    assert grid.cells.tolist() == [[FREE, UNKNOWN, UNKNOWN], [UNKNOWN, UNKNOWN, OCCUPIED]]


def test_values_that_are_no_percentage_are_unknown() -> None:
    grid = grid_from_message(plain(data=np.array([-1, -128, 101, 127, -100, 0], np.int8)))
    assert grid.cells.tolist() == [[UNKNOWN] * 3, [UNKNOWN, UNKNOWN, FREE]]


def test_the_resolution_is_the_double_of_the_float32() -> None:
    assert grid_from_message(plain()).resolution == 0.05000000074505806


def test_the_origin_may_be_rotated() -> None:
    origin = grid_from_message(plain(turn=(0.0, 0.0, math.sin(0.4), math.cos(0.4)))).origin
    assert (origin.x, origin.y) == (1.0, 2.0)
    assert origin.theta == pytest.approx(0.8, abs=1e-15)
    scaled = grid_from_message(plain(turn=(0.0, 0.0, -3 * math.sin(0.4), -3 * math.cos(0.4)))).origin
    assert scaled.theta == pytest.approx(0.8, abs=1e-15)


def test_a_rotation_left_at_zero_is_warned_about() -> None:
    with pytest.warns(MapWarning, match="left at zero"):
        grid = grid_from_message(plain(turn=(0.0, 0.0, 0.0, 0.0)))
    assert grid.origin == Pose(1.0, 2.0, 0.0)


@pytest.mark.parametrize(
    ("changes", "text"),
    [
        ({"width": 4}, "announces 4 × 2 cells and holds 6"),
        ({"width": 0, "data": np.empty(0, np.int8)}, "0 × 2 cells"),
        ({"width": 2**32 - 1}, "per side"),
        ({"resolution": np.float32(0.0)}, "resolution"),
        ({"resolution": np.float32(np.nan)}, "resolution"),
        ({"at": (math.nan, 0.0, 0.0)}, "origin"),
        ({"turn": (0.0, 0.0, math.nan, 1.0)}, "finite"),
        ({"turn": (math.sin(0.1), 0.0, 0.0, math.cos(0.1))}, r"tilted by 11\.5°"),
    ],
)
def test_impossible_messages_are_refused(changes: dict[str, Any], text: str) -> None:
    with pytest.raises(MapError, match=text):
        grid_from_message(plain(**changes))


@pytest.mark.parametrize("thresholds", [(0.7, 0.6), (-0.1, 0.6), (0.1, 1.1), (math.nan, 0.5)])
def test_impossible_thresholds_are_refused(thresholds: tuple[float, float]) -> None:
    with pytest.raises(MapError, match="thresholds"):
        grid_from_message(plain(), *thresholds)


def message(store: Any, grid: OccupancyGrid, ros1: bool) -> Any:
    types = store.types
    fields = grid_to_message_fields(grid)
    time = types["builtin_interfaces/msg/Time"](sec=1, nanosec=2)
    header = types["std_msgs/msg/Header"](**({"seq": 0} if ros1 else {}), stamp=time, frame_id="map")
    pose = types["geometry_msgs/msg/Pose"](
        position=types["geometry_msgs/msg/Point"](*fields.position), orientation=types["geometry_msgs/msg/Quaternion"](*fields.orientation)
    )
    info = types["nav_msgs/msg/MapMetaData"](
        map_load_time=time, resolution=fields.resolution, width=fields.width, height=fields.height, origin=pose
    )
    return types[MESSAGE_TYPE](header=header, info=info, data=fields.data)


def write_bag(path: Path, kind: str, topics: list[tuple[str, OccupancyGrid]]) -> Path:
    """Write one message for each pair of topic and map, in order; return the path to read."""
    ros1 = kind == "bag"
    store = get_typestore(Stores.ROS1_NOETIC if ros1 else Stores.LATEST)
    plugin = StoragePlugin.MCAP if kind == "mcap" else StoragePlugin.SQLITE3
    writer: Any = Writer1(path) if ros1 else Writer2(path, version=9, storage_plugin=plugin)
    with writer:
        connections = {topic: writer.add_connection(topic, MESSAGE_TYPE, typestore=store) for topic in dict(topics)}
        text = writer.add_connection("/chatter", "std_msgs/msg/String", typestore=store)
        said = store.types["std_msgs/msg/String"](data="hello")
        serialize = store.serialize_ros1 if ros1 else store.serialize_cdr
        writer.write(text, 5, serialize(said, "std_msgs/msg/String"))
        for stamp, (topic, grid) in enumerate(topics):
            writer.write(connections[topic], stamp, serialize(message(store, grid, ros1), MESSAGE_TYPE))
    return path


def same(one: OccupancyGrid, other: OccupancyGrid) -> bool:
    return bool((one.cells == other.cells).all()) and one.resolution == other.resolution


@pytest.mark.parametrize("kind", ["bag", "db3", "mcap"])
def test_a_map_goes_through_a_bag(tmp_path: Path, kind: str) -> None:
    path = write_bag(tmp_path / ("map.bag" if kind == "bag" else "map"), kind, [("/some/map", GRID)])
    grid = read_map_topic(path)
    assert same(grid, GRID)
    assert (grid.origin.x, grid.origin.y) == (-1.5, 2.25)
    assert grid.origin.theta == pytest.approx(0.75, abs=1e-15)
    if kind != "bag":
        assert same(read_map_topic(next(path.glob(f"*.{kind}"))), GRID)


def test_the_last_message_counts(tmp_path: Path) -> None:
    early = OccupancyGrid(np.zeros((1, 1), np.uint8), 0.5)
    assert same(read_map_topic(write_bag(tmp_path / "map.bag", "bag", [("/map", early), ("/map", GRID)])), GRID)


def test_the_topic_is_named_or_called_map_or_the_only_one(tmp_path: Path) -> None:
    costmap = OccupancyGrid(np.zeros((1, 1), np.uint8), 0.5)
    several = write_bag(tmp_path / "one.bag", "bag", [("/costmap", costmap), ("/map", GRID), ("/zone", costmap)])
    assert same(read_map_topic(several), GRID)
    assert same(read_map_topic(several, "/costmap"), costmap)
    with pytest.raises(MapError, match="/costmap, /map, /zone"):
        read_map_topic(several, "/chatter")
    unclear = write_bag(tmp_path / "two.bag", "bag", [("/costmap", costmap), ("/plan", GRID)])
    with pytest.raises(MapError, match="name one of /costmap, /plan"):
        read_map_topic(unclear)
    with pytest.raises(MapError, match="no topic carries a map"):
        read_map_topic(write_bag(tmp_path / "none.bag", "bag", []))


def test_damaged_and_missing_bags_are_refused_with_their_path(tmp_path: Path) -> None:
    with pytest.raises(MapError, match="does not exist"):
        read_map_topic(tmp_path / "nowhere.bag")
    whole = write_bag(tmp_path / "whole.bag", "bag", [("/map", GRID)]).read_bytes()
    folder = write_bag(tmp_path / "folder", "mcap", [("/map", GRID)])
    recording = next(folder.glob("*.mcap")).read_bytes()
    for name, content in (("cut.bag", whole), ("cut.mcap", recording)):
        file = tmp_path / name
        for length in (0, 10, len(content) // 3, len(content) // 2, len(content) - 20):
            file.write_bytes(content[:length])
            with pytest.raises(MapError, match="cannot be read") as caught:
                read_map_topic(file)
            assert str(file) in str(caught.value)
    (tmp_path / "other.db3").write_bytes(b"no database")
    (tmp_path / "empty").mkdir()
    for name in ("other.db3", "empty"):
        with pytest.raises(MapError, match="cannot be read"):
            read_map_topic(tmp_path / name)
