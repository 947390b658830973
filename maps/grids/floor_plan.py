"""Random floor plans: rooms, corridors, doors, furniture. Maps to simulate in, of any size."""

import random
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from ial.errors import MapError
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid, check_resolution, check_size

SMALLEST_PLAN_M = 1.0
_ROOM_M = (2.4, 7.0)  # a room is never narrower than the first, and split where wider than a number up to the second
_HALL_M = 14.0  # what is wider than this in both directions is opened up by a corridor
_CORRIDOR_M = (1.5, 2.5)
_WALL_M = (0.1, 0.2)
_DOOR_M = (0.8, 1.2)
_GAP_M = 0.6  # between pieces of furniture that do not stand at a wall, and in front of doors
_FURNITURE_M = (0.3, 1.2)
_AREA_PER_PIECE_M2 = 2.5


@dataclass(eq=False)
class _Room:
    """A free rectangle, in cells: columns x0 … x1 − 1, rows y0 … y1 − 1; and what stands or must stay free in it."""

    x0: int
    x1: int
    y0: int
    y1: int
    taken: list[tuple[int, int, int, int]] = field(default_factory=list)


class _Architect:
    """Splits a rectangle of free cells by walls, and opens doors so that every room can be reached."""

    def __init__(self, cells: np.ndarray[tuple[int, int], np.dtype[np.uint8]], resolution: float, seed: int) -> None:
        self.cells = cells
        self.resolution = resolution
        self.random = random.Random(seed)

    def length(self, bounds: tuple[float, float]) -> int:
        """Return a random length between two in metres, in cells, at least 1."""
        return max(1, round(self.random.uniform(*bounds) / self.resolution))

    def split(self, room: _Room) -> list[_Room]:
        """Divide a room by walls, and the parts in their turn; return the rooms that result, all connected by doors."""
        width, height = room.x1 - room.x0, room.y1 - room.y0
        hall = _HALL_M / self.resolution
        across = self.random.random() * (width + height) < width  # the longer side is more likely to be cut
        if min(width, height) > hall:
            return self._divide(room, across, self.length(_CORRIDOR_M))
        if max(width, height) > self.length(_ROOM_M) and max(width, height) > 2 * self._least() + self.length(_WALL_M):
            return self._divide(room, width > height, 0)
        return [room]

    def _least(self) -> int:
        return round(_ROOM_M[0] / self.resolution)

    def _divide(self, room: _Room, across: bool, corridor: int) -> list[_Room]:
        """Divide a room by one wall, or by two with a corridor between them."""
        start, stop = (room.x0, room.x1) if across else (room.y0, room.y1)
        walls = [self.length(_WALL_M) for _ in range(2 if corridor else 1)]
        spare = stop - start - sum(walls) - corridor - 2 * self._least()
        if spare < 0:
            return [room]
        first = start + self._least() + self.random.randint(0, spare)
        edges = [(start, first), (first + walls[0], stop)]
        if corridor:
            inside = first + walls[0]
            edges = [(start, first), (inside, inside + corridor), (inside + corridor + walls[1], stop)]
        for (_, end), (begin, _) in pairwise(edges):
            if across:
                self.cells[room.y0 : room.y1, end:begin] = OCCUPIED
            else:
                self.cells[end:begin, room.x0 : room.x1] = OCCUPIED
        parts = [_Room(a, b, room.y0, room.y1) if across else _Room(room.x0, room.x1, a, b) for a, b in edges]
        groups = [[part] if corridor and i == 1 else self.split(part) for i, part in enumerate(parts)]
        for (one, other), (_, end), (begin, _) in zip(pairwise(groups), edges, edges[1:], strict=False):
            self._open_doors(one, other, across, end, begin)
        return [each for group in groups for each in group]

    def _open_doors(self, one: list[_Room], other: list[_Room], across: bool, end: int, begin: int) -> None:
        """Open the wall in end … begin − 1 between two groups of rooms."""
        door = round(_DOOR_M[1] / self.resolution)
        pairs = list(self._neighbours(one, other, across, end, begin, door))
        if not pairs:  # rooms too small for a full door: the widest opening there is
            pairs = list(self._neighbours(one, other, across, end, begin, 1))
        self.random.shuffle(pairs)
        wanted = max(1, len(pairs) * 2 // 3)
        for low, high, room, neighbour in pairs[:wanted]:
            width = min(self.length(_DOOR_M), high - low)
            at = self.random.randint(low, high - width)
            if across:
                self.cells[at : at + width, end:begin] = FREE
            else:
                self.cells[end:begin, at : at + width] = FREE
            gap = round(_GAP_M / self.resolution) + 1
            zone = (end - gap, begin + gap, at, at + width) if across else (at, at + width, end - gap, begin + gap)
            room.taken.append(zone)
            neighbour.taken.append(zone)

    @staticmethod
    def _neighbours(
        one: list[_Room], other: list[_Room], across: bool, end: int, begin: int, least: int
    ) -> Iterator[tuple[int, int, _Room, _Room]]:
        """Yield the common stretches of wall, at least so long, of rooms on both sides."""
        left = sorted((r.y0, r.y1, i) if across else (r.x0, r.x1, i) for i, r in enumerate(one) if (r.x1 if across else r.y1) == end)
        right = sorted((r.y0, r.y1, i) if across else (r.x0, r.x1, i) for i, r in enumerate(other) if (r.x0 if across else r.y0) == begin)
        i = j = 0
        while i < len(left) and j < len(right):
            low, high = max(left[i][0], right[j][0]), min(left[i][1], right[j][1])
            if high - low >= least:
                yield low, high, one[left[i][2]], other[right[j][2]]
            if left[i][1] <= right[j][1]:
                i += 1
            else:
                j += 1

    def furnish(self, room: _Room) -> None:
        """Put boxes and round pillars into a room, so that the rest of it stays in one piece.

        Pieces keep a gap from each other, a box keeps a gap from a wall or none, a pillar keeps one, and none is longer than half the room.
        """
        gap = round(_GAP_M / self.resolution) + 1
        area = (room.x1 - room.x0) * (room.y1 - room.y0) * self.resolution**2
        for _ in range(round(area / _AREA_PER_PIECE_M2 * self.random.uniform(0.5, 1.5))):
            round_piece = self.random.random() < 0.25
            width = self.length(_FURNITURE_M)
            height = width if round_piece else self.length(_FURNITURE_M)
            if 2 * width > room.x1 - room.x0 or 2 * height > room.y1 - room.y0:
                continue
            x = _flush(self.random.randint(room.x0, room.x1 - width), width, room.x0, room.x1, gap)
            y = _flush(self.random.randint(room.y0, room.y1 - height), height, room.y0, room.y1, gap)
            if round_piece and (x in (room.x0, room.x1 - width) or y in (room.y0, room.y1 - height)):
                continue  # a pillar at a wall could cut off the corner behind it
            if any(x < x1 + gap and x0 < x + width + gap and y < y1 + gap and y0 < y + height + gap for x0, x1, y0, y1 in room.taken):
                continue
            room.taken.append((x, x + width, y, y + height))
            piece = self.cells[y : y + height, x : x + width]
            if round_piece:
                at = np.arange(width) + 0.5 - 0.5 * width
                piece[at[:, None] ** 2 + at**2 <= 0.25 * width**2] = OCCUPIED
            else:
                piece[:] = OCCUPIED


def _flush(at: int, size: int, low: int, high: int, gap: int) -> int:
    """Return a position moved to the wall where it would leave less than a gap."""
    if at - low < gap:
        return low
    return high - size if high - size - at < gap else at


def floor_plan(width_m: float, height_m: float, resolution: float, seed: int) -> OccupancyGrid:
    """Return a random floor plan.

    Walls of 0.1–0.2 m enclose rooms of 2.4–7 m and corridors of 1.5–2.5 m, with doors of 0.8–1.2 m, and boxes and pillars inside. Sizes are
    drawn independently, so that hardly two places look alike to a lidar. Every cell is free or occupied, the border is wall, and the free
    cells are connected. The same arguments give the same plan.

    Parameters
    ----------
    width_m, height_m
        The size, at least 1 m each; a multiple of the resolution, or it is rounded to one.
    resolution
        The width of a cell in metres, at most 0.25.
    seed
        What the plan is drawn from.

    Raises
    ------
    MapError
        If the plan would be too small or have too many cells, or the resolution cannot be meant.
    """
    check_resolution(resolution)
    if resolution > 0.25:
        raise MapError(f"the resolution is {resolution} m per cell; at most 0.25 m show the doors of a floor plan")
    if not (width_m >= SMALLEST_PLAN_M and height_m >= SMALLEST_PLAN_M and max(width_m, height_m) < np.inf):
        raise MapError(f"a floor plan of {width_m} × {height_m} m cannot be drawn; give at least {SMALLEST_PLAN_M:g} m on each side")
    columns, rows = round(width_m / resolution), round(height_m / resolution)
    check_size(rows, columns)
    cells = np.full((rows, columns), OCCUPIED, dtype=np.uint8)
    architect = _Architect(cells, resolution, seed)
    border = architect.length(_WALL_M)
    cells[border : rows - border, border : columns - border] = FREE
    for room in architect.split(_Room(border, columns - border, border, rows - border)):
        architect.furnish(room)
    return OccupancyGrid(cells, resolution)
