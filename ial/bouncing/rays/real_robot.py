"""`RealRobot`: a simulated bouncing robot with real geometry: not a cell map, but a disk or a point among walls.

It is the truth that filters are tried against, so it shares no code with them: positions are whole multiples of 2^-112 m, directions are
right to 100 bits, and headings are exact parts of a full turn. What touches is decided as if all were exact, see `contact_wall`.
"""

import random
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.rays.contact_wall import TINY, ContactWall
from ial.errors import ConfigError, MapError
from ial.maps.polygons.direction import BITS, ONE, direction
from ial.maps.polygons.environment import Environment

_PARTS = 1 << 20  # errors are drawn in such parts of their bounds
_MOST_TRIES = 2_000
_MOST_STEPS = 2**20  # of one leg
_FULL_DEG = 360


@dataclass(frozen=True)
class RealPose:
    """Where the simulated robot is.

    Parameters
    ----------
    observation
        What it has just observed: 1 for a bump, 0 for a step without one. At a bump the robot has already turned.
    x_m, y_m
        Its centre in the frame of the environment, in metres.
    turn
        Its heading as a part of a full turn, counter-clockwise from the x axis.
    """

    observation: int
    x_m: Fraction
    y_m: Fraction
    turn: Fraction


class RealRobot:
    """A robot that drives straight on to a wall, turns, and drives on.

    It bumps where it touches a boundary of a polygon that its heading leads into; a robot that still faces a wall after it has turned bumps
    again at once. What it passes at exactly its radius it only grazes, and drives on: a parallel wall, along which it slides, or a corner.
    A point that comes to a corner drives on if free space of the same polygon lies ahead of it.

    Parameters
    ----------
    environment
        The free space.
    bounce_deg
        φ: by how much a bump turns the robot, counter-clockwise.
    step_m
        h: how far it drives in one step.
    radius_m
        The radius of the robot; 0 for a point.
    bounds
        Its errors are drawn from these bounds.
    seed
        The same seed gives the same run.
    start
        x, y in metres and the heading as a part of a full turn; a place at random if it is left out.

    Raises
    ------
    ConfigError
        If the step is not positive or far too short, the radius is negative, or the start is not free.
    MapError
        If no free place is found.
    """

    def __init__(
        self,
        environment: Environment,
        bounce_deg: Fraction,
        step_m: Fraction,
        radius_m: Fraction = Fraction(0),
        bounds: ExecutionBounds = ExecutionBounds(),  # noqa: B008 (it is immutable)
        seed: int = 0,
        start: tuple[Fraction, Fraction, Fraction] | None = None,
    ) -> None:
        if step_m <= 0:
            raise ConfigError(f"the step is {float(step_m):g} m; give a length greater than 0")
        x0, y0, x1, y1 = environment.bounds
        if max(x1 - x0, y1 - y0) > _MOST_STEPS * step_m:
            raise ConfigError(f"the step is {float(step_m):g} m, and a leg would take more than {_MOST_STEPS} of them; give a longer one")
        if bounce_deg % 360 == 0:
            raise ConfigError(
                "the bouncing angle is a multiple of 360°, so a robot at a wall would stay there for ever; give another angle"
            )
        if radius_m < 0:
            raise ConfigError(f"the radius of the robot is {float(radius_m):g} m; give 0 for a point, or a positive number")
        self.bounce, self.step, self.radius, self.bounds = bounce_deg / _FULL_DEG, step_m, _whole(radius_m), bounds
        self._random = random.Random(seed)
        rings = [[(_whole(x), _whole(y)) for x, y in ring] for polygon in environment.polygons for ring in polygon.rings]
        self._walls = [ContactWall(*ring[at - 1], *ring[at], *ring[at - 2]) for ring in rings for at in range(len(ring))]
        if start is None:
            self.x, self.y = self._free_place(environment)
            self.turn = Fraction(self._random.randrange(1 << 40), 1 << 40)
        else:
            self.x, self.y, self.turn = _whole(start[0]), _whole(start[1]), start[2] % 1
            if not self._is_free(self.x, self.y):
                raise ConfigError(f"the robot cannot start at ({float(start[0]):g}, {float(start[1]):g}); give a free place")

    def __repr__(self) -> str:
        x, y, turn = self.pose
        return f"<RealRobot at x {float(x):g} m, y {float(y):g} m, heading {float(360 * turn):g}°>"

    def _free_place(self, environment: Environment) -> tuple[int, int]:
        x0, y0, x1, y1 = map(_whole, environment.bounds)
        for _ in range(_MOST_TRIES):
            x, y = self._random.randint(x0, x1), self._random.randint(y0, y1)
            if self._is_free(x, y):
                return x, y
        raise MapError(f"no free place was found in {_MOST_TRIES} tries; use a smaller radius, or give a start")

    def _is_free(self, x: int, y: int) -> bool:
        """Return whether a robot there lies in the closed free space."""
        inside = sum(wall.is_crossed_leftwards_of(x, y) for wall in self._walls) % 2 == 1
        nearest = min(wall.square_from(x, y) for wall in self._walls)
        if self.radius:
            return inside and nearest >= max(self.radius - TINY, 0) ** 2
        return inside or nearest <= TINY**2

    def _distance(self, dx: int, dy: int) -> int:
        """Return how far the robot can drive in a direction until it bumps."""
        ways = [way(self.x, self.y, dx, dy, self.radius) for wall in self._walls for way in (wall.way_to_side, wall.way_to_corner)]
        return min(way for way in ways if way is not None)

    def _drawn(self) -> Fraction:
        """Return a number from −1 to 1; the ends are as likely as all the rest, since bounds are broken there if anywhere."""
        some = self._random.randint(-_PARTS, _PARTS)
        return Fraction(self._random.choice((-_PARTS, _PARTS, some, some)), _PARTS)

    def leg(self) -> Iterator[RealPose]:
        """Drive to the next bump, and turn; yield the pose after each observation.

        A clock that counts too few leaves out the last steps; one that counts too many goes on while the robot stands at the wall.
        """
        dx, dy = direction(self.turn)
        x, y, distance = self.x, self.y, self._distance(*direction(self.turn))
        driven, stops = 0, []
        while True:
            driven += _whole(self.step * (1 + self.bounds.step * self._drawn()))
            if driven > distance + TINY:
                break
            stops.append(min(driven, distance))
        wrong = self._random.randint(-self.bounds.count, self.bounds.count)
        stops = stops[: max(len(stops) + wrong, 0)] if wrong <= 0 else stops + wrong * [distance]
        for stop in stops:
            yield RealPose(0, *_metres(x + (stop * dx >> BITS), y + (stop * dy >> BITS)), self.turn)
        self.x, self.y = x + (distance * dx >> BITS), y + (distance * dy >> BITS)
        self.turn = (self.turn + self.bounce + self.bounds.turn_deg * self._drawn() / _FULL_DEG) % 1
        yield RealPose(1, *_metres(self.x, self.y), self.turn)

    def run(self) -> Iterator[RealPose]:
        """Drive on for ever; yield the pose after each observation."""
        while True:
            yield from self.leg()

    @property
    def pose(self) -> tuple[Fraction, Fraction, Fraction]:
        """Where the robot is at the start of its next leg: x and y in metres, and the heading as a part of a full turn."""
        return *_metres(self.x, self.y), self.turn


def _whole(metres: Fraction) -> int:
    return round(metres * ONE)


def _metres(x: int, y: int) -> tuple[Fraction, Fraction]:
    return Fraction(x, ONE), Fraction(y, ONE)
