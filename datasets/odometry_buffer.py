"""`OdometryBuffer`: odometry at any stamp, by one rule."""

import math
from array import array
from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

from ial.datasets.odometry import Odometry
from ial.datasets.trajectory import interpolate

MAX_GAP_NS = 500_000_000
_ROUNDING = 1e-14  # many times the rounding error of the interpolation, relative to the numbers in it
_NUMBERS = 6  # of an `Odometry`


class OdometryBuffer:
    """Odometry messages by stamp, 56 bytes each.

    The rule: the message with exactly the asked stamp; else linear interpolation between the two neighbours, if they are at most 0.5 s
    apart; else nothing, and never beyond the ends. An interpolated pose carries an error bound, its distance to the farther neighbour. That
    bound assumes that between two messages the robot does not leave the box that is spanned by them, nor its heading the shorter arc.

    Parameters
    ----------
    samples
        Pairs of stamp in nanoseconds and odometry, in any order; of two with one stamp the later in the sequence counts.
    """

    def __init__(self, samples: Iterable[tuple[int, Odometry]] = ()) -> None:
        self._stamps, self._numbers = array("q"), array("d")
        self._limited, self._limits = array("q"), array("d")
        self._sorted: tuple[npt.NDArray[np.int64], npt.NDArray[np.float64]] | None = None
        for stamp, odometry in samples:
            self.add(stamp, odometry)

    def __len__(self) -> int:
        return len(self._in_order()[0])

    def add(self, stamp_ns: int, odometry: Odometry) -> None:
        """Take a message; of two with one stamp the later one counts."""
        self._stamps.append(stamp_ns)
        self._numbers.extend((odometry.x, odometry.y, odometry.z, odometry.w, odometry.error_m, odometry.error_rad))
        self._sorted = None

    def limit(self, stamp_ns: int, error_m: float, error_rad: float) -> None:
        """Take how far the message of a stamp, which may be yet to come, may be from what the robot recorded."""
        self._limited.append(stamp_ns)
        self._limits.extend((error_m, error_rad))
        self._sorted = None

    def at(self, stamp_ns: int) -> Odometry | None:
        """Return the odometry at a time, or None where the rule gives none."""
        stamps, numbers = self._in_order()
        after = int(np.searchsorted(stamps, stamp_ns))
        if after < len(stamps) and stamps[after] == stamp_ns:
            return Odometry(*numbers[after].tolist())
        if after in (0, len(stamps)):
            return None
        start, end = int(stamps[after - 1]), int(stamps[after])
        if end - start > MAX_GAP_NS:
            return None
        first, second = (Odometry(*row) for row in numbers[after - 1 : after + 1].tolist())
        pose = interpolate(first.pose, second.pose, (stamp_ns - start) / (end - start))
        shifts, turns = [], []
        for neighbour in (first, second):
            shifts.append(math.hypot(pose.x - neighbour.x, pose.y - neighbour.y) + neighbour.error_m)
            turns.append(abs(math.remainder(pose.theta - neighbour.pose.theta, 2.0 * math.pi)) + neighbour.error_rad)
        rounding = _ROUNDING * (1.0 + abs(pose.x) + abs(pose.y))
        return Odometry.of(pose, max(shifts) * (1.0 + _ROUNDING) + rounding, max(turns) * (1.0 + _ROUNDING) + rounding)

    def _in_order(self) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.float64]]:
        """Return the stamps, strictly increasing, and the six numbers of each message."""
        if self._sorted is None:
            rows, stamps = _last_of_each(self._stamps)
            numbers = np.array(self._numbers, dtype=np.float64).reshape(-1, _NUMBERS)[rows]
            rows, limited = _last_of_each(self._limited)
            limits = np.array(self._limits, dtype=np.float64).reshape(-1, 2)[rows]
            _, ours, theirs = np.intersect1d(stamps, limited, assume_unique=True, return_indices=True)
            numbers[ours, 4:] = limits[theirs]
            self._sorted = stamps, numbers
        return self._sorted


def _last_of_each(stamps: "array[int]") -> tuple[npt.NDArray[np.intp], npt.NDArray[np.int64]]:
    """Return the rows of the stamps in increasing order, of equal ones the last row, and those stamps."""
    values = np.array(stamps, dtype=np.int64)
    rows = np.argsort(values, kind="stable")
    last = np.append(np.diff(values[rows]) != 0, True)[: len(rows)]
    return rows[last], values[rows[last]]
