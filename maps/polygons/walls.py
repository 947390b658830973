"""`Walls`: the boundary of an environment, or of where a disk's centre can be, as arrays of doubles, with bounds of what rounding did."""

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np
import numpy.typing as npt

from ial.contractors.expressions.functions import atan2, hypot
from ial.contractors.margins import ABOVE, ROUNDINGS
from ial.errors import ConfigError, MapError
from ial.maps.polygons.contact_edge import contact_edges
from ial.maps.polygons.environment import Environment

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

    Coordinates are counted from `origin`, so that those of maps far from (0, 0) keep all their bits. For a disk, the walls are those that
    stop its centre, see `contact_edge`.

    Parameters
    ----------
    x, y
        The corner at which each wall starts, float64 of shape (walls,), in metres.
    after, before
        The next and the previous wall of its ring, int32.
    bend
        1 where the corner at the start of a wall is convex, −1 where it is reflex, 0 where it is none, 2 where that is no help, int32.
    bulge
        How far what stops a robot lies before the wall, at most, float64, in metres; 0 but for the arcs around corners of a disk.
    tilt
        By how much that is turned from the wall, at most, float64, in radians; −2 where nothing stops there.
    origin
        The point from which coordinates are counted, exactly, in metres.
    """

    x: FloatArray
    y: FloatArray
    after: IntArray
    before: IntArray
    bend: IntArray
    bulge: FloatArray
    tilt: FloatArray
    origin: tuple[Fraction, Fraction]

    def __repr__(self) -> str:
        return f"<Walls: {len(self.x)}>"

    @classmethod
    def of(cls, environment: Environment, radius: Fraction = Fraction(0)) -> "Walls":
        """Return the walls of all polygons of an environment.

        Parameters
        ----------
        environment
            The free space.
        radius
            The radius of the robot in metres; 0 for a point.

        Raises
        ------
        ConfigError
            If the radius is negative.
        MapError
            If there are more than 4096, one is so short that rounding might turn it, or the robot is too large.
        """
        if radius < 0:
            raise ConfigError(f"the radius of the robot is {float(radius):g} m; give 0 for a point, or a positive number")
        x0, y0, x1, y1 = environment.bounds
        if 2 * radius > min(x1 - x0, y1 - y0):
            raise MapError(f"a robot of radius {float(radius):g} m fits nowhere in the environment; check both")
        rings = [contact_edges(ring, radius) for polygon in environment.polygons for ring in polygon.rings]
        edges = [edge for ring in rings for edge in ring]
        if len(edges) > MOST_WALLS:
            raise MapError(
                f"the environment has {len(edges)} walls; rays are supported among at most {MOST_WALLS}, so simplify them (--simplify)"
            )
        x0, y0 = x0 - radius, y0 - radius
        after: list[int] = []
        before: list[int] = []
        for ring in rings:
            first, size = len(after), len(ring)
            after += [first + (at + 1) % size for at in range(size)]
            before += [first + (at - 1) % size for at in range(size)]
        nexts, previous, bends = (np.array(each, dtype=np.int32) for each in (after, before, [edge.bend for edge in edges]))
        x, y = np.array([float(edge.x - x0) for edge in edges]), np.array([float(edge.y - y0) for edge in edges])
        bulge, tilt = np.array([edge.bulge_m for edge in edges]), np.array([edge.tilt for edge in edges])
        walls = cls(x, y, nexts, previous, bends, bulge, tilt, (x0, y0))
        if not (walls.lengths.min() > 0.0 and walls.slants.max() <= _LARGEST_SLANT):
            shortest = int(walls.lengths.argmin())
            if radius:
                raise MapError(
                    f"at ({float(x0) + walls.x[shortest]:g}, {float(y0) + walls.y[shortest]:g}) the centre of a robot of radius "
                    f"{float(radius):g} m has {walls.lengths[shortest]:g} m to go around a corner, which doubles do not hold; leave out "
                    "corners where walls hardly turn, or give 0 for a point"
                )
            raise MapError(
                f"a wall at ({float(x0) + walls.x[shortest]:g}, {float(y0) + walls.y[shortest]:g}) is {walls.lengths[shortest]:g} m long "
                f"in an environment of {walls.scale:g} m; doubles hold no such difference: leave out corners that lie so close together"
            )
        return walls

    def __len__(self) -> int:
        return len(self.x)

    @property
    def stopping(self) -> npt.NDArray[np.bool_]:
        """Whether a robot can bump at each wall; others are only there to close rings."""
        return self.tilt >= 0.0

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
        """What kernels read of each wall, float64 of shape (walls, 9), int32 of shape (walls, 3).

        x, y, dx, dy, length, angle, slant, bulge and tilt; after, before and bend.
        """
        dx, dy = self.x[self.after] - self.x, self.y[self.after] - self.y
        numbers = np.stack([self.x, self.y, dx, dy, self.lengths, self.angles, self.slants, self.bulge, self.tilt], axis=1)
        return np.ascontiguousarray(numbers), np.ascontiguousarray(np.stack([self.after, self.before, self.bend], axis=1))
