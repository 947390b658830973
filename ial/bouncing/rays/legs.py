"""`Legs`: how far a bouncing robot drives from one bump to the next, where that leads, and how it turns; each as bounds."""

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np
import numpy.typing as npt

from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.rays.ray_set import RaySet
from ial.bouncing.start import Start
from ial.contractors import cos, sin
from ial.contractors.boxes import Boxes
from ial.contractors.intervals.interval import Interval
from ial.contractors.intervals.trigonometric import TWO_PI_LOWER, TWO_PI_UPPER
from ial.contractors.margins import ABOVE, BELOW
from ial.errors import ConfigError
from ial.maps.polygons.walls import FloatArray, Walls

_FULL_DEG = 360


@dataclass(frozen=True, eq=False)
class Legs:
    """The legs of a robot among walls.

    Parameters
    ----------
    walls
        The walls that stop it.
    bounce_deg
        φ, counter-clockwise.
    step_m
        h, in metres.
    bounds
        What the robot may do wrong.

    Raises
    ------
    ConfigError
        If the step is not positive, or the angle is a multiple of 360°.
    """

    walls: Walls
    bounce_deg: Fraction
    step_m: Fraction
    bounds: ExecutionBounds

    def __post_init__(self) -> None:
        if self.step_m <= 0:
            raise ConfigError(f"the step is {float(self.step_m):g} m; give a length greater than 0")
        if self.bounce_deg % _FULL_DEG == 0:
            raise ConfigError("the bouncing angle is a multiple of 360°, so a robot at a wall would stay there; give another angle")

    def __repr__(self) -> str:
        return f"<Legs among {len(self.walls)} walls, {self.bounds}>"

    @cached_property
    def _step(self) -> tuple[float, float]:
        return Interval(self.step_m * (1 - self.bounds.step)).lower, Interval(self.step_m * (1 + self.bounds.step)).upper

    @cached_property
    def _turn(self) -> tuple[float, float]:
        turn = self.bounce_deg % _FULL_DEG  # whole turns would only be rounded
        return radians(turn - self.bounds.turn_deg, turn + self.bounds.turn_deg)

    def ways(self, states: RaySet) -> tuple[FloatArray, FloatArray]:
        """Return how far the robot has driven at least, when it bumps now, and at most, for each piece, in metres."""
        least = np.maximum(states.steps - self.bounds.count, 0).astype(np.float64) * self._step[0]
        most = (states.steps + (self.bounds.count + 1)).astype(np.float64) * self._step[1]
        return least * BELOW, most * ABOVE

    def driven(self, states: RaySet) -> tuple[FloatArray, FloatArray]:
        """Return how far the robot has driven at least, if it has not bumped, and at most, for each piece, in metres."""
        least = np.maximum(states.steps - self.bounds.count, 0) * self._step[0]
        most = np.minimum((states.steps + self.bounds.count) * self._step[1], states.reach)
        return least * BELOW, np.maximum(most, least) * ABOVE

    def can_have_come(self, states: RaySet, start: Start) -> npt.NDArray[np.bool_]:
        """Return for each piece on which a robot arrives now, in its headings, whether it can have come from where it was at the start."""
        least, most = self.ways(states)
        possible: npt.NDArray[np.bool_] = states.reach >= least
        if start.region is None or not len(states):
            return possible
        places = self.moved(states, -np.maximum(np.minimum(most, states.reach), least), -least)
        for side, origin in enumerate(self.walls.origin):
            known = Interval(start.region[side] - origin, start.region[side + 2] - origin)
            possible &= (places.upper[:, side] >= known.lower) & (places.lower[:, side] <= known.upper)
        return possible

    def turned(self, states: RaySet) -> Boxes:
        """Return the headings of robots that bumped and turned."""
        count = len(states)
        return Boxes.column(states.lower[:, 1], states.upper[:, 1]) + Boxes.column(
            np.full(count, self._turn[0]), np.full(count, self._turn[1])
        )

    def with_corners(self, states: RaySet) -> tuple[npt.NDArray[np.int64], RaySet]:
        """Return the set with corners that were touched on both their walls: from a reflex corner, either lets the robot go on.

        Before it, which piece each of its pieces was.
        """
        _, links = self.walls.table
        starting = np.flatnonzero((states.lower[:, 0] <= 0.0) & (links[states.walls, 2] < 0))
        ending = np.flatnonzero((states.upper[:, 0] >= 1.0) & (links[links[states.walls, 0], 2] < 0))
        sets = [states]
        for rows, there, link in ((starting, 1.0, 1), (ending, 0.0, 0)):
            part = states.only(rows)
            lower, upper = part.lower.copy(), part.upper.copy()
            lower[:, 0] = upper[:, 0] = there
            sets.append(RaySet(links[part.walls, link], lower, upper, part.steps, part.arriving, part.reach))
        return np.concatenate([np.arange(len(states)), starting, ending]), RaySet.joined(*sets)

    def moved(self, states: RaySet, near: npt.ArrayLike, far: npt.ArrayLike) -> Boxes:
        """Return boxes of x and y, counted from the origin, of robots that moved along their headings by so much from their pieces."""
        table, _ = self.walls.table
        wall = table[states.walls]
        part, heading = Boxes.column(states.lower[:, 0], states.upper[:, 0]), Boxes.column(states.lower[:, 1], states.upper[:, 1])
        way = Boxes.column(near, far)
        margin = self.walls.margin + self.walls.bulge[states.walls]
        bounds = []
        for side, wave in ((0, cos), (1, sin)):
            moved = part * wall[:, 2 + side : 3 + side] + wall[:, side : 1 + side] + way * wave(heading)
            bounds.append((moved.lower[:, 0] - margin, moved.upper[:, 0] + margin))
        return Boxes(np.stack([low for low, _ in bounds], axis=1), np.stack([high for _, high in bounds], axis=1))


def radians(low_deg: Fraction, high_deg: Fraction) -> tuple[float, float]:
    """Return bounds in radians of an interval of degrees."""
    turn = Interval(TWO_PI_LOWER, TWO_PI_UPPER) * Interval(low_deg / _FULL_DEG, high_deg / _FULL_DEG)
    return turn.lower, turn.upper
