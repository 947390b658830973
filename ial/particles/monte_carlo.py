"""`MonteCarlo`: the particle filter to compare with. It returns a cloud of weighted guesses, and no guarantee."""

import math
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import FloatArray
from ial.contractors.kernels import kernel
from ial.contractors.threads import run
from ial.datasets.scan import LaserScan
from ial.errors import ConfigError
from ial.keys.key import key
from ial.keys.kind import Number, Whole
from ial.keys.record import Part, Record
from ial.maps.grids.occupancy_grid import FREE, OccupancyGrid, check_usable
from ial.particles.likelihood_field import BeamModel, LikelihoodField, score_turned
from ial.particles.odometry_model import OdometryModel
from ial.particles.resampling import effective, low_variance
from ial.pose import Pose, wrap

_HALVINGS = 10  # of the interval in which the exponent of the likelihoods lies


_SHARE = Number(least=0.0, most=1.0)
_NOISE = Number(least=0.0)


@dataclass(frozen=True)
class MonteCarloConfig(Record):
    """The configuration of a particle filter."""

    particles: int = field(default=5000, metadata=key(Whole(1), "how many there are"))
    first_particles: int = field(default=100_000, metadata=key(Whole(1), "how many are drawn at the start, where little is known"))
    beam: BeamModel = field(default_factory=BeamModel, metadata=key(Part(BeamModel), "the likelihood of a beam"))
    odometry: OdometryModel = field(default_factory=OdometryModel, metadata=key(Part(OdometryModel), "the noise of the odometry"))
    least_effective: float = field(
        default=0.3,
        metadata=key(
            _SHARE,
            "where a scan would leave fewer effective particles than this share, its likelihoods are raised to a smaller power;"
            " 0 never does",
        ),
    )
    resample_below: float = field(
        default=0.5,
        metadata=key(_SHARE, "particles are drawn anew when fewer than this share of them are effective; 1 always does"),
    )
    roughening_m: float = field(
        default=0.04, metadata=key(_NOISE, "standard deviation of the noise that keeps the places of drawn particles apart", "m")
    )
    roughening_rad: float = field(default=math.radians(2.0), metadata=key(_NOISE, "the same of their headings", "rad"))
    recovery_alpha_slow: float = field(
        default=0.0,
        metadata=key(
            _SHARE,
            "rate of the slower of two averages of the likelihood, whose ratio says how many random particles to mix in; 0 mixes in none,"
            " as nav2 does",
        ),
    )
    recovery_alpha_fast: float = field(default=0.0, metadata=key(_SHARE, "rate of the faster average, which is not below the other"))

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.recovery_alpha_slow > self.recovery_alpha_fast:
            raise ConfigError("recovery_alpha_slow exceeds recovery_alpha_fast; the slow average changes at the smaller rate")


@dataclass(frozen=True)
class Cloud:
    """A particle filter's answer, in numbers.

    Parameters
    ----------
    pose
        The weighted mean, ``T_map_base``.
    deviation_m, deviation_rad
        Standard deviations of the position (the larger of x and y) and of the heading.
    effective
        How many equal particles would be as good, before they were drawn anew.
    """

    pose: Pose
    deviation_m: float
    deviation_rad: float
    effective: float


@kernel
def _weigh(start, stop, table, resolution, poses, ends, scores):  # type: ignore[no-untyped-def]
    cells = np.empty(ends.shape[1], dtype=np.int32)
    for row in range(start, stop):
        x, y, heading = poses[row]
        scores[row] = score_turned(table, np.float32(x / resolution), np.float32(y / resolution), heading, ends, cells)


@kernel
def _power(logarithms, weights, share, rounds):  # type: ignore[no-untyped-def]
    """Return the largest power up to 1 of the likelihoods at which enough particles are effective."""
    low, high, power = 0.0, 1.0, 1.0
    for _ in range(rounds):
        total = squares = 0.0
        for i in range(len(weights)):
            weight = weights[i] * math.exp(power * logarithms[i])
            total += weight
            squares += weight * weight
        if total * total >= share * len(weights) * squares:
            low = power
            if power == 1.0:
                return power
        else:
            high = power
        power = 0.5 * (low + high)
    return low


class MonteCarlo:
    """Monte Carlo localization with a likelihood field: particles that move with the odometry, are weighed by scans, and drawn anew.

    The same seed gives the same bits on any number of threads.

    Parameters
    ----------
    grid
        The map.
    config
        Everything that can be chosen.
    seed
        Of all random numbers.
    initial
        A pose ``T_map_base`` to start at, with `initial_deviation`; anywhere in the free space by default.
    initial_deviation
        Standard deviations of the position (m) and of the heading (rad) around it.

    Raises
    ------
    MapError
        If the map has no occupied or no free cell.

    Examples
    --------
    >>> from ial.datasets.sample import sample_grid, sample_recording
    >>> from ial.particles import MonteCarlo
    >>> particles = MonteCarlo(sample_grid(), seed=1)
    >>> for reading in sample_recording().readings():
    ...     cloud = particles.update(reading.odometry.pose, reading.scan)
    >>> round(cloud.pose.x), round(cloud.pose.y)
    (16, -10)

    Source: Thrun, Burgard and Fox, Probabilistic Robotics, 2005, tables 8.2 and 8.3; Fox 2001 for the size of the first draw.
    """

    def __init__(
        self,
        grid: OccupancyGrid,
        config: MonteCarloConfig | None = None,
        seed: int = 0,
        initial: Pose | None = None,
        initial_deviation: tuple[float, float] = (0.0, 0.0),
    ) -> None:
        check_usable(grid)
        self.grid = grid
        self.config = config or MonteCarloConfig()
        self.field = LikelihoodField(grid, self.config.beam)
        self._random = np.random.default_rng(seed)
        self._free = np.flatnonzero(grid.mask(FREE))
        self._before: Pose | None = None
        self._slow = self._fast = 0.0
        self.poses = self._anywhere(self.config.first_particles)
        if initial is not None:
            at = grid.pose_to_grid(initial)
            spread = np.array([initial_deviation[0], initial_deviation[0], initial_deviation[1]])
            self.poses = np.array([at.x, at.y, at.theta]) + spread * self._random.standard_normal((self.config.particles, 3))
        self.weights = np.full(len(self.poses), 1.0 / len(self.poses))

    def __repr__(self) -> str:
        return f"<MonteCarlo in {self.grid!r}: {len(self.poses)} particles>"

    def update(self, odometry: Pose, scan: LaserScan) -> Cloud:
        """Take the odometry and a scan; return the mean of the cloud.

        Parameters
        ----------
        odometry
            ``T_odom_base`` at the scan.
        scan
            Its hits are used, at most `max_beams` of them, spread evenly; without any the particles only move.
        """
        if self._before is not None:
            self.config.odometry.drive(self.poses, self._before.inverse() @ odometry, self._random)
        self._before = odometry
        ends = self.field.ends(scan)
        if ends.size:
            self._weigh(ends)
        cloud = self._cloud()
        if len(self.weights) != self.config.particles or cloud.effective < self.config.resample_below * len(self.weights):
            self._draw()
        return cloud

    def _weigh(self, ends: npt.NDArray[np.float32]) -> None:
        config, beams = self.config, ends.shape[1]
        scores = np.empty(len(self.poses))
        run(_weigh, len(scores), self.field.table, self.grid.resolution, self.poses, ends, scores, minimum=512)
        product = config.beam.laser_model_type == "likelihood_field_prob"
        if config.recovery_alpha_fast:
            self._average(float(self.weights @ (np.exp(scores) if product else scores)))
        if product:
            logarithms = beams * (scores - scores.max())
            power = _power(logarithms, self.weights, config.least_effective, _HALVINGS) if config.least_effective else 1.0
            self.weights *= np.exp(power * logarithms)
        else:
            self.weights *= 1.0 + beams * scores
        self.weights /= self.weights.sum()

    def _average(self, likelihood: float) -> None:
        """Take the mean likelihood of a beam into both averages."""
        config = self.config
        self._slow += config.recovery_alpha_slow * (likelihood - self._slow) if self._slow else likelihood
        self._fast += config.recovery_alpha_fast * (likelihood - self._fast) if self._fast else likelihood

    def _draw(self) -> None:
        config, random = self.config, self._random
        rows = low_variance(self.weights, config.particles, random)
        poses = self.poses[rows]
        spread = np.array([config.roughening_m, config.roughening_m, config.roughening_rad])
        if spread.any():
            poses += spread * random.standard_normal(poses.shape)
        strangers = round(max(0.0, 1.0 - self._fast / self._slow) * config.particles) if self._slow else 0
        if strangers:
            poses[random.choice(len(poses), strangers, replace=False)] = self._anywhere(strangers)
            self._slow = self._fast = 0.0
        self.poses = poses
        self.weights = np.full(len(poses), 1.0 / len(poses))

    def _anywhere(self, count: int) -> FloatArray:
        """Return particles spread evenly over the free cells and all headings."""
        cells = self._random.choice(self._free, count)
        rows, columns = np.divmod(cells, self.grid.columns)
        within = self._random.random((count, 3))
        theta = 2.0 * math.pi * within[:, 2] - math.pi
        return np.column_stack([(columns + within[:, 0]) * self.grid.resolution, (rows + within[:, 1]) * self.grid.resolution, theta])

    def _cloud(self) -> Cloud:
        weights, (x, y, theta) = self.weights, self.poses.T
        mean_x, mean_y = float(weights @ x), float(weights @ y)
        c, s = float(weights @ np.cos(theta)), float(weights @ np.sin(theta))
        variance = max(float(weights @ np.square(x - mean_x)), float(weights @ np.square(y - mean_y)))
        spread = math.sqrt(max(0.0, -2.0 * math.log(min(1.0, math.hypot(c, s))))) if (c, s) != (0.0, 0.0) else math.inf
        pose = self.grid.pose_to_map(Pose(mean_x, mean_y, wrap(math.atan2(s, c))))
        return Cloud(pose, math.sqrt(variance), spread, effective(weights))
