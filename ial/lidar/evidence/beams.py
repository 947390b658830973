"""`Beams`: the evidence of one scan, in the frame of the robot."""

import dataclasses
import functools
import math
import operator
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from ial.contractors.angles import wrapped
from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.margins import ABOVE, ROUNDINGS
from ial.contractors.paving.limits import Deadline
from ial.datasets.scan import BeamClass, LaserScan, Mounting
from ial.lidar.configuration.config import Bounds, FreeSpace, LocalizerConfig
from ial.lidar.configuration.share import Share, number_of
from ial.lidar.evidence.directions import unit_vectors
from ial.lidar.evidence.evidence import Evidence
from ial.lidar.evidence.rays import Rays
from ial.lidar.evidence.sweep import sweep_boxes
from ial.lidar.margins import ANYWHERE_M

_SEARCHING = 0.5  # the share of a scan's time that searches may take; laying out the set and telling its hypotheses apart takes the rest


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
    map_error_m
        How far the map may be wrong where a beam ends.
    margin
        If given, q is chosen at the scan: the smallest that leaves a pose, plus this, and at most `outliers`.
    jump
        If given, and q is chosen at the scan: it exceeds that of the scan before by at most this.
    deadline
        Until when poses may be searched for with this evidence; it has begun when the evidence was made.
    """

    ends: FloatArray
    directions: FloatArray
    errors: FloatArray
    outliers: int
    rays: Rays | None = None
    map_error_m: float = 0.0
    margin: int | None = None
    jump: int | None = None
    deadline: Deadline = field(default_factory=lambda: Deadline(None))

    def __post_init__(self) -> None:
        if operator.index(self.outliers) < 0:
            raise ValueError(f"the number of beams that may be bad is {self.outliers}; give at least 0")

    def __len__(self) -> int:
        """Return how many beams are used, those without return counted whose rays are."""
        return len(self.ends) + (0 if self.rays is None else int((self.rays.beams < 0).sum()))

    def __repr__(self) -> str:
        return f"<Beams: {len(self)}, of which {self.outliers} may be bad>"

    @property
    def informative(self) -> bool:
        """Whether the scan can exclude any pose at all: with as many outliers as beams it cannot."""
        return self.outliers < len(self)

    @property
    def evidence(self) -> Evidence:
        """What the beams say of where they end, as kernels take it."""
        return Evidence(self.ends, self.directions, self.errors, float(self.map_error_m), int(self.outliers))

    def allowing(self, outliers: int) -> "Beams":
        """Return the same evidence with a fixed number of beams that may be bad."""
        return dataclasses.replace(self, outliers=outliers, margin=None, jump=None)


def scan_beams(scan: LaserScan, config: LocalizerConfig) -> Beams:
    """Return the evidence of a scan as a configuration wants it used; the time that may be spent on the scan begins now."""
    deadline = Deadline(None if config.max_seconds is None else _SEARCHING * config.max_seconds)
    automatic = config.outliers == "auto"
    outliers = config.max_outliers if config.outliers == "auto" else config.outliers
    scan = scan if config.deskew or scan.sweep is None else dataclasses.replace(scan, sweep=None)
    beams = select_beams(scan, config.bounds.of(scan.frame_id), outliers, config.max_beams, config.free_space)
    beams = dataclasses.replace(beams, deadline=deadline)
    if not automatic:
        return beams
    margin, jump = (number_of(share, len(beams)) for share in (config.outlier_margin, config.max_jump))
    # With as many outliers as beams a scan would say nothing; what it needs is always fewer.
    most = max(0, min(beams.outliers, len(beams) - 1))
    return dataclasses.replace(beams, outliers=most, margin=margin, jump=jump)


def select_beams(scan: LaserScan, bounds: Bounds, outliers: Share, max_beams: int, free_space: FreeSpace | None = None) -> Beams:
    """Return the evidence of a scan: its hits, at most `max_beams` of them, spread evenly, and what it says about free space.

    The true reading lies in ``y ± range_error`` and the true bearing in ``β ± bearing_error``. Turning a reading of length Y by an angle of
    at most δ moves its end by at most Yδ across the beam and by Yδ²/2 along it.

    Source: Guyonneau et al. 2014, eq. 6, in the axes of REP-103.
    """
    classes = scan.classes()
    used = _spread(np.flatnonzero(classes == BeamClass.HIT), max_beams)
    paths = _paths(scan, bounds)
    reading = scan.ranges[used].astype(np.float64)
    directions = paths.units[used]
    ends = paths.origins[used] + reading[:, None] * directions

    radial = bounds.range_error_m + scan.range_slack()[used]
    reach = reading + radial
    turn, blur = paths.turns[used], paths.blurs[used]
    rounding = ROUNDINGS * (reach + np.abs(paths.origins[used]).sum(axis=1))  # of `ends`: a cosine, a product and a sum
    errors = np.stack([radial + 0.5 * reach * turn**2, reach * turn], axis=1) + (blur + rounding)[:, None]
    rays = None
    if free_space is not None and free_space.use:
        among = _spread(np.arange(len(used)), free_space.max_rays)
        alone = np.flatnonzero(classes == BeamClass.NO_RETURN) if free_space.no_return else np.empty(0, dtype=np.intp)
        alone = _spread(alone, free_space.max_rays)
        farthest = min(free_space.no_return_m, scan.range_max)
        rows = np.concatenate([used[among], alone])
        reported = np.concatenate([reading[among], np.full(len(alone), farthest)])
        wrong = np.concatenate([radial[among], np.full(len(alone), bounds.range_error_m)]) + free_space.margin_m + paths.blurs[rows]
        lengths = (reported - wrong) - ROUNDINGS * (reported + wrong)  # what is left may be far below both
        numbers = np.concatenate([among, np.full(len(alone), -1)]).astype(np.int64)
        margins = (free_space.margin_m + paths.blurs[rows]) * ABOVE
        rays = Rays(paths.origins[rows], paths.angles[rows], paths.turns[rows], lengths, numbers, margins)
    beams = Beams(ends, directions, errors * ABOVE, 0, rays, bounds.map_error_m)
    return dataclasses.replace(beams, outliers=number_of(outliers, len(beams)))


@dataclass(frozen=True, eq=False)
class _Paths:
    """Where each beam of a scan begins and which way it goes, in the base frame at the scan's stamp.

    Parameters
    ----------
    origins
        Where the laser was, float64 of shape (n, 2).
    blurs
        By how much that may be wrong (m).
    angles, turns
        The direction of each beam, and by how much it may be wrong (rad).
    units
        The unit vectors that point there, float64 of shape (n, 2).
    """

    origins: FloatArray
    blurs: FloatArray
    angles: FloatArray
    turns: FloatArray
    units: FloatArray


def _paths(scan: LaserScan, bounds: Bounds) -> _Paths:
    """Return the paths of all beams; where the robot moved during the scan, each is seen from where the robot was at that beam.

    `sweep_boxes` says where it was: each beam is seen from the middle of its box, and may be off by the rest of it.
    """
    angle, turn, units = _directions(len(scan), scan.angle_min, scan.angle_increment, scan.mounting, bounds.bearing_error_rad)
    laser = np.array([scan.mounting.x, scan.mounting.y])
    if scan.sweep is None or len(scan) < 2:
        return _Paths(np.broadcast_to(laser, (len(scan), 2)), np.zeros(len(scan)), angle, turn, units)
    middle, off = _middles(sweep_boxes(scan.sweep, bounds.motion, len(scan)))
    off_rad = off[:, 2]
    c, s = unit_vectors(middle[:, 2]).T
    origins = np.stack([c * laser[0] - s * laser[1], s * laser[0] + c * laser[1]], axis=1) + middle[:, :2]
    # Each coordinate may be off; and the laser, at the end of an arm, by the error of the heading. Two products and their sum and that
    # with the motion are rounded, and so is the difference of a bound and the middle.
    rounding = ROUNDINGS * (np.abs(laser).sum() + np.abs(middle[:, :2]).sum(axis=1) + off.sum(axis=1))
    blurs = (np.hypot(off[:, 0], off[:, 1]) + math.hypot(*laser) * off_rad + rounding) * ABOVE
    angle = angle + middle[:, 2]
    turn = turn + (off_rad + _angle_rounding(angle)) * ABOVE
    return _Paths(origins, blurs, angle, turn, unit_vectors(angle))


def _middles(boxes: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the middles of motions, rows (x, y, θ) of (lower, upper), and how far off they may be; float64 of shape (n, 3) each.

    Bounds of motion may be as large as they like, even infinite: what may be anywhere is off by no more than that means.
    """
    headings = wrapped(Boxes(boxes[:, 2, :1], boxes[:, 2, 1:]), 0)
    boxes = np.concatenate([boxes[:, :2], np.stack([headings.lower, headings.upper], axis=2)], axis=1)
    far = ~(np.abs(boxes[:, :2]) <= ANYWHERE_M).all(axis=2)
    boxes[:, :2][far] = (-ANYWHERE_M, ANYWHERE_M)
    middle = 0.5 * (boxes[:, :, 0] + boxes[:, :, 1])
    return middle, np.maximum(boxes[:, :, 1] - middle, middle - boxes[:, :, 0]) * ABOVE


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
    return angle, turn, unit_vectors(angle)


def _angle_rounding(angle: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Return a bound of the rounding of the angle itself and of its sine and cosine, as an angle (rad).

    It is a sum of up to four angles, of which all but one are at most π: fifteen roundings at most.
    """
    return ROUNDINGS * (1.0 + np.abs(angle))
