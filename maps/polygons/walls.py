"""`Walls`: the boundary of an environment as arrays of doubles, with what rounding did to them as a bound."""

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np
import numpy.typing as npt

from ial.contractors.expressions.functions import atan2, hypot
from ial.contractors.margins import ABOVE, ROUNDINGS
from ial.errors import MapError
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.ring import cross

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int32]

MOST_WALLS = 4096
_MARGIN = 16.0 * ROUNDINGS
"""What a length that `ray_shooting` computes may be wrong by, as a part of the scale.

It is a sum of at most eight products of a sine or cosine and a coordinate, or a difference of two; coordinates and points on walls are
themselves rounded: at most eight roundings in each, and eight in the sums, of numbers below twice the scale. That is a third of it.
"""

_LARGEST_SLANT = 2.0**-10
"""Up to here the walls of an environment can be told apart: the shortest may be a part in 10¹¹ of the scale."""


@dataclass(frozen=True, eq=False)
class Walls:
    """The walls of an environment: wall i leads from its own corner to that of wall ``after[i]``, with free space on its left.

    Coordinates are counted from `origin`, so that those of maps far from (0, 0) keep all their bits.

    Parameters
    ----------
    x, y
        The corner at which each wall starts, float64 of shape (walls,), in metres.
    after, before
        The next and the previous wall of its ring, int32.
    bend
        1 where the corner at the start of a wall is convex, −1 where it is reflex, 0 where it is none, int32.
    origin
        The point from which coordinates are counted, exactly, in metres.
    """

    x: FloatArray
    y: FloatArray
    after: IntArray
    before: IntArray
    bend: IntArray
    origin: tuple[Fraction, Fraction]

    def __repr__(self) -> str:
        return f"<Walls: {len(self.x)}>"

    @classmethod
    def of(cls, environment: Environment) -> "Walls":
        """Return the walls of all polygons of an environment.

        Raises
        ------
        MapError
            If there are more than 4096, or one is so short that rounding might turn it.
        """
        rings = [ring for polygon in environment.polygons for ring in polygon.rings]
        count = sum(map(len, rings))
        if count > MOST_WALLS:
            raise MapError(f"the environment has {count} walls; rays are supported among at most {MOST_WALLS}, so simplify its polygons")
        x0, y0, _, _ = environment.bounds
        x: list[float] = []
        y: list[float] = []
        after: list[int] = []
        before: list[int] = []
        bend: list[int] = []
        for ring in rings:
            first, size = len(x), len(ring)
            x += [float(px - x0) for px, _ in ring]
            y += [float(py - y0) for _, py in ring]
            after += [first + (at + 1) % size for at in range(size)]
            before += [first + (at - 1) % size for at in range(size)]
            turns = [cross(ring[at - 1], ring[at], ring[(at + 1) % size]) for at in range(size)]  # type: ignore[arg-type]
            bend += [(turn > 0) - (turn < 0) for turn in turns]
        nexts, previous, bends = (np.array(each, dtype=np.int32) for each in (after, before, bend))
        walls = cls(np.array(x), np.array(y), nexts, previous, bends, (x0, y0))
        if not (walls.lengths.min() > 0.0 and walls.slants.max() <= _LARGEST_SLANT):
            shortest = int(walls.lengths.argmin())
            raise MapError(
                f"a wall at ({float(x0) + walls.x[shortest]:g}, {float(y0) + walls.y[shortest]:g}) is {walls.lengths[shortest]:g} m long "
                f"in an environment of {walls.scale:g} m; doubles hold no such difference: leave out corners that lie so close together"
            )
        return walls

    def __len__(self) -> int:
        return len(self.x)

    @cached_property
    def lengths(self) -> FloatArray:
        """The length of each wall in metres, wrong by rounding."""
        dx, dy = self.x[self.after] - self.x, self.y[self.after] - self.y
        return hypot.bounds((dx, dx), (dy, dy))[1]

    @cached_property
    def angles(self) -> FloatArray:
        """The direction in which each wall leads, in radians, wrong by rounding."""
        dx, dy = self.x[self.after] - self.x, self.y[self.after] - self.y
        return atan2.bounds((dy, dy), (dx, dx))[0]

    @cached_property
    def scale(self) -> float:
        """A length that no distance between two points of the environment exceeds, in metres."""
        return float(hypot(float(self.x.max()), float(self.y.max())).upper) * ABOVE

    @property
    def margin(self) -> float:
        """What a length may be wrong by, in metres."""
        return _MARGIN * self.scale

    @cached_property
    def slants(self) -> FloatArray:
        """What the direction of each wall may be wrong by, in radians: short walls are turned most by the rounding of their ends.

        Four coordinates and two differences are rounded, below the scale; then an angle below 4, or a quotient below 1.
        """
        return ROUNDINGS * (4.0 + self.scale / self.lengths)

    @cached_property
    def table(self) -> tuple[FloatArray, IntArray]:
        """What kernels read: x, y, dx, dy, length, angle and slant of each wall, float64 of shape (walls, 7); after, before and bend."""
        dx, dy = self.x[self.after] - self.x, self.y[self.after] - self.y
        numbers = np.stack([self.x, self.y, dx, dy, self.lengths, self.angles, self.slants], axis=1)
        return np.ascontiguousarray(numbers), np.ascontiguousarray(np.stack([self.after, self.before, self.bend], axis=1))
