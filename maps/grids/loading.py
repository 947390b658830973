"""`load_map`: a map from whatever file holds one."""

from pathlib import Path

from ial.errors import MapError
from ial.maps.grids.map_metadata import Semantics
from ial.maps.grids.occupancy_grid import OccupancyGrid


def load_map(path: str | Path, semantics: Semantics = "nav2", topic: str | None = None) -> OccupancyGrid:
    """Read a map from a YAML file with an image beside it, or from a topic of a recording; the name of the file tells which.

    Parameters
    ----------
    path
        A ``.yaml`` or ``.yml`` file; or a ``.bag``, ``.db3``, ``.mcap`` or the folder of a ROS 2 recording.
    semantics
        The rules of a map file, see `read_map`.
    topic
        The topic of a recording, see `read_map_topic`.

    Raises
    ------
    MapError
        If the file is missing, damaged or of another kind.
    """
    path = Path(path)
    if path.suffix in (".yaml", ".yml"):
        from ial.maps.grids.map_file import read_map

        return read_map(path, semantics)
    if path.suffix in (".bag", ".db3", ".mcap") or path.is_dir():
        from ial.maps.grids.grid_message import read_map_topic

        return read_map_topic(path, topic)
    if not path.exists():
        raise MapError(f"{path}: the map does not exist; check the path")
    raise MapError(f"{path}: this is no map; give the .yaml file beside the image, or a recording (.bag, .db3, .mcap, a ROS 2 folder)")
