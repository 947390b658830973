"""Polygons from SVG drawings: ``<polygon>`` and ``<path>`` with straight lines only. The y axis is turned up.

A path is one polygon: its subpaths are rings, of which the one with the largest area is the outer one. Transforms, curves and shapes of
other kinds are refused, since a drawing that is read by half is a wrong map.
"""

import re
from fractions import Fraction
from xml.etree import ElementTree

from ial.errors import MapError
from ial.maps.polygons.exact_number import exact_number
from ial.maps.polygons.polygon import ExactPoint, ExactRing, Polygon, common_denominator, scaled
from ial.maps.polygons.ring import doubled_area

_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_TOKEN = re.compile(rf"[\s,]*([A-Za-z]|{_NUMBER}|\S)")
_IGNORED = {"title", "desc", "metadata", "defs", "style"}
_CONTAINERS = {"svg", "g"}
_COMMANDS = "MLHVZmlhvz"


def parse_svg(text: str) -> tuple[Polygon, ...]:
    """Return the polygons of a drawing, with y = −y of the drawing: SVG's y points down.

    Raises
    ------
    MapError
        If the text is no SVG, holds a shape or a path command that is not supported, a transform, an open path, or no polygon.
    """
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise MapError("the SVG declares a document type, which may hide anything; remove the line <!DOCTYPE …>")
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise MapError(f"the file is no SVG ({error}); correct it") from None
    polygons: list[Polygon] = []
    _collect(root, polygons)
    if not polygons:
        raise MapError("the SVG holds no <polygon> or <path>; draw the free space with one")
    return tuple(polygons)


def _collect(element: ElementTree.Element, polygons: list[Polygon]) -> None:
    name = str(element.tag).rpartition("}")[2]
    if name in _IGNORED:
        return
    if "transform" in element.attrib:
        raise MapError(f"the SVG has a transform at a <{name}>; apply it to the coordinates first")
    if name in _CONTAINERS:
        for child in element:
            _collect(child, polygons)
    elif name == "polygon":
        tokens = _TOKEN.findall(element.get("points", ""))
        if len(tokens) % 2:
            raise MapError(f"the <polygon> {len(polygons) + 1} of the SVG has {len(tokens)} numbers; give pairs of x and y")
        polygons.append(_polygon([_points(tokens, f"the <polygon> {len(polygons) + 1}")]))
    elif name == "path":
        polygons.append(_polygon(_rings(_TOKEN.findall(element.get("d", "")), f"the <path> {len(polygons) + 1}")))
    else:
        raise MapError(f"the SVG holds a <{name}>; only <polygon> and <path> with straight lines are read")


def _points(tokens: list[str], where: str) -> ExactRing:
    numbers = [exact_number(token, where) for token in tokens]
    return tuple((x, -y) for x, y in zip(numbers[::2], numbers[1::2], strict=True))


def _polygon(rings: list[ExactRing]) -> Polygon:
    scale = common_denominator(rings)
    outer, *holes = sorted(rings, key=lambda ring: -abs(doubled_area(scaled(ring, scale))))
    return Polygon(outer, tuple(holes))


def _rings(tokens: list[str], where: str) -> list[ExactRing]:
    """Return the closed subpaths of the data of a path."""
    rings: list[ExactRing] = []
    ring: list[ExactPoint] = []
    start = at = (Fraction(0), Fraction(0))
    command, index = "", 0
    while index < len(tokens):
        if tokens[index] in _COMMANDS:
            command, index = tokens[index], index + 1
        elif tokens[index].isalpha() or command in ("", "Z", "z"):
            raise MapError(f"{where} has {tokens[index][:20]!r}, where one of the commands M, L, H, V, Z belongs; curves are not read")
        if command in "Zz":
            rings.append(_without_repeat(ring))
            ring, at = [], start
            continue
        if command in "Mm" and ring:
            raise MapError(f"{where} is open: a subpath ends without Z; close it")
        count = 1 if command in "HhVv" else 2
        if index + count > len(tokens):
            raise MapError(f"{where} ends after {command!r} without all of its numbers; complete it")
        at = _moved(at, command, [exact_number(token, where) for token in tokens[index : index + count]])
        index += count
        if command in "Mm":
            start, command = at, "L" if command == "M" else "l"  # further pairs after M are lines
        elif not ring:
            ring.append(start)  # a line right after Z begins where the closed subpath began
            if at == start:
                continue
        ring.append(at)
    if ring or not rings:
        raise MapError(f"{where} is open or empty; end every subpath with Z")
    return [tuple((x, -y) for x, y in each) for each in rings]


def _moved(at: ExactPoint, command: str, numbers: list[Fraction]) -> ExactPoint:
    base = at if command.islower() else (Fraction(0), Fraction(0))
    if command in "Hh":
        return base[0] + numbers[0], at[1]
    if command in "Vv":
        return at[0], base[1] + numbers[0]
    return base[0] + numbers[0], base[1] + numbers[1]


def _without_repeat(ring: list[ExactPoint]) -> ExactRing:
    """Return a ring without a last point that repeats the first one, as many programs write it before Z."""
    return tuple(ring[:-1] if len(ring) > 1 and ring[0] == ring[-1] else ring)
