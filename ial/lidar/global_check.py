"""`GlobalCheck`: whether a scan fits better somewhere else than where the robot is believed to be."""

from dataclasses import dataclass

import numpy as np

from ial.contractors.boxes import Boxes
from ial.contractors.paving.clusters import cluster
from ial.lidar.evidence.beams import Beams
from ial.lidar.hypothesis import Hypothesis, find_hypotheses
from ial.lidar.model import LidarModel
from ial.lidar.pose_set import PoseSet


@dataclass(frozen=True)
class GlobalCheck:
    """The answer of one scan over the whole map, compared with the set that is tracked.

    The numbers are of beams that are bad at least, so this is a hint and no proof: a robot that is tracked with all bounds kept may well
    see a scan that fits a little better elsewhere. If it does so by many beams, scan after scan, it is not where it is believed to be.

    Parameters
    ----------
    inside
        The fewest bad beams within the set that is tracked.
    elsewhere
        The fewest bad beams anywhere else, if a place outside has at most as many as `inside`; else None.
    best
        That place; None if there is none.
    """

    inside: int
    elsewhere: int | None = None
    best: Hypothesis | None = None

    @property
    def better(self) -> bool:
        """Whether the scan fits strictly better somewhere else."""
        return self.elsewhere is not None and self.elsewhere < self.inside


def check_everywhere(model: LidarModel, poses: PoseSet, beams: Beams) -> GlobalCheck | None:
    """Search the whole map for places where at most as many beams of a scan are bad as within a set.

    Parameters
    ----------
    model
        The map and the bounds.
    poses
        The set, as the scan has left it.
    beams
        The scan.

    Returns
    -------
    check
        None if nothing can be said: the scan excludes nothing, or the set is only a prediction, or coarse, so that its bad beams are
        unknown.
    """
    if not beams.informative or poses.limited or not len(poses) or poses.unconfirmed.all():
        return None
    confirmed = poses.boxes[~poses.unconfirmed]
    inside = int(poses.bad[~poses.unconfirmed].min())
    everywhere = model.contract(model.universe(), beams.allowing(inside))
    if everywhere.limited:
        return None
    labels = cluster(Boxes.concatenate([confirmed, everywhere.boxes]), circular=(2,)).labels
    outside = ~np.isin(labels[len(confirmed) :], labels[: len(confirmed)])
    if not outside.any():
        return GlobalCheck(inside)
    others = PoseSet(everywhere.boxes[outside], bad=everywhere.bad[outside], outliers=inside)
    best = max(find_hypotheses(others, model.grid), key=lambda each: each.spare_beams or 0)
    return GlobalCheck(inside, int(others.bad.min()), best)
