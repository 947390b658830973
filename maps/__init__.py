"""Maps: occupancy grids, their files and messages, contractors to their cells, ray casting, and polygons with holes.

Names are loaded when they are first used.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ial.maps.grids.cell_contractor import CellContractor as CellContractor
    from ial.maps.grids.cell_index import CellIndex as CellIndex
    from ial.maps.grids.grid_message import grid_from_message as grid_from_message
    from ial.maps.grids.grid_message import grid_to_message_fields as grid_to_message_fields
    from ial.maps.grids.grid_message import read_map_topic as read_map_topic
    from ial.maps.grids.loading import load_map as load_map
    from ial.maps.grids.map_file import read_map as read_map
    from ial.maps.grids.map_file import write_map as write_map
    from ial.maps.grids.map_warning import MapWarning as MapWarning
    from ial.maps.grids.occupancy_grid import FREE as FREE
    from ial.maps.grids.occupancy_grid import OCCUPIED as OCCUPIED
    from ial.maps.grids.occupancy_grid import UNKNOWN as UNKNOWN
    from ial.maps.grids.occupancy_grid import OccupancyGrid as OccupancyGrid
    from ial.maps.grids.occupancy_grid import check_usable as check_usable
    from ial.maps.grids.ray_casting import cast_rays as cast_rays
    from ial.maps.grids.symmetry import symmetries as symmetries
    from ial.maps.polygons.environment import Environment as Environment
    from ial.maps.polygons.environment import load_environment as load_environment
    from ial.maps.polygons.erosion import erode as erode
    from ial.maps.polygons.outline import outlines as outlines
    from ial.maps.polygons.polygon import Polygon as Polygon
    from ial.maps.polygons.raster import Raster as Raster
    from ial.maps.polygons.raster import rasterize as rasterize
    from ial.maps.polygons.simplification import Simplification as Simplification
    from ial.maps.polygons.simplification import simplified as simplified
else:
    from ial.lazy import lazy as _lazy

    __getattr__, __dir__, __all__ = _lazy(
        __name__,
        {
            "grids.cell_contractor": ("CellContractor",),
            "grids.cell_index": ("CellIndex",),
            "grids.grid_message": (
                "grid_from_message",
                "grid_to_message_fields",
                "read_map_topic",
            ),
            "grids.loading": ("load_map",),
            "grids.map_file": (
                "read_map",
                "write_map",
            ),
            "grids.map_warning": ("MapWarning",),
            "grids.occupancy_grid": (
                "FREE",
                "OCCUPIED",
                "UNKNOWN",
                "OccupancyGrid",
                "check_usable",
            ),
            "grids.ray_casting": ("cast_rays",),
            "grids.symmetry": ("symmetries",),
            "polygons.environment": (
                "Environment",
                "load_environment",
            ),
            "polygons.erosion": ("erode",),
            "polygons.outline": ("outlines",),
            "polygons.polygon": ("Polygon",),
            "polygons.raster": (
                "Raster",
                "rasterize",
            ),
            "polygons.simplification": ("Simplification", "simplified"),
        },
    )
