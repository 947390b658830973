"""`SetMembershipFilter`: all states that a sequence of motions and readings allows, and what follows when none is left."""

from dataclasses import dataclass
from typing import Generic, Literal, TypeVar

from ial.membership.model import Model

States = TypeVar("States")
Motion = TypeVar("Motion")
Reading = TypeVar("Reading")

Recovery = Literal["union", "restart", "absorb"]
"""What to believe after a reading that no predicted state explains.

`union`: every state that explains it wherever the robot was before, and the prediction without it, so that the truth is kept whichever of
the two was wrong. `restart`: the former alone, if there are any. `absorb`: nothing, for ever.
"""


@dataclass(frozen=True)
class Rejection:
    """The event that a step has left no state: a proof that an assumption is false.

    Parameters
    ----------
    step
        The number of the step, from 0.
    """

    step: int


class SetMembershipFilter(Generic[States, Motion, Reading]):
    """Runs a model over a sequence of motions and readings.

    Parameters
    ----------
    model
        The robot.
    recovery
        What to believe after a rejection.
    states
        What is known at the start; everything is possible by default.

    Attributes
    ----------
    states
        The set to go on with.
    remaining
        What the last reading has left of it, as far as `Model.refine` can tell.
    """

    def __init__(self, model: Model[States, Motion, Reading], recovery: Recovery = "union", states: States | None = None) -> None:
        self.model = model
        self.recovery = recovery
        self.states = model.universe() if states is None else states
        self.remaining = self.states
        self._steps = 0

    def __repr__(self) -> str:
        return f"<SetMembershipFilter of {self.model!r}, recovery {self.recovery}>"

    def update(self, motion: Motion, reading: Reading) -> Rejection | None:
        """Take one step; return the rejection if no state of the set before it explains the reading."""
        before = self.states
        self._take(self.model.step(before, motion, reading), reading)
        rejection = None
        if self.model.empty(self.remaining):
            rejection = Rejection(self._steps)
            self._take(self._recovered(before, motion, reading), reading)
        self._steps += 1
        return rejection

    def _take(self, states: States, reading: Reading) -> None:
        self.states = states
        self.remaining = self.model.refine(states, reading)

    def _recovered(self, before: States, motion: Motion, reading: Reading) -> States:
        """Return the set to go on with after a rejection."""
        states = self.remaining  # nothing
        if self.recovery == "absorb":
            return states
        if not self.model.exhausted(before, motion):
            states = self.model.anew(reading)
            left = self.model.refine(states, reading)
            states = left if self.model.empty(left) else states
        if self.recovery == "restart" and not self.model.empty(states):
            return states
        return self.model.unite(states, self.model.predict(before, motion))
