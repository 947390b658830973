"""`told_apart`: how many pairs of possible places a view tells apart, if so many of its beams may be bad."""

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

SENSORS = 72
"""How many directions a view is compared in."""


def told_apart(readings: FloatArray, same_m: float, bad_part: float) -> int:
    """Return how many pairs of places a scan would tell apart.

    A pair counts if more of its readings differ than may be bad. A reading differs if neither it nor those beside it are near to the other
    one's: places are known up to some error, and beside an edge small errors change a reading much.

    Parameters
    ----------
    readings
        What sensors read in each place and direction (m), as far as they see; float64 of shape (m, n), directions all around.
    same_m
        Readings that differ by at most this (m) are taken as equal.
    bad_part
        Which part of the readings may be bad.
    """
    count, beams = readings.shape
    beside = np.stack([np.roll(readings, shift, axis=1) for shift in (-1, 0, 1)])
    low, high = beside.min(axis=0), beside.max(axis=0)
    apart = 0
    for row in range(count - 1):
        differing = (low[row + 1 :] - high[row] > same_m) | (low[row] - high[row + 1 :] > same_m)
        apart += int((differing.sum(axis=1) > bad_part * beams).sum())
    return apart
