"""Polygons from well-known text (OGC simple features): POLYGON and MULTIPOLYGON in two dimensions."""

import re
from collections.abc import Callable, Sequence
from typing import TypeVar

from ial.errors import MapError
from ial.maps.polygons.exact_number import exact_number
from ial.maps.polygons.geojson import closed
from ial.maps.polygons.polygon import ExactPoint, ExactRing, Polygon

Item = TypeVar("Item")

_TOKEN = re.compile(r"\s*([(),]|[A-Za-z]+|[^\s(),]+)")


def parse_wkt(text: str) -> tuple[Polygon, ...]:
    """Return the polygons of a text.

    Raises
    ------
    MapError
        If the text is no POLYGON or MULTIPOLYGON, a number is none, or a ring is open: its last point must repeat the first one.
    """
    return _Reader(_TOKEN.findall(text)).read()


def wkt(polygons: Sequence[Polygon]) -> str:
    """Return the text of polygons, with coordinates rounded to the nearest doubles."""
    bodies = ["(" + ", ".join(_ring_text(ring) for ring in polygon.rings) + ")" for polygon in polygons]
    return f"POLYGON {bodies[0]}" if len(bodies) == 1 else f"MULTIPOLYGON ({', '.join(bodies)})"


def _ring_text(ring: ExactRing) -> str:
    return "(" + ", ".join(f"{float(x)!r} {float(y)!r}" for x, y in (*ring, ring[0])) + ")"


class _Reader:
    """Reads one token after the other."""

    def __init__(self, tokens: list[str]) -> None:
        self._tokens = tokens
        self._at = 0

    def read(self) -> tuple[Polygon, ...]:
        kind = self._next().upper()
        if kind not in ("POLYGON", "MULTIPOLYGON"):
            raise MapError(f"the WKT begins with {kind[:40] or 'nothing'!r}; give a POLYGON or a MULTIPOLYGON")
        polygons = (self._polygon(),) if kind == "POLYGON" else tuple(self._listed(self._polygon))
        if self._at < len(self._tokens):
            raise MapError(f"the WKT goes on with {self._tokens[self._at][:40]!r} after its {kind}; give one geometry")
        return polygons

    def _next(self, wanted: str = "") -> str:
        token = self._tokens[self._at] if self._at < len(self._tokens) else ""
        if wanted and (not token or token not in wanted):
            raise MapError(f"the WKT has {token[:40] or 'an end'!r} as its token {self._at + 1}, where {' or '.join(wanted)} belongs")
        self._at += 1
        return token

    def _listed(self, item: Callable[[], Item]) -> list[Item]:
        self._next("(")
        items = [item()]
        while self._next(",)") == ",":
            items.append(item())
        return items

    def _polygon(self) -> Polygon:
        outer, *holes = self._listed(self._ring)
        return Polygon(outer, tuple(holes))

    def _ring(self) -> ExactRing:
        where = f"the ring at token {self._at + 1}"
        return closed(tuple(self._listed(self._point)), where)

    def _point(self) -> ExactPoint:
        where = f"the point at token {self._at + 1}"
        return exact_number(self._next(), where), exact_number(self._next(), where)
