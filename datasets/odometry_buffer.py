"""`OdometryBuffer`: odometry at any stamp, by one rule."""

import math
from array import array
from bisect import bisect_left, bisect_right
from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

from ial.contractors.rounding import check_rounding
from ial.datasets.motion_boxes import interpolation_error
from ial.datasets.odometry import Odometry
from ial.datasets.odometry_path import NUMBERS, OdometryPath
from ial.datasets.trajectory import interpolate

MAX_GAP_NS = 500_000_000


class OdometryBuffer:
    """Odometry messages by stamp, 56 bytes each.

    The rule: the message with exactly the asked stamp; else linear interpolation between the two neighbours, if they are at most 0.5 s
    apart; else nothing, and never beyond the ends. An interpolated pose carries an error bound, which reaches to everywhere where the robot
    may have been. It is assumed that between two messages d apart whose headings differ by φ the recorded position stays within 0.16·d·φ of
    the box that the two positions span, as it does on a line and on an arc, and the heading within the shorter arc.

    Parameters
    ----------
    samples
        Pairs of stamp in nanoseconds and odometry, in any order; of two with one stamp the later in the sequence counts.
    """

    def __init__(self, samples: Iterable[tuple[int, Odometry]] = ()) -> None:
        self._stamps, self._numbers = array("q"), array("d")
        self._limits: dict[int, tuple[float, float]] = {}
        self._fixed: dict[int, Odometry] = {}
        self._sorted = True
        self.kept_since_ns = -(2**63)  # what is older was left out by `forget` or `lose`
        for stamp, odometry in samples:
            self.add(stamp, odometry)

    def __len__(self) -> int:
        self._sort()
        return len(self._stamps)

    @property
    def latest_ns(self) -> int | None:
        """The stamp of the last message; None if there is none."""
        self._sort()
        return self._stamps[-1] if self._stamps else None

    def add(self, stamp_ns: int, odometry: Odometry) -> None:
        """Take a message; of two with one stamp the later one counts."""
        if self._sorted and self._stamps and self._stamps[-1] == stamp_ns:
            del self._stamps[-1], self._numbers[-NUMBERS:]
        self._sorted = self._sorted and (not self._stamps or self._stamps[-1] < stamp_ns)
        self._stamps.append(stamp_ns)
        self._numbers.extend(odometry.numbers)

    def limit(self, stamp_ns: int, error_m: float, error_rad: float) -> None:
        """Take how far the odometry of a stamp, which may be yet to come, may be from what the robot recorded."""
        self._limits[stamp_ns] = error_m, error_rad
        self._sorted = False

    def fix(self, stamp_ns: int, odometry: Odometry) -> None:
        """Take what shall be given at a stamp, though it is no message: it was looked up before this recording was written."""
        self._fixed[stamp_ns] = odometry
        self._sorted = False

    def at(self, stamp_ns: int) -> Odometry | None:
        """Return the odometry at a time, or None where the rule gives none."""
        self._sort()
        if stamp_ns in self._fixed:
            return self._fixed[stamp_ns]
        stamps = self._stamps
        after = bisect_left(stamps, stamp_ns)
        if after < len(stamps) and stamps[after] == stamp_ns:
            return Odometry(*self._row(after))
        if after in (0, len(stamps)):
            return None
        start, end = stamps[after - 1], stamps[after]
        if end - start > MAX_GAP_NS:
            return None
        check_rounding()
        first, second = self._row(after - 1), self._row(after)
        between = Odometry.of(interpolate(Odometry(*first).pose, Odometry(*second).pose, (stamp_ns - start) / (end - start)))
        error_m, error_rad = interpolation_error(np.array(first), np.array(second), np.array(between.numbers))
        return Odometry(between.x, between.y, between.z, between.w, error_m, error_rad)

    def holds(self, stamp_ns: int) -> bool:
        """Return whether there is a message with exactly this stamp."""
        self._sort()
        at = bisect_left(self._stamps, stamp_ns)
        return at < len(self._stamps) and self._stamps[at] == stamp_ns

    def between(self, start_ns: int | None, stop_ns: int) -> OdometryPath:
        """Return the messages strictly between two times, in that order; all before the second if there is no first."""
        self._sort()
        start = -(2**63) if start_ns is None else start_ns
        back = stop_ns < start
        first, last = bisect_right(self._stamps, min(start, stop_ns)), bisect_left(self._stamps, max(start, stop_ns))
        last = max(first, last)
        stamps = np.array(self._stamps[first:last], dtype=np.int64)
        numbers = np.array(self._numbers[NUMBERS * first : NUMBERS * last]).reshape(-1, NUMBERS)
        return OdometryPath(stamps[::-1], numbers[::-1]) if back else OdometryPath(stamps, numbers)

    def sweep(self, start_ns: int, stop_ns: int) -> OdometryPath | None:
        """Return the odometry at two times and every message between them; None where it is not known at both, or they are the same."""
        first, last = self.at(start_ns), self.at(stop_ns)
        if first is None or last is None or start_ns == stop_ns:
            return None
        return self.between(start_ns, stop_ns).joining((start_ns, first), (stop_ns, last))

    def forget(self, stamp_ns: int) -> None:
        """Leave out what nobody needs who asks for this stamp or a later one."""
        self._sort()
        count = bisect_right(self._stamps, stamp_ns) - 1
        if count > 0:
            del self._stamps[:count]
            del self._numbers[: NUMBERS * count]
            self.kept_since_ns = self._stamps[0]

    def lose(self, count: int) -> None:
        """Leave out the oldest messages, so that nothing is known of the motion over them: the last of them gets infinite errors."""
        self._sort()
        del self._stamps[: count - 1]
        del self._numbers[: NUMBERS * (count - 1)]
        self.kept_since_ns = self._stamps[0]
        self._numbers[4:NUMBERS] = array("d", [math.inf, math.inf])

    def _row(self, index: int) -> list[float]:
        return self._numbers[NUMBERS * index : NUMBERS * (index + 1)].tolist()

    def _sort(self) -> None:
        """Bring the messages into the order of their stamps, which then increase, and give them their limits."""
        if self._sorted:
            return
        rows, stamps = _last_of_each(self._stamps)
        numbers = np.array(self._numbers, dtype=np.float64).reshape(-1, NUMBERS)[rows]
        limited = np.array(list(self._limits), dtype=np.int64)
        for row in np.flatnonzero(np.isin(stamps, limited)).tolist():
            numbers[row, 4:] = self._limits[int(stamps[row])]
        for stamp in self._limits.keys() & self._fixed.keys():
            fixed = self._fixed[stamp]
            self._fixed[stamp] = Odometry(fixed.x, fixed.y, fixed.z, fixed.w, *self._limits[stamp])
        self._stamps, self._numbers = array("q", stamps.tobytes()), array("d", numbers.tobytes())
        self._sorted = True


def _last_of_each(stamps: "array[int]") -> tuple[npt.NDArray[np.intp], npt.NDArray[np.int64]]:
    """Return the rows of the stamps in increasing order, of equal ones the last row, and those stamps."""
    values = np.array(stamps, dtype=np.int64)
    rows = np.argsort(values, kind="stable")
    last = np.append(np.diff(values[rows]) != 0, True)[: len(rows)]
    return rows[last], values[rows[last]]
