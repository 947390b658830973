"""Floor plans in which some places look alike for ever, though the map as a whole has no symmetry."""

import numpy as np

from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid

Rectangle = tuple[float, float, float, float]  # its left, lower, right and upper edge, in metres

_CELL_M = 0.05


def _plan(width_m: float, height_m: float, rooms: list[Rectangle], pillars: list[Rectangle]) -> OccupancyGrid:
    """Return free rectangles in a wall, with others that are walls again."""
    cells = np.full((round(height_m / _CELL_M), round(width_m / _CELL_M)), OCCUPIED, dtype=np.uint8)
    for shapes, value in ((rooms, FREE), (pillars, OCCUPIED)):
        for shape in shapes:
            left, low, right, high = (round(each / _CELL_M) for each in shape)
            cells[low:high, left:right] = value
    return OccupancyGrid(cells, _CELL_M)


def cells_plan() -> OccupancyGrid:
    """Three rooms without doors: two are the same, with a pillar, and the third has another one besides."""
    rooms, pillars = list[Rectangle](), list[Rectangle]()
    for left in (0.2, 6.0, 11.8):
        rooms.append((left, 0.2, left + 5.6, 4.6))
        pillars.append((left + 3.6, 3.0, left + 4.2, 3.6))
    return _plan(17.6, 4.8, rooms, [*pillars, (12.8, 1.2, 13.6, 2.2)])


def slits_plan() -> OccupancyGrid:
    """Two rooms, one the other turned by half a turn, that look into each other through slits no robot can pass; and a room apart."""
    low, high = (0.2, 0.2, 5.2, 4.6), (5.4, 0.2, 10.4, 4.6)
    slits = [(5.2, 1.0, 5.4, 1.3), (5.2, 3.5, 5.4, 3.8)]
    turned = [(1.2, 2.8, 2.0, 3.4), (10.6 - 2.0, 4.8 - 3.4, 10.6 - 1.2, 4.8 - 2.8)]
    apart = [(10.6, 0.2, 14.2, 4.6), (14.2, 1.0, 15.8, 2.2)]
    return _plan(16.0, 4.8, [low, high, *slits, *apart], turned)


CLOSED_PLANS = {"cells": cells_plan, "slits": slits_plan}
