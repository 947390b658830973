"""Virtual sensors: what sensors of unlimited range would read from each of several possible places of a robot."""

import math

import numpy as np
import numpy.typing as npt

from ial.active.clearance_field import ClearanceField
from ial.contractors import threads
from ial.contractors.boxes import Boxes
from ial.contractors.intervals.trigonometric import sincos
from ial.contractors.kernels import kernel
from ial.contractors.margins import ROUNDINGS
from ial.lidar.search.bit_columns import BitColumns
from ial.lidar.search.free_space import BlockingCells, blocked
from ial.maps.grids.cell_index import CellIndex
from ial.maps.grids.occupancy_grid import OCCUPIED, OccupancyGrid
from ial.maps.grids.ray_casting import cast_rays

FloatArray = npt.NDArray[np.float64]

_FULL_TURN = 2.0 * math.pi
_WIDEST_RAD = 0.5  # of a fan of rays of which a bound is sought
_HALVINGS = 12


def directions(count: int) -> FloatArray:
    """Return directions in the frame of the robot, equally spaced, from straight ahead on counter-clockwise (rad)."""
    return np.asarray(_FULL_TURN * np.arange(count) / count)


@kernel
def _bound_rows(start, stop, lower, upper, turns, field, resolution, blocking, most, low, high):  # type: ignore[no-untyped-def]
    """Write bounds of the readings from everywhere in some boxes."""
    rows, columns = field.shape
    step = 0.5 * resolution  # places of the field are cells
    inverse = 1.0 / resolution
    for i in range(start, stop):
        x, y = 0.5 * (lower[i, 0] + upper[i, 0]), 0.5 * (lower[i, 1] + upper[i, 1])
        half = np.hypot(0.5 * (upper[i, 0] - lower[i, 0]), 0.5 * (upper[i, 1] - lower[i, 1]))
        aside = 0.5 * (upper[i, 2] - lower[i, 2])
        box = (lower[i, 0] * inverse, lower[i, 1] * inverse, upper[i, 0] * inverse, upper[i, 1] * inverse)
        for k in range(len(turns)):
            sine, cosine = sincos(0.5 * (lower[i, 2] + upper[i, 2]) + turns[k])
            way, free = 0.0, 0.0
            while way <= most:
                column, row = int(np.floor((x + way * cosine) * inverse)), int(np.floor((y + way * sine) * inverse))
                clear = field[row, column] if 0 <= row < rows and 0 <= column < columns else 0.0
                if clear < half + (way + step) * aside + step + ROUNDINGS * most:
                    break
                free = way
                way += step
            low[i, k], high[i, k] = free, most
            if 2.0 * aside > _WIDEST_RAD:
                continue
            s0, c0 = sincos(lower[i, 2] + turns[k])
            s1, c1 = sincos(upper[i, 2] + turns[k])
            near, far = free, most
            for _ in range(_HALVINGS):
                middle = 0.5 * (near + far)
                if blocked(box, (0.0, 0.0, 0.0, 0.0), (c0, s0, c1, s1, middle * inverse), ROUNDINGS * most * inverse, blocking):
                    far = middle
                    high[i, k] = middle
                else:
                    near = middle


class VirtualSensors:
    """The sensors of a map.

    Parameters
    ----------
    grid
        The map.
    """

    def __init__(self, grid: OccupancyGrid) -> None:
        self.grid = grid
        self._mask = grid.mask(OCCUPIED)
        bits = BitColumns(self._mask)
        self._blocking = BlockingCells(CellIndex(self._mask, grid.resolution).cells, bits.upwards, bits.rightwards)
        self._field = ClearanceField.of_mask(self._mask, grid.resolution)

    def __repr__(self) -> str:
        return f"<VirtualSensors in {self.grid!r}>"

    @property
    def diameter_m(self) -> float:
        """The diagonal of the map: no reading is larger."""
        return math.hypot(self.grid.width_m, self.grid.height_m)

    def readings(self, poses: FloatArray, turns_rad: FloatArray, most_m: float = math.inf) -> FloatArray:
        """Return what is read in poses (x, y, θ) of the grid's frame, in directions that begin at their headings.

        Parameters
        ----------
        poses
            Float64 of shape (..., 3).
        turns_rad
            The directions.
        most_m
            What a ray that meets nothing so near reads.

        Returns
        -------
        numpy.ndarray
            Metres, float64 of shape (..., directions); that of a ray that leaves the map is its diagonal.
        """
        angles = np.remainder(poses[..., 2, None] + turns_rad + math.pi, _FULL_TURN) - math.pi
        most = min(most_m, self.diameter_m)
        found = cast_rays(self._mask, self.grid.resolution, poses[..., 0, None], poses[..., 1, None], angles, most)
        return np.asarray(np.minimum(found, most))

    def bounds(self, boxes: Boxes, turns_rad: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return bounds of what is read from anywhere in boxes of poses: nothing occupied is nearer, and every ray meets something.

        Returns
        -------
        tuple
            Lower and upper bounds in metres, float64 of shape (boxes, directions) each. The upper one is the diagonal of the map where it
            could not be proved that every ray meets something.
        """
        low, high = np.empty((2, len(boxes), len(turns_rad)))
        corners = np.ascontiguousarray(boxes.lower), np.ascontiguousarray(boxes.upper)
        field = self._field.distance_m
        threads.run(
            _bound_rows, len(boxes), *corners, turns_rad, field, self.grid.resolution, self._blocking, self.diameter_m, low, high, minimum=1
        )
        return low, high
