"""`Goal`: a place to drive to, and why."""

from dataclasses import dataclass

from ial.active.planners.route import Place

_SETTING_OUT_M = 1.0  # what a new goal costs besides its way
_DEEPER = 2.0  # as much more are frontiers worth that were seen last


@dataclass(frozen=True)
class Goal:
    """A place that a robot can drive to.

    Parameters
    ----------
    stage
        What it is: ``frontier`` for one that was seen last, ``backtrack`` for an older one, ``view``, or ``approach`` if something behind
        it cannot be reached yet.
    place
        Where it is, in metres in the frame of the start.
    worth
        What is told apart there.
    cost_m
        What the way costs.
    since
        If it is a frontier: the number of the decision that was the first to know it.
    """

    stage: str
    place: Place
    worth: float
    cost_m: float
    since: int | None = None

    @property
    def value(self) -> float:
        """What is told apart for a metre; those frontiers are preferred that were seen last, as a search in depth does."""
        return (_DEEPER if self.stage == "frontier" else 1.0) * self.worth / (_SETTING_OUT_M + self.cost_m)
