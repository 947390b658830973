"""How many beams of a scan may be bad, where that is left open: as few as leave a pose, and a margin."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Protocol, TypeVar

from ial.contractors.paving.limits import Limit
from ial.lidar.evidence.beams import Beams

if TYPE_CHECKING:
    from typing_extensions import Self  # in typing since Python 3.11

_MANY = 1 << 12  # boxes of a set


class Counted(Protocol):
    """Poses, in one map or in several, with how many beams are bad at them; see `PoseSet`."""

    def __len__(self) -> int:
        """Return the number of boxes."""
        ...

    @property
    def limited(self) -> Limit:
        """Which limit stopped the search."""
        ...

    @property
    def fewest_bad(self) -> int:
        """How many beams are bad at least."""
        ...

    @property
    def accepted(self) -> int | None:
        """How many beams might be bad at the last scan that has left a pose."""
        ...

    def within(self, outliers: int) -> "Self":
        """Return what is left where at most so many beams may be bad."""
        ...


Poses = TypeVar("Poses", bound=Counted)


def within_budget(reading: Beams, states: Poses, search: Callable[[Beams], Poses]) -> Poses:
    """Return what a search leaves, with as many bad beams as the reading allows.

    Where the reading leaves the number open it is the smallest one that leaves a pose, plus the margin. The search is repeated with more
    until it leaves one; what was allowed before is a good guess. Nothing is left if more were needed than the limit, or than a jump allows.

    Parameters
    ----------
    states
        What was known before, with how many beams might be bad at the last scan that has left a pose.
    search
        Returns what a scan leaves with a fixed number. All of an answer comes from one call, so that all of it is cut at one number.
    """
    if reading.margin is None:
        return search(reading)
    before = states.accepted
    limit = reading.outliers if reading.jump is None or before is None else min(reading.outliers, before + reading.jump)
    guess = (before or 0) if len(states) < _MANY else 0  # a large set is what a scan with many bad beams has left: few more come as bad
    most = min(max(guess, 2 * reading.margin), limit)
    while True:
        poses = search(reading.allowing(most))
        if len(poses):
            needed = most if poses.limited else min(poses.fewest_bad + reading.margin, limit)
            if needed <= most:
                return poses.within(needed)
            most = needed
        elif most == limit:
            return poses
        else:
            most = min(2 * most + 1, limit)
