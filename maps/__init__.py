"""Maps: occupancy grids, their files and messages, contractors to their cells, ray casting, and polygons with holes."""

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ial.maps.cell_contractor import CellContractor
    from ial.maps.cell_index import CellIndex
    from ial.maps.environment import Environment, load_environment
    from ial.maps.erosion import erode
    from ial.maps.grid_message import grid_from_message, grid_to_message_fields, read_map_topic
    from ial.maps.loading import load_map
    from ial.maps.map_file import read_map, write_map
    from ial.maps.map_warning import MapWarning
    from ial.maps.occupancy_grid import FREE, OCCUPIED, UNKNOWN, OccupancyGrid, check_usable
    from ial.maps.outline import outlines
    from ial.maps.polygon import Polygon
    from ial.maps.raster import Raster, rasterize
    from ial.maps.ray_casting import cast_rays
    from ial.maps.symmetry import symmetries

__all__ = [
    "FREE",
    "OCCUPIED",
    "UNKNOWN",
    "CellContractor",
    "CellIndex",
    "Environment",
    "MapWarning",
    "OccupancyGrid",
    "Polygon",
    "Raster",
    "cast_rays",
    "check_usable",
    "erode",
    "grid_from_message",
    "grid_to_message_fields",
    "load_environment",
    "load_map",
    "outlines",
    "rasterize",
    "read_map",
    "read_map_topic",
    "symmetries",
    "write_map",
]

_FILES = {
    "cell_contractor": ("CellContractor",),
    "cell_index": ("CellIndex",),
    "environment": ("Environment", "load_environment"),
    "erosion": ("erode",),
    "grid_message": ("grid_from_message", "grid_to_message_fields", "read_map_topic"),
    "loading": ("load_map",),
    "map_file": ("read_map", "write_map"),
    "map_warning": ("MapWarning",),
    "occupancy_grid": ("FREE", "OCCUPIED", "UNKNOWN", "OccupancyGrid", "check_usable"),
    "outline": ("outlines",),
    "polygon": ("Polygon",),
    "raster": ("Raster", "rasterize"),
    "ray_casting": ("cast_rays",),
    "symmetry": ("symmetries",),
}


def __getattr__(name: str) -> Any:
    """Import the file of a public name when the name is first used: `import ial.maps` itself costs nothing."""
    for file, names in _FILES.items():
        if name in names:
            value = getattr(importlib.import_module(f"{__name__}.{file}"), name)
            globals()[name] = value
            return value
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return __all__
