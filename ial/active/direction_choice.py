"""`DirectionChoice`: along which direction the possible places of a robot differ most (Goyal, Krishna, Bhuvanagiri, stage 1, table I).

For m virtual robots and the readings s of their sensors in direction k: A_k = m − m_k, where m_k is the size of the largest class of equal
readings, 0 if all differ; B_k is the sum of ``|s_i − s_j|`` over all pairs; the score is α·A_k + β·B_k. In the paper's form B_k is in
metres and grows with m², so it outweighs A_k; by default it is divided by what it can be at most, m(m − 1)/2 diameters, and multiplied by
m.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.errors import ConfigError

FloatArray = npt.NDArray[np.float64]

_EQUAL = 1e-9  # scores this close, as a part of the largest, are the same


@dataclass(frozen=True)
class Weights:
    """How differences are weighed.

    Parameters
    ----------
    alpha, beta
        α and β, not negative.
    same_m
        Readings that differ by at most this (m) are taken as equal.
    raw
        Whether B is taken as in the paper, in metres and not divided.

    Raises
    ------
    ConfigError
        If one is negative, or all are 0.
    """

    alpha: float = 0.95
    beta: float = 0.05
    same_m: float = 0.2
    raw: bool = False

    def __post_init__(self) -> None:
        if not (self.alpha >= 0.0 and self.beta >= 0.0 and self.alpha + self.beta > 0.0):
            raise ConfigError(f"alpha is {self.alpha:g} and beta {self.beta:g}; give numbers that are not negative, and not both 0")
        if not self.same_m >= 0.0:
            raise ConfigError(f"same_m is {self.same_m:g}; give a length in metres that is not negative")


@dataclass(frozen=True, eq=False)
class DirectionChoice:
    """The scores of all directions.

    Parameters
    ----------
    scores
        M of each direction, float64 of shape (n,).
    differing
        A of each direction.
    best
        Those of the largest score, in ascending order.
    """

    scores: FloatArray
    differing: npt.NDArray[np.int64]
    best: npt.NDArray[np.int64]

    def __repr__(self) -> str:
        return f"<DirectionChoice of {len(self.scores)}: {', '.join(map(str, self.best.tolist()))}>"

    @classmethod
    def of(cls, lower: FloatArray, upper: FloatArray, diameter_m: float, weights: Weights) -> "DirectionChoice":
        """Return the scores of readings.

        Parameters
        ----------
        lower, upper
            Bounds of the reading of each virtual robot in each direction (m), float64 of shape (m, n); equal for plain readings.
        diameter_m
            How far readings can differ.
        weights
            How differences are weighed.
        """
        count = len(lower)
        differing = count - largest_classes(lower, upper, weights.same_m)
        middle = np.sort(0.5 * (lower + upper), axis=0)
        # Of sorted numbers, the i-th is subtracted from those after it and from it are subtracted those before.
        spread = ((2.0 * np.arange(count) - count + 1.0)[:, None] * middle).sum(axis=0)
        if not weights.raw and count > 1:
            spread *= count / (0.5 * count * (count - 1) * diameter_m)
        scores = weights.alpha * differing + weights.beta * spread
        most = scores.max(initial=0.0)
        return cls(scores, differing, np.flatnonzero(scores >= most - _EQUAL * max(most, 1.0)))


def largest_classes(lower: FloatArray, upper: FloatArray, same_m: float) -> npt.NDArray[np.int64]:
    """Return for each column the size of its largest class of intervals that overlap, directly or through others; 0 if no two do.

    Intervals that are apart by at most `same_m` count as overlapping.
    """
    order = np.argsort(lower, axis=0, kind="stable")
    low, high = np.take_along_axis(lower, order, axis=0), np.take_along_axis(upper, order, axis=0)
    reached = np.maximum.accumulate(high, axis=0)
    sizes = np.zeros(lower.shape[1], dtype=np.int64)
    run = np.ones(lower.shape[1], dtype=np.int64)
    largest = run.copy()
    for row in range(1, len(lower)):
        run = np.where(low[row] - reached[row - 1] > same_m, 1, run + 1)
        largest = np.maximum(largest, run)
    if len(lower):
        sizes = np.where(largest == 1, 0, largest)
    return sizes
