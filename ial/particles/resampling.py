"""Drawing particles by their weights."""

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import FloatArray
from ial.contractors.kernels import kernel


@kernel
def _draw(weights, first, rows):  # type: ignore[no-untyped-def]
    total = 0.0
    for weight in weights:
        total += weight
    step = total / len(rows)
    at, reached = 0, weights[0]
    for i in range(len(rows)):
        while reached < (first + i) * step and at < len(weights) - 1:
            at += 1
            reached += weights[at]
        rows[i] = at


def low_variance(weights: FloatArray, count: int, random: np.random.Generator) -> npt.NDArray[np.int64]:
    """Return the numbers of the particles to go on with, ascending; each comes up as often as its weight says, but for one.

    Parameters
    ----------
    weights
        Not negative, with a positive sum; float64 of shape (n,).
    count
        How many are drawn.
    random
        Where the one random number comes from.

    Source: Thrun, Burgard and Fox, Probabilistic Robotics, 2005, table 4.4.
    """
    rows = np.empty(count, dtype=np.int64)
    _draw(weights, random.random(), rows)
    return rows


def effective(weights: FloatArray) -> float:
    """Return how many equal particles would be as good: (Σw)² / Σw²."""
    return float(weights.sum() ** 2 / np.square(weights).sum())
