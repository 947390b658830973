"""Which rays of a scan are blocked at a pose, by the exact definition: the slow, obvious twin of `ial.lidar.free_space`."""

import math

import numpy as np
import numpy.typing as npt

from ial.lidar.rays import Rays
from ial.maps.occupancy_grid import OCCUPIED, OccupancyGrid
from ial.maps.ray_casting import cast_rays
from ial.pose import Pose

_PER_CELL = 10  # rays cast for each cell of a strip's width


def blocked_rays(rays: Rays, pose: Pose, grid: OccupancyGrid) -> npt.NDArray[np.bool_]:
    """Return which rays are blocked at a pose of the base in the grid's frame, bool of shape (n,).

    A ray is blocked if it and every parallel ray within the margin, for every bearing within its error, meets a closed occupied cell. Here
    rays a tenth of a cell apart are cast, for the middle and both ends of the bearing; one that slips through between them may be taken for
    blocked, never the other way round.
    """
    count = 2 * max(1, math.ceil(rays.margins.max(initial=0.0) / grid.resolution * _PER_CELL)) + 1
    aside = rays.margins[:, None, None] * np.linspace(-1.0, 1.0, count)
    c, s = math.cos(pose.theta), math.sin(pose.theta)
    laser_x = (pose.x + c * rays.origins[:, 0] - s * rays.origins[:, 1])[:, None, None]
    laser_y = (pose.y + s * rays.origins[:, 0] + c * rays.origins[:, 1])[:, None, None]
    angle = pose.theta + rays.angles[:, None, None] + rays.turns[:, None, None] * np.array([-1.0, 0.0, 1.0])[:, None]
    x, y = laser_x - aside * np.sin(angle), laser_y + aside * np.cos(angle)
    distance = cast_rays(grid.mask(OCCUPIED), grid.resolution, x, y, np.broadcast_to(angle, x.shape), float(rays.lengths.max(initial=0.0)))
    return np.asarray((distance <= rays.lengths[:, None, None]).all(axis=(1, 2)))
