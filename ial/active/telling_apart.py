"""`told_apart`: how many pairs of possible places a view tells apart, if so many of its beams may be bad."""

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]


def told_apart(readings: FloatArray, same_m: float, bad_part: float) -> int:
    """Return how many pairs of places a scan would tell apart.

    A pair counts if more of its readings differ than may be bad in either.

    Parameters
    ----------
    readings
        What sensors read in each place and direction (m), float64 of shape (m, n), as far as they see.
    same_m
        Readings that differ by at most this (m) are taken as equal.
    bad_part
        Which part of the readings may be bad.
    """
    count, beams = readings.shape
    apart = 0
    for row in range(count - 1):
        differing = (np.abs(readings[row + 1 :] - readings[row]) > same_m).sum(axis=1)
        apart += int((differing > bad_part * beams).sum())
    return apart
