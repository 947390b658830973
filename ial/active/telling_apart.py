"""`told_apart`: which pairs of possible places each of some views tells apart, if so many of its beams may be bad."""

import numpy as np
import numpy.typing as npt

from ial.contractors import threads
from ial.contractors.kernels import kernel

FloatArray = npt.NDArray[np.float64]

SENSORS = 72
"""How many directions a view is compared in."""


@kernel
def _count_rows(start, stop, low, high, same, most, value, worth):  # type: ignore[no-untyped-def]
    """Write the value of the pairs of rows that differ in more than `most` readings."""
    count, beams = low.shape[1:]
    for view in range(start, stop):
        worth[view] = 0.0
        for one in range(count - 1):
            for other in range(one + 1, count):
                differing = 0
                for k in range(beams):
                    if low[view, other, k] - high[view, one, k] > same or low[view, one, k] - high[view, other, k] > same:
                        differing += 1
                if differing > most:
                    worth[view] += value[one, other]


def told_apart(readings: FloatArray, value: FloatArray, same_m: float, bad_part: float) -> FloatArray:
    """Return what the pairs of places are worth that a scan would tell apart, for each of some views.

    A pair counts if more of its readings differ than may be bad. A reading differs if neither it nor those beside it are near to the other
    one's: places are known up to some error, and beside an edge small errors change a reading much.

    Parameters
    ----------
    readings
        What sensors read in each view, place and direction (m), as far as they see; float64 of shape (views, m, n), directions all around.
    value
        What each pair is worth, float64 of shape (m, m).
    same_m
        Readings that differ by at most this (m) are taken as equal.
    bad_part
        Which part of the readings may be bad.

    Returns
    -------
    numpy.ndarray
        Sums of values, float64 of shape (views,).
    """
    beside = np.stack([np.roll(readings, shift, axis=2) for shift in (-1, 0, 1)])
    worth = np.zeros(len(readings))
    low, high = beside.min(axis=0), beside.max(axis=0)
    threads.run(_count_rows, len(readings), low, high, same_m, bad_part * readings.shape[2], value, worth, minimum=8)
    return worth
