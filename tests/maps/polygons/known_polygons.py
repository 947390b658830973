"""Polygons of a known form: square, L, spikes, combs and serpentines."""

from ial.maps.polygons.polygon import Polygon


def _polygon(*corners: tuple[int, int]) -> Polygon:
    return Polygon(corners)  # type: ignore[arg-type]


SQUARE = _polygon((0, 0), (4, 0), (4, 4), (0, 4))
L_SHAPE = _polygon((0, 0), (4, 0), (4, 2), (2, 2), (2, 4), (0, 4))
SPIKES = _polygon((0, 0), (40, 1), (9, 3), (12, 30), (6, 5), (-20, 21), (3, 4), (-30, 2), (2, 2))
STRAIGHT_CORNERS = _polygon((0, 0), (2, 0), (4, 0), (4, 3), (3, 3), (0, 3), (0, 2))
Z_SHAPE = _polygon((0, 0), (4, 0), (4, 3), (9, 3), (9, 9), (5, 9), (5, 6), (0, 6))  # its two inner corners are a bitangent
HOLED = Polygon(((0, 0), (9, 0), (9, 4), (5, 4), (5, 7), (0, 7)), (((2, 2), (2, 4), (3, 4), (3, 2)),))  # type: ignore[arg-type]
TOUCHING = Polygon(((0, 0), (9, 0), (9, 7), (0, 7)), (((4, 0), (3, 3), (6, 2)),))  # type: ignore[arg-type]
"""Its hole touches the outer ring in one point."""
TWO_TOUCHING = Polygon(((0, 0), (9, 0), (8, 7), (0, 7)), (((2, 2), (2, 3), (4, 4)), ((4, 4), (5, 6), (6, 3))))  # type: ignore[arg-type]
"""Its holes touch each other in a corner of both."""


def comb(branches: int, irregular: bool = False) -> Polygon:
    """Return a corridor with branches to one side, all alike; or each of another width and depth."""
    corners, x = [(0, 0)], 1
    tops = []
    for branch in range(branches):
        width, depth = (2 + branch % 3, 9 + 2 * branch) if irregular else (2, 9)
        slant = branch % 2 if irregular else 0
        tops += [(x, 3), (x, depth), (x + width, depth + slant), (x + width, 3)]
        x += width + 2
    corners += [(x, 0), (x, 3), *tops[::-1], (0, 3)]
    return _polygon(*corners)


def serpentine(turns: int) -> Polygon:
    """Return a corridor that turns back again and again."""
    walls = [(4 * turn + 3, turn % 2) for turn in range(turns - 1)]  # thin walls, from below and from above
    below = [corner for x, top in walls if not top for corner in ((x, 0), (x, 8), (x + 1, 8), (x + 1, 0))]
    above = [corner for x, top in walls if top for corner in ((x, 10), (x, 2), (x + 1, 2), (x + 1, 10))]
    width = 4 * turns - 1
    ends_above = [above[at : at + 4][::-1] for at in range(0, len(above), 4)][::-1]
    return _polygon((0, 0), *below, (width, 0), (width, 10), *(corner for wall in ends_above for corner in wall), (0, 10))
