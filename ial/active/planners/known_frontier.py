"""`KnownFrontier`: a frontier as a planner remembers it."""

from dataclasses import dataclass

from ial.active.planners.route import Place


@dataclass(frozen=True)
class KnownFrontier:
    """A frontier, and since when it is known.

    Parameters
    ----------
    place
        Where it is, in metres in the frame of the start.
    born
        After how many choices of a place it was first seen: the frontiers that were seen last are tried first.
    since
        The number of the decision that was the first to know it, counted from 1.
    """

    place: Place
    born: int
    since: int
