"""Polygons from GeoJSON (RFC 7946): Polygon and MultiPolygon, alone or in features.

GeoJSON means longitude and latitude; here the two numbers are x and y in metres of a plane.
"""

from collections.abc import Iterator

from ial.errors import MapError
from ial.maps.polygons.polygon import ExactRing, Polygon
from ial.maps.polygons.polygon_json import read_json, ring_of

_DEEPEST = 8


def parse_geojson(text: str) -> tuple[Polygon, ...]:
    """Return the polygons of a text; a third number of a point is not read.

    Raises
    ------
    MapError
        If the text is not JSON, holds another geometry or none, or a ring is open: its last point must repeat the first one.
    """
    polygons = tuple(_polygons(read_json(text), 0))
    if not polygons:
        raise MapError("the GeoJSON holds no polygon; give a Polygon, a MultiPolygon or features with them")
    return polygons


def _polygons(content: object, depth: int) -> Iterator[Polygon]:
    kind = content.get("type") if isinstance(content, dict) else None
    if not isinstance(content, dict) or depth > _DEEPEST:
        raise MapError("the GeoJSON has an object without a type, or nests too deep; give a Polygon, a MultiPolygon or features with them")
    if kind == "FeatureCollection":
        for feature in _listed(content.get("features")):
            yield from _polygons(feature, depth + 1)
    elif kind == "Feature":
        yield from _polygons(content.get("geometry"), depth + 1)
    elif kind == "GeometryCollection":
        for geometry in _listed(content.get("geometries")):
            yield from _polygons(geometry, depth + 1)
    elif kind == "Polygon":
        yield _polygon(content.get("coordinates"))
    elif kind == "MultiPolygon":
        for rings in _listed(content.get("coordinates")):
            yield _polygon(rings)
    else:
        raise MapError(f"the GeoJSON holds a {kind}; only Polygon and MultiPolygon describe free space")


def _listed(content: object) -> list[object]:
    if not isinstance(content, list):
        raise MapError("the GeoJSON lacks a list where one belongs; check its features and coordinates")
    return content


def _polygon(rings: object) -> Polygon:
    outer, *holes = [_closed(ring, f"ring {index}") for index, ring in enumerate(_listed(rings), 1)] or [()]
    return Polygon(outer, tuple(holes))


def _closed(points: object, where: str) -> ExactRing:
    flat = [point[:2] if isinstance(point, list) and len(point) == 3 else point for point in _listed(points)]
    return closed(ring_of(flat, where), where)


def closed(ring: ExactRing, where: str) -> ExactRing:
    """Return a ring without its last point, which must repeat the first one."""
    if len(ring) < 2 or ring[0] != ring[-1]:
        raise MapError(f"{where} is open; repeat its first point at the end")
    return ring[:-1]
