"""`Worlds`: a robot that may be in any of several worlds, and does not go from one into another."""

from collections.abc import Mapping
from typing import TypeVar

from ial.membership.model import Model

States = TypeVar("States")
Motion = TypeVar("Motion", contravariant=True)
Reading = TypeVar("Reading", contravariant=True)


class Worlds(Model[dict[str, States], Motion, Reading]):
    """For each world, by its name, the states that are possible there: together they are one set, empty only if all of them are.

    Parameters
    ----------
    models
        The robot in each world; at least one.
    """

    def __init__(self, models: Mapping[str, Model[States, Motion, Reading]]) -> None:
        if not models:
            raise ValueError("no world to be in; give at least one")
        self.models = dict(models)

    def __repr__(self) -> str:
        return f"Worlds({self.models!r})"

    def universe(self) -> dict[str, States]:
        """Return all states of all worlds."""
        return {name: model.universe() for name, model in self.models.items()}

    def predict(self, states: dict[str, States], motion: Motion) -> dict[str, States]:
        """Return where a motion can lead in each world."""
        return {name: model.predict(states[name], motion) for name, model in self.models.items()}

    def step(self, states: dict[str, States], motion: Motion, reading: Reading) -> dict[str, States]:
        """Return where a motion can lead with a reading in each world."""
        return {name: model.step(states[name], motion, reading) for name, model in self.models.items()}

    def unite(self, allowed: dict[str, States], predicted: dict[str, States]) -> dict[str, States]:
        """Return the union in each world."""
        return {name: model.unite(allowed[name], predicted[name]) for name, model in self.models.items()}

    def empty(self, states: dict[str, States]) -> bool:
        """Return whether no state is left in any world."""
        return all(model.empty(states[name]) for name, model in self.models.items())

    def anew(self, reading: Reading) -> dict[str, States]:
        """Return what a reading allows in each world, from anywhere."""
        return {name: model.anew(reading) for name, model in self.models.items()}

    def refine(self, states: dict[str, States], reading: Reading) -> dict[str, States]:
        """Return the refined states of each world."""
        return {name: model.refine(states[name], reading) for name, model in self.models.items()}

    def exhausted(self, states: dict[str, States], motion: Motion) -> bool:
        """Return whether a step from here tries all that `anew` tries in every world."""
        return all(model.exhausted(states[name], motion) for name, model in self.models.items())

    def possible(self, states: dict[str, States]) -> tuple[str, ...]:
        """Return the names of the worlds in which the robot can be."""
        return tuple(name for name, model in self.models.items() if not model.empty(states[name]))
