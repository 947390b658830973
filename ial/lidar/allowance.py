"""How many beams of a scan may be bad, where that is left open: as few as leave a pose, and a margin."""

from collections.abc import Callable

from ial.lidar.beams import Beams
from ial.lidar.pose_set import PoseSet

_MANY = 1 << 12  # boxes of a set


def allowing(reading: Beams, states: PoseSet, search: Callable[[Beams], PoseSet]) -> PoseSet:
    """Return what a search leaves, with as many bad beams as the reading allows.

    Where the reading leaves the number open it is the smallest one that leaves a pose, plus the margin. The search is repeated with more
    until it leaves one; what was allowed before is a good guess. Nothing is left if more were needed than the limit, or than a jump allows.

    Parameters
    ----------
    states
        What was known before, with how many beams might be bad at the scan before; 0 if there was none.
    """
    if reading.margin is None:
        return search(reading)
    before = states.outliers
    limit = reading.outliers if reading.jump is None or not before else min(reading.outliers, before + reading.jump)
    guess = before if len(states) < _MANY else 0  # a large set is what a scan with many bad beams has left: few more come as bad
    most = min(max(guess, 2 * reading.margin), limit)
    while True:
        found = search(reading.allowing(most))
        if len(found):
            needed = most if found.limited else min(int(found.bad.min()) + reading.margin, limit)
            if needed <= most:
                return found.within(needed)
            most = needed
        elif most == limit:
            return found
        else:
            most = min(2 * most + 1, limit)
