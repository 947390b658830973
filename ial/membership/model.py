"""`Model`: a robot as a constraint problem over sets of its states."""

from abc import abstractmethod
from typing import Protocol, TypeVar

States = TypeVar("States")
Motion = TypeVar("Motion", contravariant=True)
Reading = TypeVar("Reading", contravariant=True)


class Model(Protocol[States, Motion, Reading]):
    """Sets of states, and which of them a motion and a reading allow. Whatever returns a set keeps every possible state in it."""

    @abstractmethod
    def universe(self) -> States:
        """Return all states: nothing is known."""

    @abstractmethod
    def predict(self, states: States, motion: Motion) -> States:
        """Return a set that holds every state which a motion can lead to, whatever is read."""

    @abstractmethod
    def step(self, states: States, motion: Motion, reading: Reading) -> States:
        """Return a set that holds every state which a motion can lead to with a reading."""

    @abstractmethod
    def unite(self, allowed: States, predicted: States) -> States:
        """Return the union of states that a reading allows and of states of which a motion alone is known."""

    @abstractmethod
    def empty(self, states: States) -> bool:
        """Return whether no state is left."""

    def anew(self, reading: Reading) -> States:
        """Return a set that holds every state in which a robot can be that has a reading and may have come from anywhere."""
        return self.universe()

    def refine(self, states: States, reading: Reading) -> States:
        """Return a smaller set that holds every one of the states which a reading allows, too fine to go on with; or the same set.

        None of them is left if it can be proved that the reading allows none.
        """
        return states

    def exhausted(self, states: States, motion: Motion) -> bool:
        """Return whether a step from here tries all that `anew` tries, so that a reading which it has rejected need not be tried again."""
        return False


class ContractingModel(Model[States, Motion, Reading], Protocol[States, Motion, Reading]):
    """A robot whose readings tell about the state in which they are taken: a step is a prediction, and a contraction of it."""

    @abstractmethod
    def contract(self, states: States, reading: Reading) -> States:
        """Return a set that holds every one of the states which a reading allows."""

    def step(self, states: States, motion: Motion, reading: Reading) -> States:
        """Return what the reading leaves of the prediction."""
        return self.contract(self.predict(states, motion), reading)

    def anew(self, reading: Reading) -> States:
        """Return what the reading leaves of all states."""
        return self.contract(self.universe(), reading)
