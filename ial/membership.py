"""The one idea behind every localizer here: start from all states, move them with the robot, keep those that the reading allows.

An empty set proves that some assumption is false: the robot was moved by hand, the map is another one, or an error bound was violated.
"""

from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

States = TypeVar("States")
Motion = TypeVar("Motion")
Reading = TypeVar("Reading")
MotionIn = TypeVar("MotionIn", contravariant=True)
ReadingIn = TypeVar("ReadingIn", contravariant=True)


class Model(Protocol[States, MotionIn, ReadingIn]):
    """What a robot can know and how it learns, as operations on sets of states. Each keeps the true state inside."""

    def universe(self) -> States:
        """Return all states: nothing is known."""
        ...

    def predict(self, states: States, motion: MotionIn) -> States:
        """Return a set that holds every state which a motion can lead to."""
        ...

    def contract(self, states: States, reading: ReadingIn) -> States:
        """Return a set that holds every one of the states which a reading allows."""
        ...

    def step(self, states: States, motion: MotionIn, reading: ReadingIn) -> States:
        """Return what is left after a motion and the reading behind it."""
        return self.contract(self.predict(states, motion), reading)

    def refine(self, states: States, reading: ReadingIn) -> States:
        """Return a smaller set that holds every one of the states which a reading allows, too fine to go on with; the same set if none is.

        None of them is left if it can be proved that the reading allows none: then it is rejected.
        """
        return states

    def empty(self, states: States) -> bool:
        """Return whether no state is left."""
        ...


class Recovery(Protocol[States, MotionIn, ReadingIn]):
    """What to believe after a step that left no state."""

    def __call__(self, states: States, motion: MotionIn, reading: ReadingIn) -> States:
        """Return the set to go on with, given the states before the step."""
        ...


@dataclass(frozen=True)
class Rejection:
    """The event that a step left no state: a proof that an assumption is false.

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
        The operations on sets of states.
    recovery
        What to go on with after a rejection.
    states
        What is known at the start; everything is possible by default.

    Attributes
    ----------
    states
        The set to go on with.
    remaining
        What the last reading has left of it, as far as `Model.refine` can tell.
    """

    def __init__(
        self,
        model: Model[States, Motion, Reading],
        recovery: Recovery[States, Motion, Reading],
        states: States | None = None,
    ) -> None:
        self.model = model
        self.recovery = recovery
        self.states = model.universe() if states is None else states
        self.remaining = self.states
        self._steps = 0

    def update(self, motion: Motion, reading: Reading) -> Rejection | None:
        """Take one step; return the rejection if no state of the set before it explains the reading."""
        before = self.states
        self.states = self.model.step(before, motion, reading)
        self.remaining = self.model.refine(self.states, reading)
        rejection = None
        if self.model.empty(self.remaining):
            rejection = Rejection(self._steps)
            self.states = self.recovery(before, motion, reading)
            self.remaining = self.model.refine(self.states, reading)
        self._steps += 1
        return rejection
