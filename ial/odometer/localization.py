"""`localize`: drives a robot with two odometers until it is known where it is, up to symmetry."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction

from ial.active.exploration import ExplorationStep, explore
from ial.errors import ConfigError, ImpossibleError
from ial.maps.polygons.polygon import Polygon
from ial.odometer.belief import FEWEST, OdometerBelief
from ial.odometer.command import Command
from ial.odometer.commanded_robot import CommandedRobot, Executes
from ial.odometer.estimate import OdometerEstimate, Status
from ial.odometer.hypotheses import Hypothesis
from ial.odometer.model import Chord, OdometerModel, States
from ial.odometer.odometer_bounds import OdometerBounds
from ial.odometer.pilot import OPENING, Pilot

MOST_COMMANDS = 100
ONLY = "environment"
"""The name of an environment that is given without one."""


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
        That of the last estimate. `ambiguous`: commands have run out, or do not make the set smaller.
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
    """One localization, while it goes on: an exploration (`ial.active.explore`) with a `Pilot`, and what it leaves.

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
        self._belief = OdometerBelief(models)
        self._robot = CommandedRobot(robot)
        self._most = most_commands
        self._progress = progress
        self._steps: list[Step] = []
        self._trail: list[tuple[Hypothesis, ...]] = []

    def __repr__(self) -> str:
        return f"<Session: {len(self._steps)} commands>"

    @property
    def states(self) -> Mapping[str, States]:
        """What is known now, by environment."""
        return self._belief.states

    def run(self) -> Localization:
        """Drive until it is known where the robot is, or no command helps."""
        candidates, commands = None, 0
        for step in explore(self._belief, self._robot, Pilot(self._belief), most_drives=None):
            if step.decision is not None and step.decision.drive is None:
                break  # no command helps
            found = step.estimate.hypotheses
            self._note(step, found)
            opening = step.decision is None or step.decision.stage == OPENING
            if opening and found is not None and self._belief.measured >= FEWEST:
                candidates = len(found)
            commands += not opening
            if commands >= self._most and not (opening and found is None):
                break
        states = {name: each.configurations if isinstance(each, Chord) else each for name, each in self.states.items()}
        return Localization(self._belief.status, self._trail[-1], tuple(self._steps), candidates, states, tuple(self._trail))

    def _note(self, step: ExplorationStep[OdometerEstimate], found: tuple[Hypothesis, ...] | None) -> None:
        command = step.estimate.command or Command(Fraction(0))
        reason = "to a wall" if step.decision is None else step.decision.reason
        self._steps.append(Step(command, step.estimate.reading, None if found is None else len(found), reason))
        self._trail.append(found or ())
        if step.decision is not None and self._progress is not None:
            self._progress(len(self._steps))
