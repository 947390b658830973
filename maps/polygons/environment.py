"""`Environment`: where a robot can move, as polygons with holes; and `load_environment`, which reads one from whatever file holds it."""

import warnings
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

from ial.errors import MapError
from ial.maps.grids.map_warning import MapWarning
from ial.maps.grids.picture import PICTURES, is_picture, read_picture
from ial.maps.polygons.exact_number import exact_number
from ial.maps.polygons.polygon import Polygon

_LARGEST_FILE = 2**26  # bytes


@dataclass(frozen=True)
class Environment:
    """The free space of a robot: one polygon, or several. Everything else is obstacle.

    Parameters
    ----------
    polygons
        The parts of the free space, in metres. Under the rule `inside` a cell is free if it lies in one of them.
    cell
        The width of the cells it was drawn with, if it comes from an occupancy grid.

    Raises
    ------
    MapError
        If there is no polygon.
    """

    polygons: tuple[Polygon, ...]
    cell: Fraction | None = None

    def __post_init__(self) -> None:
        if not self.polygons:
            raise MapError("the environment has no free space; give at least one polygon, or a map with free cells")

    def __repr__(self) -> str:
        count = len(self.polygons)
        cell = "" if self.cell is None else f", cells of {float(self.cell):g} m"
        return f"<Environment: {count} {'polygon' if count == 1 else 'polygons'}{cell}>"

    @property
    def area(self) -> Fraction:
        """The area of the free space in square metres."""
        return sum((polygon.area for polygon in self.polygons), Fraction(0))

    @property
    def bounds(self) -> tuple[Fraction, Fraction, Fraction, Fraction]:
        """The least and the greatest coordinates: (x, y, x, y)."""
        x0, y0, x1, y1 = zip(*(polygon.bounds for polygon in self.polygons), strict=True)
        return min(x0), min(y0), max(x1), max(y1)


def load_environment(path: str | Path, resolution: Fraction | float | str | None = None) -> Environment:
    """Read an environment; the ending of the name tells the format.

    Parameters
    ----------
    path
        ``.json`` (canonical, rational coordinates), ``.wkt``, ``.geojson``, ``.svg``, or what `load_map` takes: there the free cells are
        the free space, in the map frame; in the frame of the grid, with a warning, if that is turned. Or a picture, ``.png``, ``.pgm``,
        ``.jpg``, ``.jpeg`` or ``.bmp``, of which light pixels are free, see `read_picture`; its lower left corner is (0, 0).
    resolution
        The width of a pixel of a picture in metres; a float means its shortest decimal. All other files say themselves how large they are.

    Raises
    ------
    MapError
        If the file is missing, damaged or of another kind, or what it describes is no polygon; if a picture has no resolution, or another
        file is given one.

    Warns
    -----
    MapWarning
        If the grid is turned in its map.
    """
    path = Path(path)
    if is_picture(path):
        return _from_picture(path, resolution)
    if resolution is not None:
        raise MapError(
            f"{path}: the file says itself how large everything is; give a resolution for a picture ({', '.join(PICTURES)}) only"
        )
    if path.suffix in (".json", ".wkt", ".geojson", ".svg"):
        return _from_text(path)
    if path.suffix not in (".yaml", ".yml", ".bag", ".db3", ".mcap") and not path.is_dir():
        reason = "this is no environment" if path.exists() else "the environment does not exist"
        raise MapError(f"{path}: {reason}; give a .json, .wkt, .geojson or .svg file with polygons, a map.yaml, or a picture")
    from ial.maps.grids.loading import load_map
    from ial.maps.grids.occupancy_grid import FREE
    from ial.maps.polygons.outline import outlines

    grid = load_map(path)
    cell = Fraction(repr(grid.resolution))
    origin = grid.origin
    if origin.theta:
        warnings.warn(
            f"{path}: the grid is turned by {origin.theta:g} rad in its map, so places are given in the grid", MapWarning, stacklevel=2
        )
        return Environment(outlines(grid.mask(FREE), cell), cell)
    return Environment(outlines(grid.mask(FREE), cell, (Fraction(repr(origin.x)), Fraction(repr(origin.y)))), cell)


def _from_picture(path: Path, resolution: Fraction | float | str | None) -> Environment:
    from ial.maps.grids.occupancy_grid import FREE
    from ial.maps.polygons.outline import outlines

    if resolution is None:
        raise MapError(
            f"{path}: a picture does not say how large it is; give its resolution, the width of a pixel in metres (--resolution)"
        )
    cell = exact_number(repr(resolution) if isinstance(resolution, float) else resolution, "the resolution")
    grid = read_picture(path, float(cell))
    try:
        return Environment(outlines(grid.mask(FREE), cell), cell)
    except MapError as error:
        raise MapError(f"{path}: {error}") from None


def _from_text(path: Path) -> Environment:
    from ial.maps.polygons.geojson import parse_geojson
    from ial.maps.polygons.polygon_json import parse_polygon_json
    from ial.maps.polygons.svg import parse_svg
    from ial.maps.polygons.wkt import parse_wkt

    parsers = {".json": parse_polygon_json, ".wkt": parse_wkt, ".geojson": parse_geojson, ".svg": parse_svg}
    try:
        if path.stat().st_size > _LARGEST_FILE:
            raise MapError(f"{path}: the file is larger than {_LARGEST_FILE} bytes; simplify the polygons")
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise MapError(f"{path}: the environment cannot be read ({error.strerror or error}); check the path") from None
    except UnicodeDecodeError:
        raise MapError(f"{path}: the file is no text in UTF-8; check that it is a {path.suffix} file") from None
    try:
        return Environment(parsers[path.suffix](text))
    except MapError as error:
        raise MapError(f"{path}: {error}") from None
