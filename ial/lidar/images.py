"""Whether hypotheses are images of each other under symmetries of the map, so that no scan can tell them apart."""

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import Boxes
from ial.contractors.margins import ROUNDINGS
from ial.contractors.paving.clusters import cluster
from ial.lidar.pose_set import PoseSet
from ial.maps.grids.rigid_transform import boxes_from_frame
from ial.pose import Pose


def are_images(poses: PoseSet, symmetries: tuple[Pose, ...], size_m: float) -> bool:
    """Return whether the consistent poses of any hypothesis are images of those of any other.

    Let E be the poses that are consistent with all data. If all of the map was possible at the start, a rotation that maps the map onto
    itself maps E onto itself, since motions, scans and bounds are told in the frame of the robot: no scan tells a pose from its image.
    The boxes hold E. If the rotation brings the boxes of one hypothesis near those of one other and of no third, and near those no other
    boxes are brought, then it maps E in the one onto E in the other. This is asked here, of closed boxes, rounded outward: nothing is
    said of poses of the boxes that are not consistent, nor is it needed that cells lie on cells.

    Parameters
    ----------
    poses
        A set that holds all consistent ones.
    symmetries
        Of the map, in the grid's frame; none where the start was not all of the map.
    size_m
        How far the map reaches from its corner.
    """
    if not symmetries:
        return False
    boxes, labels, count = poses.boxes, poses.clusters.labels, len(poses.clusters)
    if not 1 < count <= 1 + len(symmetries):
        return False
    # A symmetry is made of doubles: the sine of its angle, its middle, and two products of poses are fewer than 31 roundings of terms that
    # are no larger than the map. More would only let hypotheses touch that do not, so that less is said.
    slack = ROUNDINGS * np.array([size_m, size_m, 1.0])
    reached = {0}
    for symmetry in symmetries:
        turned = boxes_from_frame(boxes, symmetry)
        reached |= _image_of_first(boxes, labels, Boxes(turned.lower - slack, turned.upper + slack))
    return len(reached) == count


def _image_of_first(boxes: Boxes, labels: npt.NDArray[np.int64], turned: Boxes) -> set[int]:
    """Return which hypothesis the first one is turned into, if the turned ones meet the others one to one."""
    firsts = np.unique(labels, return_index=True)[1]  # a box of each hypothesis
    together = cluster(Boxes.concatenate([boxes, turned]), circular=(2,))
    groups = together.labels[firsts].tolist()
    turned_groups = together.labels[len(boxes) + firsts].tolist()
    if len(together) != len(firsts) or sorted(groups) != sorted(turned_groups) or len(set(groups)) != len(groups):
        return set()
    return {groups.index(turned_groups[0])}
