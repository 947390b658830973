"""From an occupancy in [0, 1] to free, occupied or unknown."""

import numpy as np
import numpy.typing as npt

from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, UNKNOWN


def classify_occupancy(
    occupancy: npt.NDArray[np.float64], free_thresh: float, occupied_thresh: float, strict: bool = False
) -> npt.NDArray[np.uint8]:
    """Return the classes: from `occupied_thresh` on occupied, up to `free_thresh` free, between them unknown.

    A quotient that is rounded to nearest equals the double of its decimal, so an occupancy of 153 / 255 meets a threshold of 0.6.

    Parameters
    ----------
    occupancy
        Numbers in [0, 1], of any shape.
    free_thresh, occupied_thresh
        The thresholds, free_thresh < occupied_thresh.
    strict
        Whether the thresholds themselves are unknown, as in ROS 1.
    """
    occupied = occupancy > occupied_thresh if strict else occupancy >= occupied_thresh
    free = occupancy < free_thresh if strict else occupancy <= free_thresh
    return np.where(occupied, OCCUPIED, np.where(free, FREE, UNKNOWN)).astype(np.uint8)
