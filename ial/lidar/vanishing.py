"""When an answer is so small that the number of bad beams has cut it off, rather than the scan."""

from collections.abc import Iterable

import numpy as np

from ial.lidar.beams import Beams
from ial.lidar.pose_set import PoseSet


def is_vanishing(left: Iterable[PoseSet], beams: Beams, map_error_m: float) -> bool:
    """Return whether hardly anything is left: a smaller volume than the `leeway` of the beams.

    Parameters
    ----------
    left
        What a scan has left in each map, cut back as far as `LidarModel.trim` can; perhaps nothing.
    beams
        The evidence of the scan, and how many of its beams might be bad.
    map_error_m
        How far the map may be wrong.

    Returns
    -------
    vanishing
        False where the scan excludes nothing, where it has rejected the prediction, and where a limit has made the answer coarse.
    """
    sets = list(left)
    if not beams.informative or any(each.limited or each.carried.any() for each in sets):
        return False
    return sum(each.boxes.volume() for each in sets) < leeway(beams, map_error_m)


def leeway(beams: Beams, map_error_m: float) -> float:
    """Return the volume of poses (m² rad) that the stated errors of a scan's beams leave open around a pose.

    A beam that is right to the last digit stays good while its end moves by no more than the errors of range and map together, e. So does
    the mean beam, of length d and with a bearing error β, while the robot is moved by up to e along x and y, and turned by up to β + e / d:
    the volume is (2e)² · 2(β + e / d).

    Where the truth keeps its bounds and the scan has a margin of beams to spare, this much or more is left around it as a rule. An answer
    below it holds only poses at which the beams that are allowed to be bad hardly suffice: it is about to vanish, as it does where a bound
    was broken and the truth has been lost. That is no proof; `bench/vanishing.py` counts how often it is so.

    Parameters
    ----------
    beams
        The evidence of the scan.
    map_error_m
        How far the map may be wrong.
    """
    if not len(beams.ends):
        return 0.0
    along, across = beams.errors.mean(axis=0)
    distance = np.hypot(*beams.ends.T).mean()
    error = along + map_error_m
    return float(8.0 * error**2 * (across + error) / max(distance, error))
