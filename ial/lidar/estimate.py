"""`Estimate`: what one scan leaves of the possible poses, and how to say it."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from ial.contractors.boxes import Boxes
from ial.contractors.margins import ABOVE
from ial.contractors.paving.limits import Limit
from ial.lidar.configuration.config import LocalizedSize
from ial.lidar.global_check import GlobalCheck
from ial.lidar.hypothesis import Hypothesis
from ial.lidar.pose_set import PoseSet
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.membership.set_membership_filter import Rejection
from ial.pose import Pose

Status = Literal["localized", "ambiguous", "symmetric", "lost", "blind"]


@dataclass(frozen=True, eq=False)
class Estimate:
    """All poses that the data up to a scan allow.

    Parameters
    ----------
    stamp_ns
        Time of the scan, nanoseconds.
    status
        `localized`: one hypothesis, not larger than the configured size. `lost`: this scan fitted nowhere in the prediction and was
        searched over the whole map. `blind`: it fitted nowhere at all. `symmetric`: whatever pose of one hypothesis is consistent with
        all data, so are its images in all others, under rotations that map the map onto itself; see `are_images`. `ambiguous`:
        everything else.
    hypotheses
        The connected sets of poses, the largest volume first.
    pose
        The middle of the only hypothesis while `localized`, in the map frame; else None.
    poses
        The set itself, in the grid's frame.
    beams
        How many beams were used.
    outliers_allowed
        q: how many of them may be bad. All of the answer was cut at this number, but for the prediction that a `lost` or `blind` scan
        carries on. With ``outliers: auto`` it is what the scan needed and the margin; of a `blind` scan, the largest number with which it
        was searched for in vain.
    uninformative
        Whether the scan could exclude nothing: no usable beams, or as many allowed outliers.
    limited
        Which limit made the answer coarser than asked for: "", "boxes" or "time".
    elapsed_s
        How long it took.
    radius_m
        While localized: no possible position is farther from `pose` than this, in metres.
    check
        The comparison with the rest of the map, at the scans at which there was one.
    vanishing
        Whether hardly anything is left: less than the errors of the beams alone leave open around a pose, see `leeway`. Often a bound has
        been broken then, but it is no proof. False where the scan has rejected the prediction or excludes nothing, or a limit struck.
    rejection
        The proof that an assumption is false, of a `lost` or `blind` scan: its number among all scans that were processed.
    """

    stamp_ns: int
    status: Status
    hypotheses: tuple[Hypothesis, ...]
    pose: Pose | None
    poses: PoseSet
    beams: int
    outliers_allowed: int
    uninformative: bool
    limited: Limit
    elapsed_s: float
    radius_m: float | None = None
    check: GlobalCheck | None = None
    vanishing: bool = False
    rejection: Rejection | None = None

    def __repr__(self) -> str:
        at = "" if self.pose is None else f" around {self.pose}"
        left = f"{self.status}, {self._left} in {len(self.poses)} box{'es' * (len(self.poses) != 1)}{at}"
        return f"<Estimate at {self.stamp_ns} ns: {left}; {self.outliers_allowed} of {self.beams} beams may be bad>"

    def _repr_png_(self) -> bytes:
        """Return a picture for a notebook: see `ial.lidar.estimate_picture.draw_hypotheses`."""
        from ial.contractors.paving.drawing import png
        from ial.lidar.estimate_picture import draw_hypotheses

        return png(lambda ax: draw_hypotheses(ax, self.hypotheses, self.pose, f"{self.status}: {self._left}"))

    @property
    def _left(self) -> str:
        count = len(self.hypotheses)
        return f"{count} {'hypothesis' if count == 1 else 'hypotheses'}"


def radius(poses: PoseSet, pose: Pose, grid: OccupancyGrid) -> float:
    """Return a distance (m) from a pose in the map frame that no position of a set exceeds, rounded up."""
    at = np.array([[pose.x, pose.y, pose.theta]])
    there = grid.boxes_to_grid(Boxes(at, at))
    away = np.maximum(poses.boxes.upper - there.lower, there.upper - poses.boxes.lower)  # from there to the far sides, none below 0
    return float(np.hypot(away[:, 0], away[:, 1]).max() * ABOVE)


def judge(hypotheses: tuple[Hypothesis, ...], size: LocalizedSize, *, rejected: bool, confirmed: bool, symmetric: bool = False) -> Status:
    """Return the status word for a set of hypotheses.

    Parameters
    ----------
    hypotheses
        What is left.
    size
        The half-widths up to which a single hypothesis counts as localized.
    rejected
        Whether the scan fitted nowhere in the prediction.
    confirmed
        Whether it fitted anywhere.
    symmetric
        Whether the consistent poses of the hypotheses are images of each other; see `are_images`.
    """
    if rejected:
        return "lost" if confirmed else "blind"
    if len(hypotheses) == 1:
        position, heading = hypotheses[0].half_widths
        if position <= size.position_m and heading <= size.heading_rad:
            return "localized"
    return "symmetric" if symmetric else "ambiguous"
