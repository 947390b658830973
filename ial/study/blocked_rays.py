"""Which rays of a scan are blocked at poses of the base, by the definition of docs/guarantee.md."""

import numpy as np

from ial.study.obstacles import BoolArray, FloatArray, Obstacles
from ial.study.open_strips import open_strips
from ial.study.used_beams import UsedBeams, in_grid


def blocked_rays(beams: UsedBeams, poses: FloatArray, obstacles: Obstacles) -> BoolArray:
    """Return which of the beams that are looked along may be blocked, bool of shape (m, rays).

    A ray is blocked if it and every ray beside it, parallel and at most the margin away, meets a closed occupied cell, for every bearing
    within its error and, where the motion during the scan is taken out, every motion within its error. Bearings are tried a cell apart, and
    of the motions the recorded one and the corners of their box; so a ray that is free for others alone is called blocked, and never the
    other way round.
    """
    origins, angles = (each[beams.rays] for each in beams.seen(beams.turns(obstacles.resolution)))
    blocked = np.ones((len(poses), len(beams.rays)), dtype=np.bool_)
    tried = [(0, 0.0)]  # most rays are free by themselves
    tried += [(which, beams.margin_m) for which in range(angles.shape[1])]
    for which, aside in tried:
        pose, ray = np.nonzero(blocked)
        at, heading = in_grid(poses[pose], origins[ray, which], angles[ray, which])
        blocked[pose, ray] = ~open_strips(obstacles, at, heading, beams.lengths[ray], aside)
    return blocked
