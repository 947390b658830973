"""`Beams`: the evidence of one scan, in the frame of the robot."""

import dataclasses
import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import FloatArray
from ial.datasets.scan import BeamClass, LaserScan
from ial.lidar.config import Bounds, LocalizerConfig

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
    margin
        If given, q is chosen at the scan: the smallest that leaves a pose, plus this, and at most `outliers`.
    jump
        If given, and q is chosen at the scan: it exceeds that of the scan before by at most this.
    """

    ends: FloatArray
    directions: FloatArray
    errors: FloatArray
    outliers: int
    margin: int | None = None
    jump: int | None = None

    def __len__(self) -> int:
        return len(self.ends)

    @property
    def informative(self) -> bool:
        """Whether the scan can exclude any pose at all: with as many outliers as beams it cannot."""
        return self.outliers < len(self)


def scan_beams(scan: LaserScan, config: LocalizerConfig) -> Beams:
    """Return the evidence of a scan as a configuration wants it used."""
    if config.outliers != "auto":
        return select_beams(scan, config.bounds, config.outliers, config.max_beams)
    beams = select_beams(scan, config.bounds, config.max_outliers, config.max_beams)
    margin, jump = (_number(share, len(beams)) for share in (config.outlier_margin, config.max_jump))
    return dataclasses.replace(beams, margin=margin, jump=jump)


def select_beams(scan: LaserScan, bounds: Bounds, outliers: int | float, max_beams: int) -> Beams:
    """Return the evidence of a scan: its hits, at most `max_beams` of them, spread evenly.

    The true reading lies in ``y ± range_error`` and the true bearing in ``β ± bearing_error``. Turning a reading of length Y by an angle of
    at most δ moves its end by at most Yδ across the beam and by Yδ²/2 along it.

    Source: Guyonneau et al. 2014, eq. 6, in the axes of REP-103.
    """
    hits = np.flatnonzero(scan.classes() == BeamClass.HIT)
    used = hits if len(hits) <= max_beams else hits[np.arange(max_beams) * len(hits) // max_beams]
    q = _number(outliers, len(used))

    lower, upper = (bound[used] for bound in scan.bearings())
    bearing = 0.5 * (lower + upper)
    reading = scan.ranges[used].astype(np.float64)
    angle = scan.mounting.yaw + bearing
    directions = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    ends = np.array([scan.mounting.x, scan.mounting.y]) + reading[:, None] * directions

    turn = bounds.bearing_error_rad + 0.5 * (upper - lower) + _angle_rounding(angle)
    radial = bounds.range_error_m + scan.range_slack()[used]
    reach = reading + radial
    rounding = 2.0**-48 * (reach + abs(scan.mounting.x) + abs(scan.mounting.y))  # of the products and sums that made `ends`
    errors = np.stack([radial + 0.5 * reach * turn**2, reach * turn], axis=1) + rounding[:, None]
    return Beams(ends, directions, errors * _ROUND_UP, q)


def _number(share: int | float, beams: int) -> int:
    return share if isinstance(share, int) else math.floor(share * beams)


def _angle_rounding(angle: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Return a bound of the rounding of the angle itself and of its sine and cosine, as an angle (rad)."""
    return 2.0**-48 * (1.0 + np.abs(angle))
