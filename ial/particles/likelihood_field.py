"""`LikelihoodField`: how well a point fits the nearest obstacle, for every cell of a map."""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.contractors.kernels import kernel
from ial.errors import ConfigError
from ial.maps.occupancy_grid import OCCUPIED, OccupancyGrid


@dataclass(frozen=True)
class BeamModel:
    """The likelihood of one beam, with the names and the defaults of nav2's AMCL.

    Parameters
    ----------
    z_hit, z_rand
        Weights of the Gaussian around the nearest obstacle and of the uniform part.
    sigma_hit
        Standard deviation of the Gaussian, metres.
    laser_likelihood_max_dist
        Distances above this, and end points outside the map, count as this one; metres.
    laser_max_range
        Range over which the uniform part is spread, metres.
    max_beams
        How many beams of a scan are used at most.

    Raises
    ------
    ConfigError
        If a number is not positive and finite.
    """

    z_hit: float = 0.5
    z_rand: float = 0.5
    sigma_hit: float = 0.2
    laser_likelihood_max_dist: float = 2.0
    laser_max_range: float = 100.0
    max_beams: int = 60

    def __post_init__(self) -> None:
        for name in ("z_hit", "z_rand", "sigma_hit", "laser_likelihood_max_dist", "laser_max_range", "max_beams"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0):
                raise ConfigError(f"{name} is {value!r}; give a finite number above 0")

    def log_likelihood(self, distance_m: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """Return log(z_hit · exp(−d² / 2σ²) + z_rand / laser_max_range) for distances to the nearest obstacle."""
        distance = np.minimum(np.asarray(distance_m, dtype=np.float64), self.laser_likelihood_max_dist)
        return np.asarray(np.log(self.z_hit * np.exp(-0.5 * (distance / self.sigma_hit) ** 2) + self.z_rand / self.laser_max_range))


class LikelihoodField:
    """The log-likelihood of a beam that ends in each cell of a map.

    Distances are those between centres of cells. Poses and points are in the grid's frame, in cells.

    Parameters
    ----------
    grid
        The map.
    model
        The likelihood of one beam.

    Attributes
    ----------
    table
        float32 of shape (rows + 2, columns + 2): the map with a border of one cell, which stands for everything outside.

    Source: Thrun, Burgard and Fox, Probabilistic Robotics, 2005, table 6.3, with the logarithm of the product.
    """

    def __init__(self, grid: OccupancyGrid, model: BeamModel) -> None:
        import cv2

        free = np.ascontiguousarray(~grid.mask(OCCUPIED)).view(np.uint8)
        distance = cv2.distanceTransform(free, cv2.DIST_L2, cv2.DIST_MASK_PRECISE) * np.float32(grid.resolution)
        self.model = model
        outside = float(model.log_likelihood(model.laser_likelihood_max_dist))
        self.table: npt.NDArray[np.float32] = np.pad(model.log_likelihood(distance).astype(np.float32), 1, constant_values=outside)


@kernel
def score(table, x, y, ends, cells):  # type: ignore[no-untyped-def]
    """Return the mean log-likelihood of beams that end at (x, y) + ends[:, i].

    The cells are found first and added up then: so the compiler makes vector code of the first loop, which halves the time.

    Parameters
    ----------
    table
        That of a `LikelihoodField`.
    x, y
        Position, float32, in cells.
    ends
        End points relative to it, float32 of shape (2, n), in cells.
    cells
        Room for n int32.
    """
    flat = table.reshape(-1)
    stride = np.int32(table.shape[1])
    right, top = np.float32(table.shape[1] - 1), np.float32(table.shape[0] - 1)
    x, y = x + np.float32(1.0), y + np.float32(1.0)  # the border
    for i in range(len(cells)):
        column = np.int32(min(max(x + ends[0, i], np.float32(0.0)), right))
        row = np.int32(min(max(y + ends[1, i], np.float32(0.0)), top))
        cells[i] = row * stride + column
    total = 0.0
    for i in range(len(cells)):
        total += flat[np.uint32(cells[i])]
    return total / len(cells)
