"""What information states hold, beside the places of the verifier, which shares no code with them."""

from fractions import Fraction

from ial.compass.state import InformationState
from ial.compass.verifier import Places, whole_walls
from ial.maps.polygons.exact.rational import fraction
from ial.maps.polygons.polygon import Polygon


def places_of(polygon: Polygon, state: InformationState) -> Places:
    """Return a state as places in the verifier's unit."""
    _, unit = whole_walls(polygon)
    spans: dict[int, list[tuple[Fraction, Fraction]]] = {}
    for piece in state.pieces:
        spans.setdefault(piece.edge, []).append((fraction(piece.low), fraction(piece.high)))
    return Places(spans, {(fraction(point.x) * unit, fraction(point.y) * unit) for point in state.points})
