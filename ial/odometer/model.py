"""`OdometerModel`: a robot with a linear and an angular odometer as sets of configurations, for the one filter."""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np

from ial.contractors.intervals.angle import wrap_angle
from ial.contractors.intervals.arithmetic import add
from ial.contractors.rounding import check_rounding
from ial.errors import StreamError
from ial.maps.polygons.exact.congruence import Congruence, near_congruences
from ial.maps.polygons.polygon import Polygon
from ial.membership.model import Model
from ial.odometer.advancing import advanced, stayed, turned
from ial.odometer.chords import chords
from ial.odometer.command import Command
from ial.odometer.configurations import Configurations, FloatArray, dead_ends, everywhere, tidied
from ial.odometer.odometer_bounds import OdometerBounds
from ial.odometer.triples import candidates
from ial.odometer.wall_table import IntArray, WallTable

_FINE = 1e-6  # of the size, and radians: to which width boxes are bisected if the odometers are exact
_COARSE = 1e-2  # the same for a chord that is asked for its boxes
_EXACT_BUDGET, _CHORD_BUDGET, _BUDGET = 1_000, 5_000, 20_000
_HALF_TURN_DEG = 180
SAME = 1e-9
"""Of the size: corners nearer than this are one to any reading, so that symmetries which miss them by no more are symmetries."""


@dataclass(frozen=True, eq=False)
class Chord:
    """What is known after one drive of a robot with exact odometers: it crossed the polygon on a chord of a known length.

    A curve of configurations for each pair of walls; it is kept as the equation that it is until a second drive leaves single points.

    Parameters
    ----------
    model
        The robot.
    length
        Bounds of the length, in metres.
    turn
        Bounds of by how much the robot has turned since, in radians.
    """

    model: "OdometerModel"
    length: tuple[float, float]
    turn: tuple[float, float]

    def __repr__(self) -> str:
        return f"<Chord of {self.length[0]:.6g} m>"

    @cached_property
    def configurations(self) -> Configurations:
        """Boxes around the curve, coarse."""
        model = self.model
        fine = np.array([_COARSE * model.walls.size, _COARSE] * 2)
        headings = turned(everywhere(model.walls).rows, -math.pi, math.pi)
        rows = model.driven(headings, self.length, False, fine, _CHORD_BUDGET)
        return Configurations(model.walls, turned(rows, *self.turn))

    def holds(self, x: float, y: float, heading_rad: float) -> bool:
        """Return whether a configuration lies in one of the boxes around the curve; see `Configurations.holds`."""
        return self.configurations.holds(x, y, heading_rad)


States: TypeAlias = Configurations | Chord


class OdometerModel(Model[States, Command, float]):
    """Sets of configurations of the robot R1 of O'Kane and LaValle (2007), with bounded errors, which the paper does not have.

    A command is a turn and a drive, a reading the distance of the drive. The free space is closed: a robot slides along walls and
    corners that it touches; where it cannot be told on which side it passes, both outcomes are kept.

    Parameters
    ----------
    polygon
        The free space.
    bounds
        By how much the odometers may be wrong.
    budget
        How many boxes a step tries at most; beyond, boxes stay as wide as they are.

    Examples
    --------
    >>> from fractions import Fraction
    >>> from ial.maps import Polygon
    >>> from ial.membership import SetMembershipFilter
    >>> from ial.odometer import Command, OdometerModel
    >>> model = OdometerModel(Polygon(((0, 0), (4, 0), (4, 3), (0, 3))))
    >>> known = SetMembershipFilter(model, "absorb")
    >>> for turn, reading in ((180, 3.75), (90, 2.0)):
    ...     rejection = known.update(Command(Fraction(turn)), reading)
    >>> len(known.states) > 0
    True
    """

    def __init__(self, polygon: Polygon, bounds: OdometerBounds | None = None, budget: int | None = None) -> None:
        self.walls = WallTable(polygon)
        self.bounds = bounds or OdometerBounds()
        self.budget = budget or (_EXACT_BUDGET if self.bounds.exact else _BUDGET)
        size = self.walls.size
        if self.bounds.exact:
            self.fine = np.array([_FINE * size, _FINE, _COARSE * size, _COARSE])
        else:
            fine_m, fine_rad = (
                max(0.5 * self.bounds.distance_part * size, _FINE * size),
                max(0.5 * math.radians(self.bounds.turn_deg), _FINE),
            )
            self.fine = np.array([fine_m, fine_rad, fine_m, fine_rad])
        self._chords: FloatArray = chords(self.walls.corners, self.walls.edges, self.walls.links, size)

    def __repr__(self) -> str:
        return f"<OdometerModel among {len(self.walls)} walls, {self.bounds!r}>"

    @cached_property
    def symmetries(self) -> list[Congruence]:
        """The rotations that lay the environment upon itself: between their images, no motion of the robot can tell."""
        return near_congruences(self.walls.polygon, self.walls.polygon, SAME * self.walls.size)

    def universe(self) -> States:
        """Return every configuration in which a wall has stopped a robot: what is known after a first drive, whatever that read."""
        return everywhere(self.walls)

    def predict(self, states: States, motion: Command) -> States:
        """Return where a command can lead, whatever is read."""
        check_rounding()
        boxes = _boxes(states)
        rows = turned(boxes.rows, *self.bounds.turn(motion.turn_deg))
        most = self.bounds.distance(motion.ahead_m)[1] if math.isfinite(motion.ahead_m) else math.inf
        parts = [stayed(*self._facing, rows), self.driven(rows, (0.0, min(most, 3.0 * self.walls.size)), False)]
        if math.isfinite(motion.ahead_m):
            parts.append(self.driven(rows, self.bounds.distance(motion.ahead_m), True))
        return Configurations(self.walls, self._tidied(np.concatenate(parts)))

    def step(self, states: States, motion: Command, reading: float) -> States:
        """Return where a command can lead with a reading, in metres.

        Raises
        ------
        StreamError
            If the reading is negative or not finite.
        """
        check_rounding()
        check_distance(reading)
        turn = self.bounds.turn(motion.turn_deg)
        if reading == 0.0:
            return self._stopped(states, motion, turn)
        way = self.bounds.distance(reading)
        free = reading >= motion.ahead_m
        if self.bounds.exact and not free:
            if isinstance(states, Chord):
                return Configurations(self.walls, self._tidied(self.crossings(states, turn, way)[0]))
            if states.everywhere:
                return Chord(self, way, (0.0, 0.0))
        rows = self.driven(turned(_boxes(states).rows, *turn), way, free)
        return Configurations(self.walls, self._tidied(rows))

    def unite(self, allowed: States, predicted: States) -> States:
        """Return the boxes of either set."""
        one, other = _boxes(allowed), _boxes(predicted)
        return Configurations(self.walls, self._tidied(np.concatenate([one.rows, other.rows])))

    def empty(self, states: States) -> bool:
        """Return whether no configuration is left; of a chord, whether no two walls are as far apart as it is long."""
        if isinstance(states, Chord):
            low, high = states.length
            return not bool(((self._chords[..., 0] <= high) & (self._chords[..., 1] >= low)).any())
        return len(states) == 0

    def crossings(self, chord: Chord, turn: tuple[float, float], way: tuple[float, float]) -> tuple[FloatArray, FloatArray]:
        """Return the configurations after a second drive, and where they came from; see `ial.odometer.triples.candidates`.

        Parameters
        ----------
        chord
            What the first drive left.
        turn
            Bounds of the turn before the second one, in radians.
        way
            Bounds of the length of the second one, in metres.
        """
        walls = self.walls
        table = walls.corners, walls.edges, walls.links, walls.size, self._chords
        found: tuple[FloatArray, FloatArray]
        found = candidates(*table, np.array(chord.length), np.array(way), *wrap_angle(*add(*chord.turn, *turn)))
        return found

    def driven(
        self, rows: FloatArray, way: tuple[float, float], free: bool, fine: FloatArray | None = None, budget: int | None = None
    ) -> FloatArray:
        """Return the rows to which robots come that drive on: rows with the headings of the drive, and bounds of its length in metres."""
        walls = self.walls
        found: FloatArray
        found, _ = advanced(
            walls.corners,
            walls.edges,
            walls.links,
            walls.lengths,
            rows,
            np.array(way),
            free,
            self.fine if fine is None else fine,
            budget or self.budget,
        )
        return found

    @property
    def _facing(self) -> tuple[FloatArray, FloatArray, IntArray, FloatArray]:
        return self.walls.corners, self.walls.edges, self.walls.links, self.walls.facing

    def _stopped(self, states: States, motion: Command, turn: tuple[float, float]) -> States:
        """Return where robots are that have turned and could not drive on."""
        if isinstance(states, Chord):  # that a wall is ahead says little; it is not used
            return Chord(self, states.length, add(*states.turn, *turn))
        if states.everywhere and self.bounds.turn_deg == 0.0 and motion.turn_deg % 360 == _HALF_TURN_DEG:
            return dead_ends(self.walls)
        return Configurations(self.walls, self._tidied(stayed(*self._facing, turned(states.rows, *turn))))

    def _tidied(self, rows: FloatArray) -> FloatArray:
        """Return fewer rows that hold the same, at most as many as the budget; for that they are joined in cells as coarse as need be."""
        fine_m, fine_rad = float(self.fine[0]), float(self.fine[1])
        rows = tidied(rows, fine_m, fine_rad, self.walls.lengths)
        while len(rows) > self.budget:
            fine_m, fine_rad = 2.0 * fine_m, 2.0 * fine_rad
            rows = tidied(rows, fine_m, fine_rad, self.walls.lengths)
        return rows


def check_distance(reading: float) -> None:
    """Refuse a reading, in metres, that is no distance.

    Raises
    ------
    StreamError
        If it is negative or not finite.
    """
    if not 0.0 <= reading < math.inf:
        raise StreamError(f"a robot cannot have driven {reading} m; give distances that are not negative")


def _boxes(states: States) -> Configurations:
    return states.configurations if isinstance(states, Chord) else states
