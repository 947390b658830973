"""`OdometerBelief`: what a robot with odometers knows: sets of configurations, the hypotheses in them, and whether they are one."""

import math
from collections.abc import Mapping, Sequence
from functools import cache

from ial.errors import ConfigError
from ial.maps.polygons.exact.congruence import Congruence, near_congruences
from ial.membership import SetMembershipFilter, Worlds
from ial.odometer.command import Command
from ial.odometer.estimate import OdometerEstimate, Status
from ial.odometer.hypotheses import Hypothesis, hypotheses, one_orbit
from ial.odometer.model import SAME, Chord, OdometerModel, States, check_distance
from ial.pose import Pose

NARROW = 1e-4
"""Of the size, and radians: a hypothesis so narrow is a point to a robot with exact odometers."""
_PAYS = 0.95
_PATIENCE = 6  # commands that make nothing narrower, before a hypothesis is called as narrow as it gets
FEWEST = 2
"""Measured drives that leave hypotheses, and not curves."""


class OdometerBelief:
    """What is known of where a robot with odometers is, in any of several environments.

    It begins with a drive to a wall, of which the length is not used. Two drives more leave hypotheses, each in one environment.

    Parameters
    ----------
    models
        The robot in each environment, by name; they can be kept for the next belief.

    Raises
    ------
    ConfigError
        If there is no environment.

    Attributes
    ----------
    size
        About the larger side of the largest environment, in metres.
    exact
        Whether the odometers are exact in all of them.
    measured
        How many drives have moved the robot, without the first one.
    estimate
        The last answer; None before the first drive.
    moved
        Where it is by its odometers, as seen from where the first drive ended.
    """

    def __init__(self, models: Mapping[str, OdometerModel]) -> None:
        if not models:
            raise ConfigError("there is no environment to be in; give at least one")
        self.models = dict(models)
        self.size = max(model.walls.size for model in self.models.values())
        self.exact = all(model.bounds.exact for model in self.models.values())
        self.measured = 0
        self.estimate: OdometerEstimate | None = None
        self.moved = Pose(0.0, 0.0, 0.0)
        self._filter: SetMembershipFilter[dict[str, States], Command, float] = SetMembershipFilter(Worlds(self.models), "absorb")
        self._motions = cache(self._found_motions)
        self._best, self._vain = math.inf, 0

    def __repr__(self) -> str:
        return f"<OdometerBelief in {len(self.models)} environment{'s' * (len(self.models) != 1)}: {self.status}>"

    @property
    def states(self) -> Mapping[str, States]:
        """What is known now, by environment."""
        return self._filter.states

    @property
    def status(self) -> Status:
        """The status of the last answer."""
        return "ambiguous" if self.estimate is None else self.estimate.status

    def update(self, command: Command | None, reading: float, *, collided: bool = False) -> OdometerEstimate:
        """Take a command and how far the robot drove then.

        Parameters
        ----------
        command
            None for the first drive, to the wall ahead.
        reading
            The distance by its odometer, in metres.
        collided
            Makes no difference: that walls stop this robot is what it is localized by.

        Raises
        ------
        StreamError
            If the reading is negative or not finite.
        """
        check_distance(reading)
        if command is not None:
            self._filter.update(command, reading)
            self.measured += reading > 0.0
            turn = math.radians(command.turn_deg)
            self.moved = self.moved @ Pose(reading * math.cos(turn), reading * math.sin(turn), turn)
        found: tuple[Hypothesis, ...] | None = None
        if self._filter.model.empty(self._filter.states):
            found = ()
        elif self.measured >= FEWEST:
            found = tuple(self.found(self._filter.states))
        self.estimate = OdometerEstimate(self._judged(found), found, command, reading)
        return self.estimate

    def found(self, states: Mapping[str, States]) -> list[Hypothesis]:
        """Return the hypotheses of sets in all environments."""
        boxes = {name: each.configurations if isinstance(each, Chord) else each for name, each in states.items()}
        return [each for name, sets in boxes.items() for each in hypotheses(name, sets)]

    def width(self, found: Sequence[Hypothesis]) -> float:
        """Return how wide the widest of some hypotheses is: its diagonal as a part of the size, and its interval of headings, added."""
        return max(each.width_m / self.size + each.width_rad for each in found)

    def same(self, found: Sequence[Hypothesis]) -> bool:
        """Return whether all hypotheses are images of the first one, so that no motion tells them apart."""
        return one_orbit(found, self._motions, self.size)

    def _judged(self, found: Sequence[Hypothesis] | None) -> Status:
        if found is None:
            return "ambiguous"
        if not found:
            return "rejected"
        if len(found) > sum(len(self._motions(found[0].world, name)) for name in self.models) or not self.same(found):
            return "ambiguous"
        if not self._narrow(self.width(found)):
            return "ambiguous"
        return "localized" if len(found) == 1 else "symmetric"

    def _narrow(self, widest: float) -> bool:
        """Return whether hypotheses are as narrow as they get."""
        if self.exact:
            return widest <= NARROW
        self._vain = 0 if widest < _PAYS * self._best else self._vain + 1
        self._best = min(self._best, widest)
        return self._vain >= _PATIENCE

    def _found_motions(self, one: str, other: str) -> list[Congruence]:
        if one == other:
            return self.models[one].symmetries
        return near_congruences(self.models[one].walls.polygon, self.models[other].walls.polygon, SAME * self.size)
