"""`undecided`: two places that a robot without a linear odometer never tells apart, whatever it does: why R3 cannot be localized.

O'Kane and LaValle (2007), section VI: a robot that turns by known angles and drives to walls, without a compass and without measuring how
far it drives, does not know its heading. For almost every heading each drive takes a segment of a wall to a segment of a wall; only a drive
exactly along a wall would not. So whatever sequence of turns is planned, the places in which the robot may end hold a segment.
"""

from collections.abc import Iterable

from ial.maps.polygons.exact.rational import rational
from ial.maps.polygons.exact.shooter import BoundaryPoint, Direction, Shooter

_HALVINGS = 200


def undecided(shooter: Shooter, wall: int, directions: Iterable[Direction]) -> tuple[BoundaryPoint, BoundaryPoint] | None:
    """Return both ends of a segment of a wall in every point of which the robot may be after some drives.

    Parameters
    ----------
    shooter
        The walls.
    wall
        On which wall it may start: anywhere.
    directions
        The drives in the frame of the polygon, for one of the headings that are possible at the start.

    Returns
    -------
    tuple or None
        None if a direction is along the wall that the robot is on: such headings have measure zero.
    """
    low, high = shooter.on_edge(wall, rational(1) / 3), shooter.on_edge(wall, rational(2) / 3)
    on = wall
    for ux, uy in directions:
        ex, ey = shooter.edges[on]
        if ex * uy - ey * ux == 0:
            return None
        if ex * uy - ey * ux < 0:
            continue  # into the wall: all of the segment stays
        low, high, on = _image(shooter, on, low, high, (ux, uy))
    return low, high


def _image(
    shooter: Shooter, wall: int, low: BoundaryPoint, high: BoundaryPoint, direction: Direction
) -> tuple[BoundaryPoint, BoundaryPoint, int]:
    """Return the image of a part of a segment that all lands on one wall, and that wall."""
    first, last = shooter.part(low, wall), shooter.part(high, wall)
    for _ in range(_HALVINGS):
        start, end = shooter.on_edge(wall, first), shooter.on_edge(wall, last)
        one, other = shooter.shoot(start.place, direction), shooter.shoot(end.place, direction)
        if one.edge == other.edge and not one.corner and not other.corner and not _between(shooter, start, end, direction, one, other):
            return one, other, one.edge
        first, last = (first + (last - first) * 3 / 7, last) if one.corner else (first, first + (last - first) * 3 / 7)
    raise AssertionError("a small enough part of a segment lands on one wall")


def _between(
    shooter: Shooter, start: BoundaryPoint, end: BoundaryPoint, direction: Direction, one: BoundaryPoint, other: BoundaryPoint
) -> bool:
    """Return whether a corner lies in the quadrilateral that the segment sweeps: only there another wall could be in the way."""
    ring = (start.place, end.place, other.place, one.place)
    sides = [
        [(bx - ax) * (y - ay) - (by - ay) * (x - ax) for (ax, ay), (bx, by) in zip(ring, ring[1:] + ring[:1], strict=True)]
        for x, y in shooter.corners
    ]
    return any(all(side >= 0 for side in each) or all(side <= 0 for side in each) for each in sides)
