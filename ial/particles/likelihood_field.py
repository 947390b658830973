"""`LikelihoodField`: how well a point fits the nearest obstacle, for every cell of a map."""

import math
from dataclasses import dataclass, field
from typing import Literal, get_args

import numpy as np
import numpy.typing as npt

from ial.contractors.kernels import kernel
from ial.datasets.scan import LaserScan
from ial.keys.key import key
from ial.keys.kind import Number, Whole, Word
from ial.keys.record import Record
from ial.lidar.configuration.config import Bounds
from ial.lidar.evidence.beams import select_beams
from ial.maps.grids.occupancy_grid import OCCUPIED, OccupancyGrid

_POSITIVE = Number(above=0.0)

Together = Literal["likelihood_field", "likelihood_field_prob"]


@dataclass(frozen=True)
class BeamModel(Record):
    """The likelihood of one beam, with the names and the defaults of nav2's AMCL."""

    z_hit: float = field(default=0.5, metadata=key(_POSITIVE, "weight of the Gaussian around the nearest obstacle"))
    z_rand: float = field(default=0.5, metadata=key(_POSITIVE, "weight of the uniform part"))
    sigma_hit: float = field(default=0.2, metadata=key(_POSITIVE, "standard deviation of the Gaussian", "m"))
    laser_likelihood_max_dist: float = field(
        default=2.0, metadata=key(_POSITIVE, "distances above this, and end points outside the map, count as this one", "m")
    )
    laser_max_range: float = field(default=100.0, metadata=key(_POSITIVE, "range over which the uniform part is spread", "m"))
    max_beams: int = field(default=60, metadata=key(Whole(1), "how many beams of a scan are used at most"))
    laser_model_type: Together = field(
        default="likelihood_field_prob",
        metadata=key(
            Word(get_args(Together)),
            'how beams go together: ``"likelihood_field_prob"`` multiplies their likelihoods, ``"likelihood_field"`` adds the cubes of them'
            " to 1, which is nav2's default",
        ),
    )

    def likelihood(self, distance_m: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """Return z_hit · exp(−d² / 2σ²) + z_rand / laser_max_range for distances to the nearest obstacle."""
        distance = np.minimum(np.asarray(distance_m, dtype=np.float64), self.laser_likelihood_max_dist)
        return np.asarray(self.z_hit * np.exp(-0.5 * (distance / self.sigma_hit) ** 2) + self.z_rand / self.laser_max_range)

    def term(self, distance_m: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """Return what a beam adds to the score of a pose: the logarithm of its likelihood, or its cube."""
        likelihood = self.likelihood(distance_m)
        return np.asarray(np.log(likelihood) if self.laser_model_type == "likelihood_field_prob" else likelihood**3)


class LikelihoodField:
    """What a beam that ends in a cell says, for each cell of a map: `BeamModel.term`.

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

    Source: Thrun, Burgard and Fox, Probabilistic Robotics, 2005, table 6.3.
    """

    def __init__(self, grid: OccupancyGrid, model: BeamModel) -> None:
        import cv2

        free = np.ascontiguousarray(~grid.mask(OCCUPIED)).view(np.uint8)
        distance = cv2.distanceTransform(free, cv2.DIST_L2, cv2.DIST_MASK_PRECISE) * np.float32(grid.resolution)
        self.model = model
        self.resolution = grid.resolution
        outside = float(model.term(model.laser_likelihood_max_dist))
        self.table: npt.NDArray[np.float32] = np.pad(model.term(distance).astype(np.float32), 1, constant_values=outside)

    def ends(self, scan: LaserScan) -> npt.NDArray[np.float32]:
        """Return where a scan's hits end relative to the robot, at most `max_beams` of them, spread evenly; shape (2, n), in cells."""
        ends = select_beams(scan, Bounds(), 0, self.model.max_beams).ends / self.resolution
        return np.ascontiguousarray(ends.T, dtype=np.float32)


@kernel
def score(table, x, y, ends, cells):  # type: ignore[no-untyped-def]
    """Return the mean term of beams that end at (x, y) + ends[:, i].

    The cells are computed first and added up then: so the compiler makes vector code of the first loop, which halves the time.

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
    ex, ey = ends[0], ends[1]
    for i in range(len(cells)):
        cells[i] = _cell(table, x + ex[i], y + ey[i])
    return _mean(table, cells)


@kernel
def score_turned(table, x, y, heading, ends, cells):  # type: ignore[no-untyped-def]
    """Return the same for a robot at (x, y) with a heading, and ends relative to the robot."""
    c, s = np.float32(math.cos(heading)), np.float32(math.sin(heading))
    ex, ey = ends[0], ends[1]
    for i in range(len(cells)):
        cells[i] = _cell(table, x + c * ex[i] - s * ey[i], y + s * ex[i] + c * ey[i])
    return _mean(table, cells)


@kernel
def _cell(table, x, y):  # type: ignore[no-untyped-def]
    """Return where in a table a point is, drawn in to its border."""
    column = np.int32(min(max(x + np.float32(1.0), np.float32(0.0)), np.float32(table.shape[1] - 1)))
    row = np.int32(min(max(y + np.float32(1.0), np.float32(0.0)), np.float32(table.shape[0] - 1)))
    return row * np.int32(table.shape[1]) + column


@kernel
def _mean(table, cells):  # type: ignore[no-untyped-def]
    flat = table.reshape(-1)
    total = 0.0
    for i in range(len(cells)):
        total += flat[np.uint32(cells[i])]
    return total / len(cells)
