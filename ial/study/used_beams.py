"""`UsedBeams`: the beams of a scan that the guarantee speaks about, straight from the recorded numbers.

This begins the slow, obvious twin of the localizer's test. It follows docs/guarantee.md and shares no code with the search that it judges.
"""

import functools
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.datasets.scan import LaserScan
from ial.lidar.configuration.config import Bounds, LocalizerConfig
from ial.study.possible_motions import possible_motions

_MOST_TURNS = 100  # to each side; an endless beam is not worth more

FloatArray = npt.NDArray[np.float64]
IndexArray = npt.NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class UsedBeams:
    """The used beams of a scan, n of them, seen from the base at the scan's stamp; hits come first.

    Parameters
    ----------
    numbers
        Which beams of the scan they are, shape (n,).
    readings
        What the hits read (m), float64 of shape (hits,).
    bearings
        The direction of each beam in the base frame at the time of the beam (rad), float64 of shape (n,).
    laser
        Position of the laser in the base frame (m), float64 of shape (2,).
    moves
        How the base may have moved until each beam, (x, y, θ) in its frame at the stamp, what was recorded first; float64 of shape
        (n, m, 3). Zeros, m = 1, where no motion during the scan is taken out.
    rays, lengths
        The rows of the beams that are looked along, shape (rays,), and how far nothing stands along each (m).
    bounds
        The errors of this lidar.
    margin_m
        How far beside a ray the map may be wrong.
    """

    numbers: IndexArray
    readings: FloatArray
    bearings: FloatArray
    laser: FloatArray
    moves: FloatArray
    rays: IndexArray
    lengths: FloatArray
    bounds: Bounds
    margin_m: float

    def __len__(self) -> int:
        return len(self.numbers)

    def __repr__(self) -> str:
        return f"<UsedBeams: {len(self)}>"

    @classmethod
    def of(cls, scan: LaserScan, config: LocalizerConfig) -> "UsedBeams":
        """Return the beams of a scan that a configuration uses, as docs/guarantee.md defines them."""
        bounds, free = config.bounds.of(scan.frame_id), config.free_space
        ranges = scan.ranges.astype(np.float64)
        hits = spread(np.flatnonzero((ranges > 0.0) & (ranges >= scan.range_min) & (ranges < scan.range_max)), config.max_beams)
        rays, alone = np.empty(0, dtype=np.intp), np.empty(0, dtype=np.intp)
        if free.use:
            rays = spread(np.arange(len(hits)), free.max_rays)
            if free.no_return_m > 0.0:
                alone = spread(np.flatnonzero(ranges >= scan.range_max), free.max_rays)
        numbers = np.concatenate([hits, alone])
        farthest = np.full(len(alone), min(free.no_return_m, scan.range_max))
        turned = scan.angle_min + numbers * scan.angle_increment
        return cls(
            numbers=numbers,
            readings=ranges[hits],
            bearings=scan.mounting.yaw + (-turned if scan.mounting.upside_down else turned),
            laser=np.array([scan.mounting.x, scan.mounting.y]),
            moves=_moves(scan, numbers, config),
            rays=np.concatenate([rays, len(hits) + np.arange(len(alone))]),
            lengths=np.concatenate([ranges[hits][rays], farthest]) - bounds.range_error_m - free.margin_m,
            bounds=bounds,
            margin_m=free.margin_m,
        )

    def turns(self, spacing_m: float) -> FloatArray:
        """Return errors of the bearing to try, as shares of its bound, 0 first; so far apart at most where the longest beam ends."""
        farthest = float(self.readings.max(initial=0.0)) + self.bounds.range_error_m
        farthest = max(farthest, float(self.lengths.max(initial=0.0)))
        count = int(min(np.ceil(farthest * self.bounds.bearing_error_rad / spacing_m), _MOST_TURNS))
        shares = np.arange(1, count + 1) / max(count, 1)
        return np.concatenate([[0.0], shares, -shares])

    def seen(self, turns: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return where beams may have begun, and which way they may have gone, in the base frame at the stamp.

        What belongs together is together: a motion until the beam, from where the laser was then, and which way it looked.

        Parameters
        ----------
        turns
            Errors of the bearing, as shares of its bound, shape (k,).

        Returns
        -------
        origins, angles
            float64 of shape (n, m · k, 2) and (n, m · k). The first k are those of the recorded motion.
        """
        moves = self.moves
        cos, sin = np.cos(moves[..., 2]), np.sin(moves[..., 2])
        x, y = self.laser
        origins = moves[..., :2] + np.stack([cos * x - sin * y, sin * x + cos * y], axis=-1)
        angles = moves[..., 2, None] + self.bearings[:, None, None] + self.bounds.bearing_error_rad * turns
        count = moves.shape[1] * len(turns)
        return np.repeat(origins, len(turns), axis=1), angles.reshape(len(self), count)

    @functools.cached_property
    def middle(self) -> tuple[FloatArray, FloatArray]:
        """Where each beam began and which way it went by the recorded numbers, of shape (n, 2) and (n,)."""
        origins, angles = self.seen(np.zeros(1))
        return origins[:, 0], angles[:, 0]

    @property
    def ends(self) -> FloatArray:
        """Where the hits ended by the recorded numbers, in the base frame at the stamp, shape (hits, 2)."""
        origins, angles = (each[: len(self.readings)] for each in self.middle)
        return np.asarray(origins + self.readings[:, None] * np.stack([np.cos(angles), np.sin(angles)], axis=1))


def in_grid(poses: FloatArray, origins: FloatArray, angles: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return points and directions of the base frame as seen from the grid's frame, row by row.

    Parameters
    ----------
    poses
        (x, y, θ) of the base, shape (n, 3).
    origins, angles
        Shapes (n, …, 2) and (n, …).
    """
    x, y, theta = (poses[:, axis].reshape(-1, *(1,) * (angles.ndim - 1)) for axis in range(3))
    cos, sin = np.cos(theta), np.sin(theta)
    u, v = origins[..., 0], origins[..., 1]
    return np.stack([x + cos * u - sin * v, y + sin * u + cos * v], axis=-1), theta + angles


def spread(rows: IndexArray, most: int) -> IndexArray:
    """Return at most so many of some rows, evenly: of n those numbered ⌊i · n / most⌋."""
    if len(rows) <= most:
        return rows
    return rows[[i * len(rows) // most for i in range(most)]]


def _moves(scan: LaserScan, numbers: IndexArray, config: LocalizerConfig) -> FloatArray:
    """Return how the base may have moved until each beam, (x, y, θ), what was recorded first."""
    if not config.deskew or scan.sweep is None or len(scan) < 2:
        return np.zeros((len(numbers), 1, 3))
    return possible_motions(scan.sweep, config.bounds.motion, numbers / (len(scan) - 1))
