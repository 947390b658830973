"""A simulated log: the bumps of a simulated robot with times, as a clock and a speed with errors within bounds would have reported them."""

import random
from collections.abc import Iterable
from fractions import Fraction
from math import ceil, floor, isqrt

from ial.bouncing.bump_event import BumpEvent
from ial.bouncing.bump_timing import BumpTiming
from ial.bouncing.rays.real_robot import RealPose
from ial.errors import ConfigError

_PER_S = 10**9  # times are whole nanoseconds
_PARTS = 1 << 20  # errors are drawn in such parts of their bounds
_ROOT_BITS = 120


def simulated_log(
    start: tuple[Fraction, Fraction],
    poses: Iterable[RealPose],
    timing: BumpTiming,
    seed: int,
    place: tuple[Fraction, Fraction, Fraction] | None = None,
) -> list[BumpEvent]:
    """Return the start and the bumps of a run; between any two, the driving time is wrong by at most the tolerance.

    Parameters
    ----------
    start
        Where the run begins: x and y in metres.
    poses
        The poses after its observations.
    timing
        The speed, the turning time, and what may be wrong; the speed differs from leg to leg.
    seed
        What the errors are drawn from.
    place
        What the log says about the start: x, y and the heading in degrees; nothing if it is left out.

    Raises
    ------
    ConfigError
        If the tolerance of the clock is smaller than a nanosecond, to which times are rounded.
    """
    if timing.clock_s * _PER_S < 1:
        raise ConfigError(
            f"the error of the clock is up to {float(timing.clock_s):g} s, and a log has whole nanoseconds; give --clock-error 1e-9 or more"
        )
    chooser = random.Random(f"times {seed}")
    events, (x, y), now, turn_s = [BumpEvent(Fraction(0), "start", place=place)], start, 0, Fraction(0)
    for pose in poses:
        if not pose.observation:
            continue
        way = _root((pose.x_m - x) ** 2 + (pose.y_m - y) ** 2)
        driven = turn_s + way / (timing.speed_m_s * (1 + timing.speed_part * _drawn(chooser)))
        least, most = ceil(max(driven - timing.clock_s, Fraction(0)) * _PER_S), floor((driven + timing.clock_s) * _PER_S)
        now += min(max(round((driven + timing.clock_s * _drawn(chooser)) * _PER_S), least), most)
        events.append(BumpEvent(Fraction(now, _PER_S), "bump"))
        x, y, turn_s = pose.x_m, pose.y_m, timing.turn_s
    return events


def _drawn(chooser: random.Random) -> Fraction:
    """Return a number from −1 to 1; the ends are as likely as all the rest, since bounds are broken there if anywhere."""
    some = chooser.randint(-_PARTS, _PARTS)
    return Fraction(chooser.choice((-_PARTS, _PARTS, some, some)), _PARTS)


def _root(square: Fraction) -> Fraction:
    """Return a square root, right to 120 bits behind the point; that is far below a nanosecond."""
    return Fraction(isqrt(square.numerator * 4**_ROOT_BITS // square.denominator), 2**_ROOT_BITS)
