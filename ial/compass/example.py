"""`example_polygon`: the embedded environment of the compass robot, a building of our own in which nothing is regular."""

from ial.maps.polygons.polygon import Polygon


def example_polygon() -> Polygon:
    """Return a corridor with five rooms behind narrow doors, no two of them alike; in metres."""
    below = (
        ((2, 4), (2, 3), (0, 3), (1, 0), (6, 0), (6, 3), (3, 3), (3, 4)),
        ((9, 4), (9, 3), (8, 3), (8, 1), (14, 0), (13, 3), (10, 3), (10, 4)),
        ((19, 4), (19, 3), (16, 3), (17, 0), (23, 1), (22, 3), (20, 3), (20, 4)),
    )
    above = (
        ((17, 6), (17, 7), (22, 7), (21, 10), (15, 9), (15, 7), (16, 7), (16, 6)),
        ((7, 6), (7, 7), (12, 7), (12, 10), (5, 9), (4, 7), (6, 7), (6, 6)),
    )
    lower, upper = (tuple(corner for room in rooms for corner in room) for rooms in (below, above))
    return Polygon(((0, 4), *lower, (24, 4), (25, 6), *upper, (0, 6)))  # type: ignore[arg-type]
