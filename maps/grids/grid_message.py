"""Maps as messages: ``nav_msgs/OccupancyGrid`` of ROS 1 and ROS 2, read from bags by rosbags."""

import math
import warnings
from collections import deque
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ial.errors import MapError
from ial.maps.grids.map_warning import MapWarning
from ial.maps.grids.occupancy_class import classify_occupancy
from ial.maps.grids.occupancy_grid import UNKNOWN, OccupancyGrid, check_size
from ial.pose import Pose

MESSAGE_TYPE = "nav_msgs/msg/OccupancyGrid"
LARGEST_TILT_RAD = math.radians(2.0)

_VALUES = np.array([0, 100, -1], dtype=np.int8)  # of free, occupied, unknown


def grid_from_message(message: Any, free_thresh: float = 0.196, occupied_thresh: float = 0.65) -> OccupancyGrid:
    """Return the map in a message.

    A value of 0 to 100 is the occupancy in percent and becomes free, occupied or unknown by the thresholds, as if the map had been saved
    by nav2's map saver and read again; every other value is unknown.

    The resolution of a message is a float32, and the double of that very number is used: 0.05 m arrives as 0.0500000007 m. The guarantee
    refers to the map that the message states. Where its author meant 0.05, a wall at distance d from the map's corner is off by at most
    2**-24·d (6 µm at 100 m), which belongs into ``map_error_m``; rounding to a guessed decimal would be wrong for resolutions that
    are not short decimals.

    Parameters
    ----------
    message
        Anything with the fields of ``nav_msgs/OccupancyGrid``.
    free_thresh, occupied_thresh
        Thresholds on the occupancy, 0 <= free_thresh < occupied_thresh <= 1.

    Raises
    ------
    MapError
        If the size does not match the data, or resolution, origin or thresholds are impossible.

    Warns
    -----
    MapWarning
        If the rotation of the origin was left at zero; it is taken as no rotation.
    """
    if not 0.0 <= free_thresh < occupied_thresh <= 1.0:
        raise MapError(f"the thresholds are {free_thresh} and {occupied_thresh}; 0 <= free_thresh < occupied_thresh <= 1 is needed")
    info = message.info
    rows, columns = int(info.height), int(info.width)
    check_size(rows, columns)
    values = np.asarray(message.data, dtype=np.int8).reshape(-1)
    if len(values) != rows * columns:
        raise MapError(f"the map message announces {columns} × {rows} cells and holds {len(values)}; record it again")
    table = classify_occupancy(np.arange(256) / 100, free_thresh, occupied_thresh)
    table[101:] = UNKNOWN  # the negative values, as bytes, are among these
    cells = table[values.view(np.uint8)].reshape(rows, columns)
    return OccupancyGrid(cells, float(info.resolution), _origin(info.origin))


def _origin(pose: Any) -> Pose:
    at, turn = pose.position, pose.orientation
    x, y, z, w = float(turn.x), float(turn.y), float(turn.z), float(turn.w)
    length = math.hypot(x, y, z, w)
    if not math.isfinite(length):
        raise MapError(f"the origin of the map message is rotated by the quaternion ({x}, {y}, {z}, {w}); its numbers must be finite")
    if length == 0.0:
        warnings.warn("the rotation of the map's origin was left at zero; it is taken as no rotation", MapWarning, stacklevel=3)
        return Pose(float(at.x), float(at.y), 0.0)
    tilt = 2.0 * math.asin(min(1.0, math.hypot(x, y) / length))
    if tilt > LARGEST_TILT_RAD:
        raise MapError(f"the map of the message is tilted by {math.degrees(tilt):.1f}°; only maps that lie flat are supported")
    return Pose.from_quaternion(float(at.x), float(at.y), z, w)


class GridFields(NamedTuple):
    """The content of a ``nav_msgs/OccupancyGrid`` message, apart from its header."""

    resolution: float
    width: int
    height: int
    position: tuple[float, float, float]
    orientation: tuple[float, float, float, float]
    data: npt.NDArray[np.int8]


def grid_to_message_fields(grid: OccupancyGrid) -> GridFields:
    """Return what a message of this map holds: values 0 (free), 100 (occupied), -1 (unknown), row 0 first.

    A message rounds the resolution to float32.
    """
    z, w = grid.origin.quaternion()
    data = _VALUES[grid.cells].reshape(-1)
    return GridFields(grid.resolution, grid.columns, grid.rows, (grid.origin.x, grid.origin.y, 0.0), (0.0, 0.0, z, w), data)


def read_map_topic(path: str | Path, topic: str | None = None) -> OccupancyGrid:
    """Read a map from a bag: the last message of a topic, since a map grows while it is being built.

    Parameters
    ----------
    path
        A ROS 1 ``.bag``, a ROS 2 folder, a ``.db3`` or a ``.mcap``.
    topic
        The topic; None for the only one that carries maps, or the one called ``/map`` where there are several (costmaps are maps, too).

    Raises
    ------
    MapError
        If the bag is missing or damaged, or holds no map, or several and none was named.
    """
    from rosbags.highlevel import AnyReader
    from rosbags.typesys import Stores, get_typestore

    path = Path(path)
    if not path.exists():
        raise MapError(f"{path}: the recording does not exist; check the path")
    try:
        with AnyReader([path], default_typestore=get_typestore(Stores.LATEST)) as reader:
            connections = [each for each in reader.connections if each.msgtype == MESSAGE_TYPE]
            topic = _chosen_topic(sorted({each.topic for each in connections}), topic)
            last = deque(reader.messages([each for each in connections if each.topic == topic]), maxlen=1)
            if not last:
                raise MapError(f"topic {topic} holds no message; name another topic, or another recording")
            connection, _, content = last[0]
            return grid_from_message(reader.deserialize(content, connection.msgtype))
    except MapError as error:
        raise MapError(f"{path}: {error}") from error
    except MapWarning:  # made an error by a filter
        raise
    except Exception as error:  # a damaged bag surfaces as almost any error of the reader and of what it is built on
        raise MapError(f"{path}: the recording cannot be read ({type(error).__name__}: {error}); record or download it again") from error


def _chosen_topic(topics: list[str], topic: str | None) -> str:
    if not topics:
        raise MapError(f"no topic carries a map ({MESSAGE_TYPE}); give a map file, or another recording")
    if topic is not None and topic not in topics:
        raise MapError(f"topic {topic} carries no map; these do: {', '.join(topics)}")
    if topic is None and len(topics) > 1 and "/map" not in topics:
        raise MapError(f"several topics carry maps; name one of {', '.join(topics)}")
    return topic or (topics[0] if len(topics) == 1 else "/map")
