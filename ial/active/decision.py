"""`Decision`: what a planner chose, and `Planner`: what chooses."""

from dataclasses import dataclass
from typing import Protocol, TypeVar

from ial.active.robot import Drive

BeliefT = TypeVar("BeliefT", contravariant=True)


@dataclass(frozen=True)
class Decision:
    """What to do next, and why.

    Parameters
    ----------
    drive
        The command; None if nothing is left to do.
    stage
        What chose it: ``direction``, ``frontier``, ``backtrack``, ``view``, ``opening`` for moves that every run begins with, or the name
        of another planner; ``exhausted`` if nothing is left.
    reason
        In words.
    target
        Where it leads in the end, x and y in metres in the frame of the robot at its start; None if it has no target.
    goes_on
        Whether it goes on with what the decision before it has begun.
    since
        If the target is a frontier: the number of the decision that was the first to know it, counted from 1.
    open
        Those numbers of all frontiers that are left besides the target, as they were when a planner last looked for frontiers.
    """

    drive: Drive | None
    stage: str
    reason: str
    target: tuple[float, float] | None = None
    goes_on: bool = False
    since: int | None = None
    open: tuple[int, ...] = ()


class Planner(Protocol[BeliefT]):
    """Chooses what a robot does next, from what is known. One planner belongs to one run."""

    def choose(self, belief: BeliefT) -> Decision:
        """Return the next decision."""
        ...
