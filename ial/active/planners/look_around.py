"""`LookAround`: turns on the spot of a robot whose lidar does not see all around, where all around there is something to see."""

import math

from ial.active.belief import Belief, Groups
from ial.active.common_space import CommonSpace
from ial.active.decision import Decision
from ial.active.planners.outlook import Outlook, seen_part
from ial.active.planners.route import Place
from ial.active.robot import Drive

_SAME_M = 0.1  # by so much a turn on the spot may lead aside
_MISSING = 0.1  # of a field of view may be missing


class LookAround:
    """Looks in other directions from one place. Views are compared all around, so a place is done with only after that.

    Parameters
    ----------
    outlook
        What is told apart from where.
    """

    def __init__(self, outlook: Outlook) -> None:
        self._outlook = outlook
        self._left = 0
        self._last: Place | None = None
        self._unsafe = False

    def __repr__(self) -> str:
        return f"<LookAround: {self._left} turns are left>"

    @property
    def begun(self) -> bool:
        """Whether turns are left."""
        return self._left > 0

    @property
    def unsafe(self) -> bool:
        """Whether the robot has not looked in all directions where it would have told something, since that was not safe."""
        return self._unsafe

    def begin(self, belief: Belief) -> None:
        """Begin where the robot will be at the next decision."""
        self._left = _looks(belief) - 1

    def has_seen_all(self, belief: Belief) -> bool:
        """Return whether the robot has looked in all directions from where it is."""
        return _looks(belief) == 1 or (self._last is not None and math.dist(self._last, (belief.moved.x, belief.moved.y)) < _SAME_M)

    def further(self, belief: Belief, groups: Groups, space: CommonSpace) -> Decision | None:
        """Return the next turn; None if all was seen, if nothing would be told apart, or if no turn is safe."""
        self._unsafe = False
        if not self._left:
            return None
        turn, here = 2.0 * math.pi / _looks(belief), [(space.here.x, space.here.y)]
        told = self._outlook.worth(belief, groups, space.here, here)[0] > 0.0
        self._unsafe = told and bool(belief.safe_ways([turn], 0.0)[0] < 0.0)
        if not told or self._unsafe:
            self._left = 0
            return None
        self._left -= 1
        if not self._left:
            self._last = belief.moved.x, belief.moved.y
        return Decision(Drive(turn, 0.0), "view", f"to look in another direction, {self._left} more to come")


def _looks(belief: Belief) -> int:
    """Return from how many headings a lidar sees all around."""
    return max(1, math.ceil(1.0 / seen_part(belief) - _MISSING))
