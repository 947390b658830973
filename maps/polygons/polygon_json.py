"""Polygons as canonical JSON: rational coordinates, outer ring counter-clockwise, holes clockwise, rings without the repeated first point.

``{"polygons": [{"outer": [["0", "0"], ["7/2", "0"], ["0", "4"]], "holes": []}]}``
"""

import json
from collections.abc import Sequence
from typing import Any, NoReturn

from ial.errors import MapError
from ial.maps.polygons.exact_number import exact_number, text_of
from ial.maps.polygons.polygon import ExactRing, Polygon


def parse_polygon_json(text: str) -> tuple[Polygon, ...]:
    """Return the polygons of a text; numbers may be texts such as ``"1/3"`` or JSON's own, which are read as decimals, exactly.

    Raises
    ------
    MapError
        If the text is not JSON, has another form, or describes no polygon.
    """
    content = read_json(text)
    if not isinstance(content, dict) or not isinstance(content.get("polygons"), list):
        raise MapError('the JSON holds no list "polygons"; write {"polygons": [{"outer": [["0", "0"], …], "holes": []}]}')
    return tuple(_polygon(each, f"polygon {index}") for index, each in enumerate(content["polygons"], 1))


def read_json(text: str) -> Any:
    """Return the content of JSON with decimals left as texts, so that nothing is rounded.

    Raises
    ------
    MapError
        If it is not JSON.
    """
    try:
        return json.loads(text, parse_float=str, parse_constant=_refuse)
    except (ValueError, RecursionError) as error:
        raise MapError(f"the file is not JSON ({error}); correct it") from None


def _refuse(word: str) -> NoReturn:
    raise ValueError(f"{word} is no number")


def ring_of(points: object, where: str) -> ExactRing:
    """Return the ring that a list of pairs of numbers describes."""
    if not isinstance(points, list) or not all(isinstance(point, list) and len(point) == 2 for point in points):
        raise MapError(f"{where} is no list of points; write [[x, y], [x, y], …]")
    return tuple((exact_number(x, where), exact_number(y, where)) for x, y in points)


def _polygon(content: object, where: str) -> Polygon:
    if not isinstance(content, dict) or "outer" not in content or not isinstance(content.get("holes", []), list):
        raise MapError(f'{where} has no "outer" ring, or "holes" that are no list; write {{"outer": [["0", "0"], …], "holes": []}}')
    outer = ring_of(content["outer"], f"{where}, the outer ring")
    return Polygon(outer, tuple(ring_of(hole, f"{where}, hole {index}") for index, hole in enumerate(content.get("holes", []), 1)))


def polygon_json(polygons: Sequence[Polygon]) -> str:
    """Return the canonical text of polygons; `parse_polygon_json` gives the same ones back."""
    return json.dumps({"polygons": [{"outer": _pairs(each.outer), "holes": [_pairs(hole) for hole in each.holes]} for each in polygons]})


def _pairs(ring: ExactRing) -> list[list[str]]:
    return [[text_of(x), text_of(y)] for x, y in ring]
