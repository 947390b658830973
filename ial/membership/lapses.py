"""`Lapses`: a robot of whose readings some are wrong: relaxation over time."""

from typing import TypeVar

from ial.membership.model import Model

States = TypeVar("States")
Motion = TypeVar("Motion", contravariant=True)
Reading = TypeVar("Reading", contravariant=True)


class Lapses(Model[tuple[States, ...], Motion, Reading]):
    """Sets by the number of readings that are wrong: states k holds what is possible if k of the readings so far are.

    A reading is right, and the robot goes on from k to k with it; or it is wrong, and the robot goes on from k - 1 to k by its motion
    alone. The true state is in one of the sets as long as at most so many readings are wrong as are allowed.

    Parameters
    ----------
    model
        The robot whose readings are right.
    most
        How many of all readings may be wrong.
    """

    def __init__(self, model: Model[States, Motion, Reading], most: int) -> None:
        if most < 0:
            raise ValueError(f"{most} wrong readings cannot be allowed; give at least 0")
        self.model = model
        self.most = most

    def __repr__(self) -> str:
        return f"Lapses({self.model!r}, most={self.most})"

    def universe(self) -> tuple[States, ...]:
        """Return all states, without a wrong reading so far."""
        return (self.model.universe(),)

    def predict(self, states: tuple[States, ...], motion: Motion) -> tuple[States, ...]:
        """Return where a motion can lead, whatever is read."""
        return tuple(self.model.predict(each, motion) for each in states)

    def step(self, states: tuple[States, ...], motion: Motion, reading: Reading) -> tuple[States, ...]:
        """Return where a motion can lead with a reading that is right or wrong."""
        right = [self.model.step(each, motion, reading) for each in states]
        wrong = [self.model.predict(each, motion) for each in states[: self.most]]
        both = [self.model.unite(kept, missed) for kept, missed in zip(right[1:], wrong, strict=False)]
        return (right[0], *both, *wrong[len(both) :])

    def unite(self, allowed: tuple[States, ...], predicted: tuple[States, ...]) -> tuple[States, ...]:
        """Return the union for each number of wrong readings."""
        both = [self.model.unite(*each) for each in zip(allowed, predicted, strict=False)]
        return (*both, *allowed[len(both) :], *predicted[len(both) :])

    def empty(self, states: tuple[States, ...]) -> bool:
        """Return whether no state is left: more readings are wrong than may be, or something else is."""
        return all(self.model.empty(each) for each in states)

    def anew(self, reading: Reading) -> tuple[States, ...]:
        """Return what a reading that is right allows from anywhere; wrong ones are counted anew."""
        return (self.model.anew(reading),)
