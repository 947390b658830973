"""`Domain`: where the robot's base may be, by the definition of docs/guarantee.md."""

import numpy as np
import numpy.typing as npt

from ial.lidar.configuration.config import LocalizerConfig
from ial.maps.grids.occupancy_grid import FREE, UNKNOWN, OccupancyGrid
from ial.study.obstacles import BoolArray, FloatArray, Obstacles, slack_m

_IN_A_CELL = np.stack(np.meshgrid([0.0, 0.5, 1.0], [0.0, 0.5, 1.0]), axis=-1).reshape(-1, 2)


class Domain:
    """The free cells of a map, unknown ones too if they are wanted, and with a radius those that have room somewhere.

    Parameters
    ----------
    grid
        The map.
    config
        `domain` and `robot_radius_m`.
    obstacles
        Its occupied cells.
    """

    def __init__(self, grid: OccupancyGrid, config: LocalizerConfig, obstacles: Obstacles) -> None:
        self._allowed = grid.mask(FREE, UNKNOWN) if config.domain == "free_or_unknown" else grid.mask(FREE)
        self._resolution = grid.resolution
        self._radius_m = config.robot_radius_m
        self._obstacles = obstacles

    def __repr__(self) -> str:
        return f"<Domain of {np.count_nonzero(self._allowed)} cells of {self._resolution:g} m>"

    def holds(self, poses: FloatArray) -> BoolArray:
        """Return which poses in the grid's frame, shape (n, 2 or more), are certainly in the domain: whichever way their numbers round."""
        slack = slack_m(poses[:, :2])
        corners = np.array([(-slack, -slack), (slack, -slack), (-slack, slack), (slack, slack)])
        cells = np.floor((poses[:, None, :2] + corners) / self._resolution).astype(np.int64)
        column, row = cells[..., 0], cells[..., 1]
        inside = (row >= 0) & (row < self._allowed.shape[0]) & (column >= 0) & (column < self._allowed.shape[1])
        inside[inside] = self._allowed[row[inside], column[inside]]
        held = inside.all(axis=1)
        if self._radius_m and held.any():
            names, which = np.unique(row[held] * self._allowed.shape[1] + column[held], return_inverse=True)
            roomy = self._roomy(np.stack([names % self._allowed.shape[1], names // self._allowed.shape[1]], axis=1))
            held[held] = roomy[which].all(axis=1)
        return np.asarray(held)

    def _roomy(self, cells: npt.NDArray[np.int64]) -> BoolArray:
        """Return in which cells, (column, row), a place is certainly far enough from every occupied cell."""
        places = ((cells[:, None] + _IN_A_CELL) * self._resolution).reshape(-1, 2)
        far = self._obstacles.distances(places) >= self._radius_m + slack_m(places, self._radius_m)
        return np.asarray(far.reshape(len(cells), -1).any(axis=1))
