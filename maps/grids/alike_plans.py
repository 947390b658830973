"""Floor plans in which many places look alike, to try active localization on. Nothing in them is drawn at random.

Shapes are filled on a dark picture, so that what is not drawn is wall.
"""

from collections.abc import Callable

import cv2
import numpy as np
import numpy.typing as npt

from ial.errors import MapError
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid

Canvas = npt.NDArray[np.uint8]

RESOLUTION_M = 0.05
_WALL_M = 0.2


def alike_plan(name: str) -> OccupancyGrid:
    """Return a plan.

    Parameters
    ----------
    name
        ``rooms``: four rooms of one shape on a corridor; in one of them stands a shelf. ``office``: seventeen rooms of two sizes along a
        corridor that turns a corner. ``corridors``: a cross of corridors of which one arm is longer and ends in a niche. ``curved``: two
        round halls that differ in an alcove beyond a bend. ``detached``: two rows of rooms under one long wall that touches nothing else.
        ``ring``: a square corridor that looks the same from all four sides.

    Raises
    ------
    MapError
        If there is no such plan.
    """
    if name not in _PLANS:
        raise MapError(f"there is no plan called {name!r}; give one of {', '.join(_PLANS)}")
    return _PLANS[name]()


def plan_names() -> tuple[str, ...]:
    """Return the names of all plans."""
    return tuple(_PLANS)


def _canvas(width_m: float, height_m: float) -> Canvas:
    return np.zeros((round(height_m / RESOLUTION_M), round(width_m / RESOLUTION_M)), dtype=np.uint8)


def _fill(canvas: Canvas, x0: float, y0: float, x1: float, y1: float, value: int = 255) -> None:
    """Fill a rectangle; metres from the lower left corner."""
    column0, row0, column1, row1 = (round(each / RESOLUTION_M) for each in (x0, y0, x1, y1))
    canvas[row0:row1, column0:column1] = value


def _grid(canvas: Canvas) -> OccupancyGrid:
    return OccupancyGrid(np.where(canvas > 0, FREE, OCCUPIED).astype(np.uint8), RESOLUTION_M)


def _rooms() -> OccupancyGrid:
    canvas = _canvas(16.6, 7.0)
    _fill(canvas, _WALL_M, _WALL_M, 16.4, 2.0)  # corridor
    for number in range(4):
        left = _WALL_M + number * 4.1
        _fill(canvas, left, 2.2, left + 3.9, 6.8)
        _fill(canvas, left + 1.4, 2.0, left + 2.5, 2.2)  # door
    _fill(canvas, 8.6, 6.2, 9.6, 6.8, 0)  # the shelf
    return _grid(canvas)


def _office() -> OccupancyGrid:
    canvas = _canvas(30.0, 12.0)
    _fill(canvas, 0.2, 5.2, 29.8, 6.8)  # corridor
    for number in range(9):  # above
        left = 0.2 + number * 3.3
        _fill(canvas, left, 7.0, left + 3.1, 11.8)
        _fill(canvas, left + 1.0, 6.8, left + 2.1, 7.0)
    for number in range(8):  # below, and one of them wider
        left = 0.2 + number * 3.3 + (3.3 if number > 5 else 0.0)
        _fill(canvas, left, 0.2, left + (6.4 if number == 5 else 3.1), 5.0)
        _fill(canvas, left + 1.0, 5.0, left + 2.1, 5.2)
    return _grid(canvas)


def _corridors() -> OccupancyGrid:
    canvas = _canvas(22.0, 20.0)
    _fill(canvas, 0.2, 9.1, 21.8, 10.9)
    _fill(canvas, 9.1, 0.2, 10.9, 19.8)
    _fill(canvas, 19.8, 10.9, 21.8, 12.4)  # the niche
    return _grid(canvas)


def _curved() -> OccupancyGrid:
    canvas = _canvas(22.0, 10.0)

    def disc(x: float, y: float, radius: float, value: int = 255) -> None:
        cv2.circle(canvas, (round(x / RESOLUTION_M), round(y / RESOLUTION_M)), round(radius / RESOLUTION_M), value, -1)

    for x in (5.0, 17.0):
        disc(x, 5.0, 4.6)
        disc(x, 5.0, 2.6, 0)
    _fill(canvas, 9.2, 4.1, 12.8, 5.9)
    disc(20.9, 8.2, 1.2)  # the alcove
    canvas[:4], canvas[-4:], canvas[:, :4], canvas[:, -4:] = 0, 0, 0, 0
    return _grid(canvas)


def _detached() -> OccupancyGrid:
    canvas = _canvas(18.0, 12.0)
    _fill(canvas, 0.2, 0.2, 17.8, 11.8)
    for number in range(5):
        left = 0.2 + number * 3.5
        _fill(canvas, left + 3.4, 0.2, left + 3.6, 4.4, 0)  # walls between rooms, which are open above
    _fill(canvas, 3.0, 8.6, 15.0, 8.8, 0)  # the wall that touches nothing
    _fill(canvas, 3.0, 8.8, 3.2, 9.6, 0)
    return _grid(canvas)


def _ring() -> OccupancyGrid:
    canvas = _canvas(10.0, 10.0)
    _fill(canvas, 0.2, 0.2, 9.8, 9.8)
    _fill(canvas, 2.0, 2.0, 8.0, 8.0, 0)
    return _grid(canvas)


_PLANS: dict[str, Callable[[], OccupancyGrid]] = {
    "rooms": _rooms,
    "office": _office,
    "corridors": _corridors,
    "curved": _curved,
    "detached": _detached,
    "ring": _ring,
}
