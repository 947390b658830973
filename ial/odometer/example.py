"""`example_environment`: a small environment of our own, for those who have none at hand."""

from fractions import Fraction

from ial.maps.polygons.polygon import Polygon

_OUTER = ((0, 0), (12, 0), (12, 5), (9, 5), (9, 4), (8, 4), (8, 9), (5, 9), (5, 6), (3, 6), (3, 9), (0, 9), (0, 5), (1, 4), (0, 3))
_HOLE = ((3, 2), (5, 4), (6, 2))


def example_environment() -> Polygon:
    """Return a hall with two rooms, a niche and a pillar, 12 m wide and 9 m high; no rotation lays it upon itself."""
    outer, hole = (tuple((Fraction(x), Fraction(y)) for x, y in ring) for ring in (_OUTER, _HOLE))
    return Polygon(outer, (hole,))
