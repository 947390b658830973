"""`Configurations`: sets of places with headings, as boxes on walls and in the plane."""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.contractors.intervals.angle import contains_angle
from ial.contractors.kernels import kernel
from ial.odometer.casting import COLUMNS, place
from ial.odometer.wall_table import WallTable

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Configurations:
    """Boxes that together hold every configuration in which a robot may be.

    Parameters
    ----------
    walls
        The walls of the environment.
    rows
        Float64 of shape (m, 9): bounds of the part of a wall that lies before the robot, of x, of y and of the heading in radians, and the
        number of the wall, −1 for a robot that may be anywhere in the box. Places in the frame of `walls`.
    everywhere
        Whether nothing is known but that a wall has stopped the robot.
    """

    walls: WallTable
    rows: FloatArray
    everywhere: bool = False

    def __len__(self) -> int:
        return len(self.rows)

    def __repr__(self) -> str:
        return f"<Configurations in {len(self)} box{'es' * (len(self) != 1)}>"

    def holds(self, x: float, y: float, heading_rad: float) -> bool:
        """Return whether a configuration lies in one of the boxes: x and y in metres, in the frame of the polygon.

        The place is a double, and so about half a unit in its last place from what it stands for: that much is allowed for.
        """
        slack = 4.0 * np.finfo(np.float64).eps * (self.walls.size + max(abs(self.walls.origin[0]), abs(self.walls.origin[1])))
        px, py = x - self.walls.origin[0], y - self.walls.origin[1]
        rows = self.rows
        near = (rows[:, 2] - slack <= px) & (px <= rows[:, 3] + slack) & (rows[:, 4] - slack <= py) & (py <= rows[:, 5] + slack)
        turn = 4.0 * np.finfo(np.float64).eps * math.pi
        return any(bool(contains_angle(row[6] - turn, row[7] + turn, heading_rad)) for row in rows[near])

    def middles(self) -> FloatArray:
        """Return the middle of each box, float64 of shape (m, 3): x, y in metres in the frame of the polygon, heading in radians."""
        rows = self.rows
        x, y = 0.5 * (rows[:, 2] + rows[:, 3]) + self.walls.origin[0], 0.5 * (rows[:, 4] + rows[:, 5]) + self.walls.origin[1]
        return np.column_stack([x, y, 0.5 * (rows[:, 6] + rows[:, 7])])


def everywhere(walls: WallTable) -> Configurations:
    """Return all configurations in which a robot can be that a wall has stopped: its heading leads into a wall that it stands at."""
    rows = np.zeros((len(walls), COLUMNS))
    rows[:, 1], rows[:, 6:8], rows[:, 8] = 1.0, walls.facing, np.arange(len(walls))
    return Configurations(walls, _placed(walls, rows), everywhere=True)


def dead_ends(walls: WallTable) -> Configurations:
    """Return the configurations in which a robot can drive neither on nor back: convex corners, most headings."""
    rows = np.zeros((2 * len(walls), COLUMNS))
    for corner, (_, before, reflex) in enumerate(walls.links.tolist()):
        rows[2 * corner : 2 * corner + 2, 8] = -1.0 if reflex else corner
        # Between the free directions, from along the wall to against the one before, and their opposites: two arcs.
        low, high = walls.facing[corner], walls.facing[before]
        rows[2 * corner, 6:8] = high[1], high[1] + (low[1] - high[1]) % (2.0 * math.pi)
        rows[2 * corner + 1, 6:8] = rows[2 * corner, 6:8] + math.pi
    slack = 8.0 * np.finfo(np.float64).eps * math.pi  # the roundings of the lines above
    rows[:, 6] -= slack
    rows[:, 7] += slack
    rows = rows[rows[:, 8] >= 0]
    return Configurations(walls, _placed(walls, rows))


@kernel
def _place_all(corners, edges, rows):  # type: ignore[no-untyped-def]
    for i in range(len(rows)):
        rows[i, 2], rows[i, 3], rows[i, 4], rows[i, 5] = place(corners, edges, rows[i])


def _placed(walls: WallTable, rows: FloatArray) -> FloatArray:
    _place_all(walls.corners, walls.edges, rows)
    return rows


def tidied(rows: FloatArray, fine_m: float, fine_rad: float, lengths: FloatArray) -> FloatArray:
    """Return fewer boxes that hold the same: those of a wall which stand in one cell of a fine lattice are joined."""
    for shift in (0.0, 0.5):
        if len(rows) < 2:
            break
        wall = rows[:, 8].astype(np.int64)
        scale = np.where(wall >= 0, lengths[wall], 1.0) / fine_m
        keys = np.column_stack(
            [
                np.floor(np.where(wall >= 0, 0.5 * (rows[:, 0] + rows[:, 1]) * scale, 0.0) + shift),
                np.floor(np.where(wall >= 0, 0.0, 0.5 * (rows[:, 2] + rows[:, 3]) / fine_m) + shift),
                np.floor(np.where(wall >= 0, 0.0, 0.5 * (rows[:, 4] + rows[:, 5]) / fine_m) + shift),
                np.floor(0.5 * (rows[:, 6] + rows[:, 7]) / fine_rad + shift),
                wall,
            ]
        )
        order = np.lexsort(keys.T)
        keys, rows = keys[order], rows[order]
        first = np.flatnonzero(np.concatenate([[True], (keys[1:] != keys[:-1]).any(axis=1)]))
        joined = rows[first].copy()
        joined[:, 0:8:2] = np.minimum.reduceat(rows[:, 0:8:2], first, axis=0)
        joined[:, 1:8:2] = np.maximum.reduceat(rows[:, 1:8:2], first, axis=0)
        rows = joined
    return rows
