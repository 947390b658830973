"""`MapMetadata`: what the YAML file of a ROS map says."""

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, cast, get_args

import yaml

from ial.errors import MapError
from ial.maps.grids.occupancy_grid import check_resolution
from ial.pose import Pose, wrap

Mode = Literal["trinary", "scale", "raw"]
Semantics = Literal["nav2", "ros1"]

_LARGEST_FILE = 2**14  # bytes; a map's YAML file has some 200, and a hostile one of this size is read in a fraction of a second
_FALSE, _TRUE = ("0", "false", "no", "off"), ("1", "true", "yes", "on")


@dataclass(frozen=True)
class MapMetadata:
    """The content of a map's YAML file.

    Parameters
    ----------
    image
        The path of the image.
    resolution
        The width of a cell in metres.
    origin
        T_map_grid, the pose of the lower left corner.
    negate
        Whether white is occupied.
    free_thresh, occupied_thresh
        Thresholds on the occupancy, 0 <= free_thresh < occupied_thresh <= 1.
    mode
        What the pixels mean.
    """

    image: Path
    resolution: float
    origin: Pose
    negate: bool
    free_thresh: float
    occupied_thresh: float
    mode: Mode = "trinary"


def read_metadata(path: Path) -> MapMetadata:
    """Read a map's YAML file; keys that are not known are left alone.

    Raises
    ------
    MapError
        If the file is missing or not YAML, a key is missing or repeated, or a value is impossible.
    """
    try:
        return _parsed(_read_nodes(path), path.parent)
    except MapError as error:
        raise MapError(f"{path}: {error}") from error


def _read_nodes(path: Path) -> dict[str, yaml.Node]:
    """Return the values of the file as nodes: no value is constructed, so none can surprise (aliases, tags, dates, huge numbers)."""
    try:
        if not path.exists():
            raise MapError("the map does not exist; check the path")
        if not path.is_file():
            raise MapError("the map is not a file; give its YAML file")
        if path.stat().st_size > _LARGEST_FILE:
            raise MapError(f"the file has {path.stat().st_size} bytes, too many for the YAML file of a map; give that, not the image")
        text = path.read_bytes().decode("utf-8-sig")
        root = yaml.compose(text, Loader=yaml.SafeLoader)
    except UnicodeDecodeError as error:
        raise MapError("the file is not text; give the YAML file of the map, not its image") from error
    except (yaml.YAMLError, RecursionError) as error:
        raise MapError(f"the file is not YAML: {' '.join(str(error).split())}") from error
    except (OSError, ValueError) as error:  # ValueError: a path with a null character
        raise MapError(f"the map cannot be read: {error}") from error
    if not isinstance(root, yaml.MappingNode):
        raise MapError("the file holds no `key: value` lines; give the YAML file of a map")
    nodes: dict[str, yaml.Node] = {}
    for key, value in root.value:
        name = key.value if isinstance(key, yaml.ScalarNode) else ""
        if name in nodes:
            raise MapError(f"`{name}:` is there twice; keep one")
        nodes[name] = value
    return nodes


def _parsed(nodes: dict[str, yaml.Node], folder: Path) -> MapMetadata:
    image = _text(nodes, "image")
    if not image:
        raise MapError("`image:` is empty; give the path of the image, relative to this file")
    negate = _text(nodes, "negate").lower()
    if negate not in _FALSE + _TRUE:
        raise MapError(f"`negate: {negate}` is neither 0 nor 1")
    resolution = _number(_text(nodes, "resolution"), "resolution")
    check_resolution(resolution)
    free, occupied = (_number(_text(nodes, key), key) for key in ("free_thresh", "occupied_thresh"))
    if not 0.0 <= free < occupied <= 1.0:
        raise MapError(f"free_thresh is {free} and occupied_thresh {occupied}; 0 <= free_thresh < occupied_thresh <= 1 is needed")
    return MapMetadata(_image_path(image, folder), resolution, _origin(nodes), negate in _TRUE, free, occupied, _mode(nodes))


def _mode(nodes: dict[str, yaml.Node]) -> Mode:
    mode = _text(nodes, "mode") if "mode" in nodes else "trinary"
    for known in get_args(Mode):
        if mode == known:
            return cast(Mode, known)
    raise MapError(f"`mode: {mode}` is unknown; give trinary, scale or raw")


def _image_path(image: str, folder: Path) -> Path:
    try:
        return folder / Path(image).expanduser()
    except RuntimeError as error:  # no such user
        raise MapError(f"`image: {image}`: the home folder is not known; write the whole path") from error


def _origin(nodes: dict[str, yaml.Node]) -> Pose:
    node = _node(nodes, "origin")
    parts = [each.value for each in node.value if isinstance(each, yaml.ScalarNode)] if isinstance(node, yaml.SequenceNode) else []
    if len(parts) != 3 or len(node.value) != 3:
        raise MapError("`origin:` must be three numbers: [x, y, yaw] of the lower left corner, in metres and radians")
    x, y, yaw = (_number(part, "origin") for part in parts)
    return Pose(x, y, wrap(yaw))


def _node(nodes: dict[str, yaml.Node], key: str) -> yaml.Node:
    if key not in nodes:
        raise MapError(f"`{key}:` is missing; a map needs image, resolution, origin, negate, occupied_thresh and free_thresh")
    return nodes[key]


def _text(nodes: dict[str, yaml.Node], key: str) -> str:
    node = _node(nodes, key)
    if not isinstance(node, yaml.ScalarNode):
        raise MapError(f"`{key}:` must be a single value")
    return str(node.value)


def _number(text: str, key: str) -> float:
    try:
        number = float(text)
    except ValueError:
        raise MapError(f"`{key}: {text[:40]}` is not a number") from None
    if not math.isfinite(number):
        raise MapError(f"`{key}: {text[:40]}` is not a finite number")
    return number
