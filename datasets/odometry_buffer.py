"""`OdometryBuffer`: odometry at any stamp, by one rule."""

import bisect
import math
from collections.abc import Iterable

from ial.datasets.odometry import Odometry
from ial.datasets.trajectory import interpolate

MAX_GAP_NS = 500_000_000
_ROUNDING = 1e-14  # many times the rounding error of the interpolation, relative to the numbers in it


class OdometryBuffer:
    """Odometry messages by stamp.

    The rule: the message with exactly the asked stamp; else linear interpolation between the two neighbours, if they are at most 0.5 s
    apart; else nothing, and never beyond the ends. An interpolated pose carries an error bound, its distance to the farther neighbour. That
    bound assumes that between two messages the robot does not leave the box that is spanned by them, nor its heading the shorter arc.

    Parameters
    ----------
    samples
        Pairs of stamp in nanoseconds and odometry, in any order; of two with one stamp the later in the sequence counts.
    """

    def __init__(self, samples: Iterable[tuple[int, Odometry]]) -> None:
        by_stamp = dict(samples)
        self._stamps = sorted(by_stamp)
        self._odometry = [by_stamp[stamp] for stamp in self._stamps]

    def __len__(self) -> int:
        return len(self._stamps)

    def at(self, stamp_ns: int) -> Odometry | None:
        """Return the odometry at a time, or None where the rule gives none."""
        after = bisect.bisect_left(self._stamps, stamp_ns)
        if after < len(self) and self._stamps[after] == stamp_ns:
            return self._odometry[after]
        if after in (0, len(self)):
            return None
        start, end = self._stamps[after - 1], self._stamps[after]
        if end - start > MAX_GAP_NS:
            return None
        first, second = self._odometry[after - 1], self._odometry[after]
        pose = interpolate(first.pose, second.pose, (stamp_ns - start) / (end - start))
        shifts, turns = [], []
        for neighbour in (first, second):
            shifts.append(math.hypot(pose.x - neighbour.x, pose.y - neighbour.y) + neighbour.error_m)
            turns.append(abs(math.remainder(pose.theta - neighbour.pose.theta, 2.0 * math.pi)) + neighbour.error_rad)
        rounding = _ROUNDING * (1.0 + abs(pose.x) + abs(pose.y))
        return Odometry.of(pose, max(shifts) * (1.0 + _ROUNDING) + rounding, max(turns) * (1.0 + _ROUNDING) + rounding)
