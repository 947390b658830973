"""`Beams`: the evidence of one scan, in the frame of the robot."""

import dataclasses
import functools
import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import FloatArray
from ial.datasets.scan import BeamClass, LaserScan, Mounting
from ial.lidar.config import Bounds, FreeSpace, LocalizerConfig
from ial.lidar.rays import Rays

_ROUND_UP = 1.0 + 2.0**-40  # far above the rounding of the few operations that make a half-width


@dataclass(frozen=True, eq=False)
class Beams:
    """The used beams of a scan: where each ends relative to the robot, and by how much that may be wrong.

    Parameters
    ----------
    ends
        Nominal end point of each beam in the base frame (m), float64 of shape (n, 2).
    directions
        Direction of each beam in the base frame, unit vectors, float64 of shape (n, 2).
    errors
        Half-widths (m) of the region in which the true end point lies, along the beam and across it, float64 of shape (n, 2). They enclose
        the range error, the bearing error, and all rounding from the recorded numbers to `ends` and `directions`.
    outliers
        q: how many of these beams may be bad.
    rays
        What the scan says about free space; None where that is not used.
    margin
        If given, q is chosen at the scan: the smallest that leaves a pose, plus this, and at most `outliers`.
    jump
        If given, and q is chosen at the scan: it exceeds that of the scan before by at most this.
    """

    ends: FloatArray
    directions: FloatArray
    errors: FloatArray
    outliers: int
    rays: Rays | None = None
    margin: int | None = None
    jump: int | None = None

    def __len__(self) -> int:
        """Return how many beams are used, those without return counted whose rays are."""
        return len(self.ends) + (0 if self.rays is None else int((self.rays.beams < 0).sum()))

    @property
    def informative(self) -> bool:
        """Whether the scan can exclude any pose at all: with as many outliers as beams it cannot."""
        return self.outliers < len(self)

    def allowing(self, outliers: int) -> "Beams":
        """Return the same evidence with a fixed number of beams that may be bad."""
        return dataclasses.replace(self, outliers=outliers, margin=None, jump=None)


def scan_beams(scan: LaserScan, config: LocalizerConfig) -> Beams:
    """Return the evidence of a scan as a configuration wants it used."""
    automatic = config.outliers == "auto"
    outliers = config.max_outliers if config.outliers == "auto" else config.outliers
    beams = select_beams(scan, config.bounds, outliers, config.max_beams, config.free_space)
    if not automatic:
        return beams
    margin, jump = (_number(share, len(beams)) for share in (config.outlier_margin, config.max_jump))
    # With as many outliers as beams a scan would say nothing; what it needs is always fewer.
    most = max(0, min(beams.outliers, len(beams) - 1))
    return dataclasses.replace(beams, outliers=most, margin=margin, jump=jump)


def select_beams(scan: LaserScan, bounds: Bounds, outliers: int | float, max_beams: int, free_space: FreeSpace | None = None) -> Beams:
    """Return the evidence of a scan: its hits, at most `max_beams` of them, spread evenly, and what it says about free space.

    The true reading lies in ``y ± range_error`` and the true bearing in ``β ± bearing_error``. Turning a reading of length Y by an angle of
    at most δ moves its end by at most Yδ across the beam and by Yδ²/2 along it.

    Source: Guyonneau et al. 2014, eq. 6, in the axes of REP-103.
    """
    classes = scan.classes()
    used = _spread(np.flatnonzero(classes == BeamClass.HIT), max_beams)
    angle, turn, units = _directions(len(scan), scan.angle_min, scan.angle_increment, scan.mounting, bounds.bearing_error_rad)
    reading = scan.ranges[used].astype(np.float64)
    directions = units[used]
    ends = np.array([scan.mounting.x, scan.mounting.y]) + reading[:, None] * directions

    radial = bounds.range_error_m + scan.range_slack()[used]
    reach = reading + radial
    rounding = 2.0**-48 * (reach + abs(scan.mounting.x) + abs(scan.mounting.y))  # of the products and sums that made `ends`
    errors = np.stack([radial + 0.5 * reach * turn[used] ** 2, reach * turn[used]], axis=1) + rounding[:, None]
    rays = None
    if free_space is not None and free_space.use:
        among = _spread(np.arange(len(used)), free_space.max_rays)
        alone = np.flatnonzero(classes == BeamClass.NO_RETURN) if free_space.no_return_m else np.empty(0, dtype=np.intp)
        alone = _spread(alone, free_space.max_rays)
        farthest = min(free_space.no_return_m, scan.range_max) - bounds.range_error_m
        lengths = np.concatenate([reading[among] - radial[among], np.full(len(alone), farthest)]) - free_space.margin_m
        rows = np.concatenate([used[among], alone])
        numbers = np.concatenate([among, np.full(len(alone), -1)]).astype(np.int64)
        origin = np.array([scan.mounting.x, scan.mounting.y])
        rays = Rays(origin, angle[rows], turn[rows], lengths * (1.0 - 2.0**-40), numbers, free_space.margin_m)
    beams = Beams(ends, directions, errors * _ROUND_UP, 0, rays)
    return dataclasses.replace(beams, outliers=_number(outliers, len(beams)))


def _spread(rows: npt.NDArray[np.intp], most: int) -> npt.NDArray[np.intp]:
    return rows if len(rows) <= most else rows[np.arange(most) * len(rows) // most]


@functools.lru_cache(maxsize=16)  # most scans of a lidar are alike in this
def _directions(
    count: int, angle_min: float, increment: float, mounting: Mounting, bearing_error: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the direction of each beam in the base frame, by how much it may be wrong (rad), and the unit vector that points there."""
    lower, upper = LaserScan(0, np.ones(count, np.float32), angle_min, increment, mounting=mounting).bearings()
    angle = mounting.yaw + 0.5 * (lower + upper)
    turn = bearing_error + 0.5 * (upper - lower) + _angle_rounding(angle)
    return angle, turn, np.stack([np.cos(angle), np.sin(angle)], axis=1)


def _number(share: int | float, beams: int) -> int:
    return share if isinstance(share, int) else math.floor(share * beams)


def _angle_rounding(angle: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Return a bound of the rounding of the angle itself and of its sine and cosine, as an angle (rad)."""
    return 2.0**-48 * (1.0 + np.abs(angle))
