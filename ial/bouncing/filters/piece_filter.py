"""`PieceFilter`: the set filter of a robot with real geometry and bounded errors, and when it counts as localized."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from fractions import Fraction

from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.filters.goal import Goal
from ial.bouncing.rays.first_bump import FirstBumps
from ial.bouncing.rays.legs import Legs
from ial.bouncing.rays.piece_map import PieceMap
from ial.bouncing.rays.piece_model import NOT_BUMPED, PieceModel, PieceSet
from ial.bouncing.start import ANYWHERE, Start


@dataclass(frozen=True, eq=False)
class PieceFilter:
    """A filter for one environment. `PieceModel` follows its sets.

    Parameters
    ----------
    map
        The pieces, and where robots come to from them.
    name
        The name of the environment.
    bounce_deg, step_m
        The bouncing angle, counter-clockwise, and the length of a step.
    bounds
        What the robot may do wrong.
    goal
        When the robot counts as localized.
    radius_m
        The radius of the robot, whose place is its centre; 0 for a point.
    first
        Where the robot can be after its first bump, if something is known of its start.
    """

    map: PieceMap
    name: str
    bounce_deg: Fraction
    step_m: Fraction
    bounds: ExecutionBounds
    goal: Goal
    radius_m: Fraction = Fraction(0)
    first: FirstBumps | None = None

    def __repr__(self) -> str:
        return f"<PieceFilter of {len(self.map)} pieces for {self.name}, {self.bounds}>"

    @property
    def model(self) -> PieceModel:
        """The sets of a robot from its start on."""
        return PieceModel(self.map, self.first)

    @property
    def anywhere(self) -> PieceModel:
        """The sets of a robot that was carried elsewhere."""
        return PieceModel(self.map)

    def starting(self, start: Start) -> "PieceFilter":
        """Return the filter of a robot of whose start something is known.

        Raises
        ------
        ConfigError
            If it can have started nowhere.
        """
        if start == ANYWHERE:
            return replace(self, first=None)
        return replace(self, first=FirstBumps.of(self.map, Legs(self.map.walls, self.bounce_deg, self.step_m, self.bounds), start))

    def after_bumps(self, observations: Iterable[int]) -> list[PieceSet]:
        """Return what is left after each bump of a stream."""
        model, sets = self.model, []
        states = model.universe()
        for observation in observations:
            states = model.step(states, None, observation)
            sets += [states] * observation
        return sets

    def box(self, states: PieceSet) -> tuple[float, float, float, float] | None:
        """Return a rectangle that holds the place of the last bump: least x and y, greatest x and y; None if there is none to tell."""
        if not len(states) or (states.pieces == NOT_BUMPED).any():
            return None
        return self.map.bounds_m(states.pieces)

    def is_localized(self, states: PieceSet) -> bool:
        """Return whether the last bump was certainly in one of the rooms, or its place is known to the width of the goal."""
        box = self.box(states)
        if box is None:
            return False
        x0, y0, x1, y1 = map(Fraction, box)
        width = self.goal.width
        return self.room(states) is not None if width is None else max(x1 - x0, y1 - y0) <= width

    def room(self, states: PieceSet) -> str | None:
        """Return the room in which the last bump certainly was; None if that cannot be told."""
        box = self.box(states)
        if box is None:
            return None
        x0, y0, x1, y1 = map(Fraction, box)
        rooms = (each for each in self.goal.rooms if each.environment in ("", self.name))
        return next((each.name for each in rooms if each.x0 <= x0 and each.y0 <= y0 and x1 <= each.x1 and y1 <= each.y1), None)
