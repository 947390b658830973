"""When an answer is so small that the number of bad beams has cut it off, rather than the scan."""

from collections.abc import Iterable

import numpy as np

from ial.lidar.evidence.beams import Beams
from ial.lidar.pose_set import PoseSet


def is_vanishing(left: Iterable[PoseSet], beams: Beams) -> bool:
    """Return whether hardly anything is left: a smaller volume than the `leeway` of the beams.

    Parameters
    ----------
    left
        What a scan has left in each map, cut back as far as `LidarModel.refine` can; perhaps nothing.
    beams
        The evidence of the scan, and how many of its beams might be bad.

    Returns
    -------
    vanishing
        False where the scan excludes nothing, where it has rejected the prediction, and where a limit has made the answer coarse.
    """
    sets = list(left)
    if not beams.informative or any(each.limited or each.unconfirmed.any() for each in sets):
        return False
    return sum(each.boxes.volume() for each in sets) < leeway(beams)


def leeway(beams: Beams) -> float:
    """Return the volume of poses (m² rad) that the stated errors of a scan's beams leave open around a pose.

    With e for the errors of range and map together, a robot that is moved by ±e along x or y moves the ends of its beams by as much as the
    errors explain, and so it does if it is turned by ±(β + e / d), where d is the mean length of a beam and β its bearing error. The volume
    is that of these three together, (2e)² · 2(β + e / d).

    As a rule more than that is left around a pose that keeps its bounds. Of less, the number of bad beams is the cause: the answer is about
    to vanish, since hardly any pose explains the scan. That is no proof; `bench/vanishing.py` counts how often the truth is lost then.

    Parameters
    ----------
    beams
        The evidence of the scan.
    """
    if not len(beams.ends):
        return 0.0
    along, across = beams.errors.mean(axis=0)
    distance = np.hypot(*beams.ends.T).mean()
    error = along + beams.map_error_m
    return float(8.0 * error**2 * (across + error) / max(distance, error))
