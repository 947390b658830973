"""`localize`: drives a robot with two odometers until it is known where it is, up to symmetry."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Literal, Protocol

from ial.errors import ConfigError, ImpossibleError
from ial.maps.polygons.polygon import Polygon
from ial.membership import SetMembershipFilter, Worlds
from ial.odometer.command import Command
from ial.odometer.hypotheses import Hypothesis
from ial.odometer.model import Chord, OdometerModel, States
from ial.odometer.odometer_bounds import OdometerBounds
from ial.odometer.opening_moves import OpeningMoves
from ial.odometer.pilot import Pilot

MOST_COMMANDS = 100
ONLY = "environment"
"""The name of an environment that is given without one."""

Status = Literal["localized", "symmetric", "ambiguous", "rejected"]


class Executes(Protocol):
    """A robot, real or simulated."""

    def execute(self, command: Command) -> float:
        """Turn, drive until a wall stops the robot or it has come far enough, and return how far the odometer says it came, in metres."""


@dataclass(frozen=True)
class Step:
    """A command and what came of it.

    Parameters
    ----------
    command
        What the robot was told.
    reading
        How far it drove by its odometer, in metres.
    hypotheses
        How many hypotheses were left; none while they are curves for each pair of walls.
    reason
        Why this command: to the first wall, for candidates, to tell them apart by a direction, by a place that only one of them has, or to
        make the set smaller.
    """

    command: Command
    reading: float
    hypotheses: int | None
    reason: str


@dataclass(frozen=True)
class Localization:
    """What a robot has found out.

    Parameters
    ----------
    status
        `localized`: one hypothesis. `symmetric`: several that are images of each other under motions that lay the environments upon each
        other, so that no motion of the robot can tell them apart. `ambiguous`: commands have run out, or do not make the set smaller.
        `rejected`: no configuration explains the readings, so an assumption is false.
    hypotheses
        Where the robot may be; the truth is in the boxes around one of them, as long as the assumptions hold.
    steps
        All commands.
    candidates
        How many hypotheses the two first measured drives have left; None if the robot did not come so far.
    states
        The sets, by environment.
    trail
        The hypotheses after each step; empty while they are curves.
    """

    status: Status
    hypotheses: tuple[Hypothesis, ...]
    steps: tuple[Step, ...]
    candidates: int | None
    states: Mapping[str, States] = field(repr=False)
    trail: tuple[tuple[Hypothesis, ...], ...] = field(repr=False, default=())

    @property
    def width_m(self) -> float:
        """The largest diagonal of a hypothesis in metres; infinite if there is none."""
        return max((each.width_m for each in self.hypotheses), default=math.inf)

    @property
    def narrowest(self) -> Hypothesis | None:
        """The narrowest hypothesis that was ever alone: how far the set could be made to shrink; None if none was."""
        alone = [found[0] for found in self.trail if len(found) == 1]
        return min(alone, key=lambda each: each.width_m, default=None)

    @property
    def width_rad(self) -> float:
        """The widest interval of headings of a hypothesis in radians; infinite if there is none."""
        return max((each.width_rad for each in self.hypotheses), default=math.inf)


def localize(
    environment: Polygon | Mapping[str, Polygon],
    robot: Executes,
    bounds: OdometerBounds | None = None,
    most_commands: int = MOST_COMMANDS,
    progress: Callable[[int], object] | None = None,
) -> Localization:
    """Drive a robot until it is localized up to symmetry.

    To the wall ahead; back, which is measured; and at right angles to that, measured again (O'Kane and LaValle 2007, section IV-B). This
    leaves finitely many configurations, or some curves of them (`ial.odometer.triples`). They are told apart by that of 72 directions which
    leaves the fewest on average, and where none does by a way to a place that only one of two has (section IV-D).

    Parameters
    ----------
    environment
        The free space; or several by their names, if the robot may be in any of them.
    robot
        Is driven.
    bounds
        By how much its odometers may be wrong; not at all by default, but for rounding.
    most_commands
        After how many commands to give up, those to leave a corner and to find candidates not counted.
    progress
        Called after each command with their number.

    Raises
    ------
    ConfigError
        If there is no environment, or fewer than four commands are allowed.
    ImpossibleError
        If the robot has no linear odometer: see `ial.odometer.undecided`.
    """
    if bounds is not None and not bounds.measures:
        raise ImpossibleError(
            "a robot that can turn by known angles and feel walls, but measures no distance, cannot be localized in any polygon: whatever "
            "it does, a whole segment of places remains possible (O'Kane and LaValle, Localization with limited sensing, 2007, section VI, "
            "robot R3); give it a linear odometer, or a compass"
        )
    worlds = {ONLY: environment} if isinstance(environment, Polygon) else dict(environment)
    if not worlds:
        raise ConfigError("there is no environment to be in; give at least one")
    if most_commands < 4:
        raise ConfigError(f"{most_commands} commands do not localize a robot; allow at least 4")
    models = {name: OdometerModel(polygon, bounds) for name, polygon in worlds.items()}
    return Session(models, robot, most_commands, progress).run()


class Session:
    """One localization, while it goes on.

    Parameters
    ----------
    models
        The robot in each environment; they can be kept for the next localization.
    robot
        Is driven.
    most_commands
        After how many commands to give up, those to leave a corner and to find candidates not counted.
    progress
        Called after each command with their number.
    """

    def __init__(
        self,
        models: Mapping[str, OdometerModel],
        robot: Executes,
        most_commands: int = MOST_COMMANDS,
        progress: Callable[[int], object] | None = None,
    ) -> None:
        self._progress = progress
        self._models = dict(models)
        self._robot = robot
        self._most = most_commands
        self._filter: SetMembershipFilter[dict[str, States], Command, float] = SetMembershipFilter(Worlds(self._models), "absorb")
        self._steps: list[Step] = []
        self._trail: list[tuple[Hypothesis, ...]] = []
        self._pilot = Pilot(self._models)

    def __repr__(self) -> str:
        return f"<Session: {len(self._steps)} commands>"

    @property
    def states(self) -> Mapping[str, States]:
        """What is known now, by environment."""
        return self._filter.states

    def run(self) -> Localization:
        """Drive until it is known where the robot is, or no command helps."""
        first = Command(Fraction(0))
        self._steps.append(Step(first, self._robot.execute(first), None, "to a wall"))
        self._trail.append(())
        candidates = self._open()
        if self._filter.model.empty(self._filter.states):
            return self._ended("rejected", (), candidates)
        self._most += len(self._steps)
        found = self._pilot.found(self._filter.states)
        while not self._pilot.finished(found, self._filter.states):
            planned = self._pilot.commands(found, self._filter.states)
            if not planned or len(self._steps) >= self._most:
                return self._ended("ambiguous", found, candidates)
            for command, reason in planned:
                moved = self._drive(command, reason)
                if self._filter.model.empty(self._filter.states):
                    return self._ended("rejected", (), candidates)
                before, found = found, self._pilot.found(self._filter.states)
                self._note(found)
                if not moved or len(found) < len(before) or len(self._steps) >= self._most:
                    break  # what was planned on is no longer so
        return self._ended("localized" if len(found) == 1 else "symmetric", found, candidates)

    def _open(self) -> int | None:
        """Drive back from the wall and then across; return how many hypotheses that leaves."""
        moves = OpeningMoves([model.walls for model in self._models.values()])
        for command in moves.back():
            if self._drive(command, "for candidates"):
                break
        for command in moves.across():
            if self._filter.model.empty(self._filter.states):
                break
            if self._drive(command, "for candidates"):
                found = self._pilot.found(self._filter.states)
                self._note(found)
                return len(found)
        return None

    def _drive(self, command: Command, reason: str) -> bool:
        """Execute a command; return whether the robot came as far as it was told, or moved at all if it was told no distance."""
        reading = self._robot.execute(command)
        self._filter.update(command, reading)
        self._steps.append(Step(command, reading, None, reason))
        if self._progress is not None:
            self._progress(len(self._steps))
        self._trail.append(())
        return reading >= command.ahead_m or (math.isinf(command.ahead_m) and reading > 0.0)

    def _note(self, found: Sequence[Hypothesis]) -> None:
        last = self._steps[-1]
        self._steps[-1] = Step(last.command, last.reading, len(found), last.reason)
        self._trail[-1] = tuple(found)

    def _ended(self, status: Status, found: Sequence[Hypothesis], candidates: int | None) -> Localization:
        states = {name: each.configurations if isinstance(each, Chord) else each for name, each in self._filter.states.items()}
        return Localization(status, tuple(found), tuple(self._steps), candidates, states, tuple(self._trail))
