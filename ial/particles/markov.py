"""`MarkovLocalization`: a histogram over a grid of poses: what active localization by entropy is built on, here to compare with.

After Fox, Burgard, Thrun: Markov localization for mobile robots in dynamic environments (1999).
"""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy import ndimage

from ial.datasets.motion import Motion
from ial.datasets.scan import LaserScan
from ial.errors import ConfigError, MapError
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid
from ial.maps.grids.ray_casting import cast_rays

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True)
class HistogramOptions:
    """How fine the histogram is, and what a reading is worth.

    Parameters
    ----------
    cell_m
        The width of a cell of positions.
    headings
        How many headings there are; beams are compared in as many directions.
    beams
        How many beams of a scan are used, at most; a divisor of the headings.
    sigma_m
        The standard deviation of a range, and of what a cell is wide.
    unexplained
        The part of readings that nothing explains.

    Raises
    ------
    ConfigError
        If a number cannot be meant.
    """

    cell_m: float = 0.25
    headings: int = 36
    beams: int = 12
    sigma_m: float = 0.25
    unexplained: float = 0.1

    def __post_init__(self) -> None:
        if not (self.cell_m > 0.0 and self.sigma_m > 0.0 and 0.0 < self.unexplained < 1.0):
            raise ConfigError(
                f"cells of {self.cell_m:g} m, sigma {self.sigma_m:g} m and {self.unexplained:g} unexplained; give positive lengths and "
                "a part of 1"
            )
        if self.headings < 4 or self.beams < 1 or self.headings % self.beams:
            raise ConfigError(f"{self.headings} headings and {self.beams} beams; give at least 4 headings, and beams that divide them")


class MarkovLocalization:
    """A probability for each cell of poses.

    Parameters
    ----------
    grid
        The map.
    range_m
        How far the lidar sees.
    options
        How fine it is.

    Raises
    ------
    MapError
        If no cell is free.

    Attributes
    ----------
    belief
        The probability of each pose, float64 of shape (headings, rows, columns).
    """

    def __init__(self, grid: OccupancyGrid, range_m: float, options: HistogramOptions | None = None) -> None:
        self.grid, self.range_m = grid, range_m
        self.options = HistogramOptions() if options is None else options
        width = self.options.cell_m
        self.rows, self.columns = (max(1, math.floor(side / width)) for side in (grid.height_m, grid.width_m))
        x, y = np.meshgrid((np.arange(self.columns) + 0.5) * width, (np.arange(self.rows) + 0.5) * width)
        cell = (np.floor(y / grid.resolution).astype(np.int64), np.floor(x / grid.resolution).astype(np.int64))
        self.free = grid.cells[cell] == FREE
        if not self.free.any():
            raise MapError(f"no cell of {width:g} m has a free middle, so the robot can be nowhere; use smaller cells")
        turns = 2.0 * math.pi * np.arange(self.options.headings) / self.options.headings
        angles = np.arctan2(np.sin(turns), np.cos(turns))
        ranges = cast_rays(grid.mask(OCCUPIED), grid.resolution, x[None], y[None], angles[:, None, None], range_m)
        self.ranges = np.minimum(ranges, range_m)
        self.belief = np.broadcast_to(self.free, self.ranges.shape) / (self.free.sum() * self.options.headings)

    def __repr__(self) -> str:
        return f"<MarkovLocalization of {self.options.headings} × {self.rows} × {self.columns} poses, entropy {self.entropy:.3g}>"

    @property
    def entropy(self) -> float:
        """The entropy of the belief, in nats."""
        held = self.belief[self.belief > 0.0]
        return float(-(held * np.log(held)).sum())

    def keep(self, possible: npt.NDArray[np.bool_]) -> None:
        """Leave out the poses that are known to be impossible; bool in the shape of the belief. If none is left, it keeps all."""
        kept = self.belief * possible
        if kept.sum() > 0.0:
            self.belief = kept / kept.sum()

    def predict(self, motion: Motion) -> None:
        """Move the belief by the middle of a motion, and spread it by half of its width."""
        (dx, dy, turn), (wide, high, arc) = (0.5 * (motion.lower + motion.upper)).tolist(), (0.5 * (motion.upper - motion.lower)).tolist()
        count = self.options.headings
        moved = np.empty_like(self.belief)
        for number in range(count):
            heading = 2.0 * math.pi * number / count
            x, y = math.cos(heading) * dx - math.sin(heading) * dy, math.sin(heading) * dx + math.cos(heading) * dy
            shift = (y / self.options.cell_m, x / self.options.cell_m)
            moved[number] = ndimage.shift(self.belief[number], shift, order=1, mode="constant")
        whole, part = divmod(turn * count / (2.0 * math.pi), 1.0)
        moved = (1.0 - part) * np.roll(moved, int(whole), axis=0) + part * np.roll(moved, int(whole) + 1, axis=0)
        spread = max(wide, high) / (2.0 * self.options.cell_m)
        sigmas = (max(arc * count / (4.0 * math.pi), 0.3), max(spread, 0.3), max(spread, 0.3))
        moved = ndimage.gaussian_filter(moved, sigmas, mode=("wrap", "constant", "constant")) * self.free
        if moved.sum() > 0.0:
            self.belief = moved / moved.sum()

    def update(self, scan: LaserScan) -> None:
        """Weigh the belief by a scan."""
        likelihood = np.ones_like(self.belief)
        count = self.options.headings
        bearings = scan.angle_min + scan.angle_increment * np.arange(len(scan.ranges)) + scan.mounting.pose.theta
        for beam in range(0, count, count // self.options.beams):
            wanted = 2.0 * math.pi * beam / count
            away = np.abs(np.angle(np.exp(1j * (bearings - wanted))))
            nearest = int(np.argmin(away))
            if away[nearest] > math.pi / count or np.isnan(scan.ranges[nearest]):
                continue
            read = min(float(scan.ranges[nearest]), self.range_m)
            expected = np.roll(self.ranges, -beam, axis=0)
            likelihood *= self.likelihood(read - expected)
        weighed = self.belief * likelihood
        if weighed.sum() > 0.0:
            self.belief = weighed / weighed.sum()

    def likelihood(self, difference: FloatArray) -> FloatArray:
        """Return the likelihood of readings that differ so much (m) from what is expected, up to a factor."""
        part = self.options.unexplained
        return np.asarray(part + (1.0 - part) * np.exp(-0.5 * (difference / self.options.sigma_m) ** 2))

    def likely(self, most: int) -> tuple[npt.NDArray[np.int64], FloatArray]:
        """Return the likeliest poses, (heading, row, column) of shape (n, 3), and their shares of what these have together."""
        flat = self.belief.reshape(-1)
        chosen = np.argsort(-flat, kind="stable")[:most]
        chosen = chosen[flat[chosen] > 0.0]
        weights = flat[chosen]
        return np.column_stack(np.unravel_index(chosen, self.belief.shape)), weights / weights.sum()

    def expected_entropy(self, poses: npt.NDArray[np.int64], weights: FloatArray, turn_rad: float, distance_m: float) -> float:
        """Return the entropy that is to be expected after a turn, a straight way and a scan.

        The belief is taken as so many poses with weights; each of them in turn is taken for true, and what it would read there is compared
        with what the others would.
        """
        count, width = self.options.headings, self.options.cell_m
        heading = 2.0 * math.pi * poses[:, 0] / count + turn_rad
        turned = np.round(heading * count / (2.0 * math.pi)).astype(np.int64) % count
        row = np.clip(np.floor(poses[:, 1] + 0.5 + distance_m / width * np.sin(heading)).astype(np.int64), 0, self.rows - 1)
        column = np.clip(np.floor(poses[:, 2] + 0.5 + distance_m / width * np.cos(heading)).astype(np.int64), 0, self.columns - 1)
        every = np.arange(0, count, count // self.options.beams)
        readings = self.ranges[(turned[:, None] + every) % count, row[:, None], column[:, None]]
        logs = np.zeros((len(poses), len(poses)))
        for beam in range(len(every)):
            logs += np.log(self.likelihood(readings[:, None, beam] - readings[None, :, beam]))
        posterior = weights * np.exp(logs)
        posterior /= posterior.sum(axis=1, keepdims=True)
        entropies = -(posterior * np.log(np.maximum(posterior, 1e-300))).sum(axis=1)
        return float((weights * entropies).sum())
