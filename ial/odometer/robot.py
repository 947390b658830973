"""`OdometerRobot`: a simulated robot with two odometers; it shares no code with the sets that follow it.

It lives in decimal numbers of fifty digits. What is smaller than `_NOTHING` of the size of its world is nothing to it: so it slides along a
wall that it heads along, and stops exactly in corners, though the sine of its heading has a last digit.
"""

import math
import random
from decimal import Context, Decimal, localcontext
from fractions import Fraction

from ial.errors import ConfigError
from ial.maps.polygons.polygon import Polygon, common_denominator, scaled
from ial.maps.polygons.ring import side
from ial.odometer.command import Command
from ial.odometer.odometer_bounds import EXACT, OdometerBounds

_DIGITS = 50
_NOTHING = Decimal("1e-38")
_PI = Decimal("3.14159265358979323846264338327950288419716939937510582097494459")
_INSIDE = 1.0 - 1e-9  # of the bounds: errors that are drawn stay so far inside, so that rounding them keeps them within


class OdometerRobot:
    """A robot in a polygon that turns, drives to the next wall or as far as it is told, and reads how far it came.

    Parameters
    ----------
    polygon
        Where it is.
    x, y
        Where it starts, in metres; a float means exactly that double.
    heading_deg
        Where it looks, in degrees from the x axis, counter-clockwise.
    bounds
        By how much its odometers may be wrong; exact by default.
    seed
        Draws the errors.

    Raises
    ------
    ConfigError
        If it starts outside of the polygon.
    """

    def __init__(
        self,
        polygon: Polygon,
        x: Fraction | float,
        y: Fraction | float,
        heading_deg: Fraction | float,
        bounds: OdometerBounds | None = None,
        seed: int = 0,
    ) -> None:
        if not all(math.isfinite(each) for each in (x, y, heading_deg)):
            raise ConfigError("the start is not finite; give x and y in metres and the heading in degrees")
        px, py = Fraction(x), Fraction(y)
        if not _contains(polygon, px, py):
            raise ConfigError(f"the start ({float(x):g}, {float(y):g}) lies outside of the environment; give a point of its free space")
        self.bounds = bounds or OdometerBounds()
        self._random = random.Random(seed)
        self._context = Context(prec=_DIGITS)
        with localcontext(self._context):
            self._x, self._y = _decimal(px), _decimal(py)
            self._heading_deg = Fraction(heading_deg)
            self._rings = [[(_decimal(cx), _decimal(cy)) for cx, cy in ring] for ring in polygon.rings]
            bounds_of = [_decimal(each) for each in polygon.bounds]
            self._wall: tuple[int, int] | None = None
            self._nothing = _NOTHING * max(bounds_of[2] - bounds_of[0], bounds_of[3] - bounds_of[1])

    def __repr__(self) -> str:
        return f"<OdometerRobot at ({self.x:g}, {self.y:g}), heading {self.heading_deg:g}°>"

    @property
    def x(self) -> float:
        """Where it is: x in metres, to the nearest double."""
        return float(self._x)

    @property
    def y(self) -> float:
        """Where it is: y in metres, to the nearest double."""
        return float(self._y)

    @property
    def heading_deg(self) -> float:
        """Where it looks, in degrees from 0 to 360."""
        return float(self._heading_deg % 360)

    @property
    def heading_rad(self) -> float:
        """Where it looks, in radians from −π to π, to about the nearest double."""
        with localcontext(self._context):
            return float(_decimal((self._heading_deg + 180) % 360 - 180) * _PI / 180)

    def execute(self, command: Command) -> float:
        """Turn, drive, and return the reading of the distance, in metres."""
        turn, part = self._error(self.bounds.turn_deg), Fraction(0)
        if self.bounds.distance_part > EXACT:
            part = self._error(self.bounds.distance_part)
        self._heading_deg = (self._heading_deg + command.turn_deg + turn) % 360
        with localcontext(self._context):
            ux, uy = _direction(self._heading_deg)
            way, corner, wall = self._to_wall(ux, uy)
            factor = _decimal(1 + part)
            if way * factor >= Decimal(command.ahead_m):
                way, corner, wall = Decimal(command.ahead_m) / factor, None, None
                reading = command.ahead_m
            else:
                reading = float(way * factor)
            self._x, self._y = corner or (self._x + way * ux, self._y + way * uy)
            self._wall = wall
        return reading

    def _error(self, bound: float) -> Fraction:
        """Return an error within a bound, which is often nearly as large as it may be."""
        if bound == 0.0:
            return Fraction(0)
        drawn = self._random.choice((-1.0, 1.0, self._random.uniform(-1.0, 1.0), self._random.uniform(-1.0, 1.0)))
        return Fraction(bound * _INSIDE * drawn)

    def _to_wall(self, ux: Decimal, uy: Decimal) -> tuple[Decimal, tuple[Decimal, Decimal] | None, tuple[int, int] | None]:
        """Return how far it is to where a wall stops the robot, and the corner where it does, or the inside of which wall."""
        nothing, best, corner, wall = self._nothing, Decimal("Infinity"), None, None
        for number, ring in enumerate(self._rings):
            count = len(ring)
            seen = [(x - self._x, y - self._y) for x, y in ring]
            off = [ux * y - uy * x for x, y in seen]
            for at in range(count):
                (ax, ay), (bx, by) = seen[at - 1], seen[at]
                across = ux * (by - ay) - uy * (bx - ax)
                stands = self._wall == (number, at)  # its place is rounded, so it is remembered that it is on this wall
                if stands and across > nothing:
                    return Decimal(0), (self._x, self._y), self._wall
                if abs(off[at]) <= nothing:
                    far = ux * bx + uy * by
                    if -nothing <= far < best and not _leaves(seen[at - 1], seen[at], seen[(at + 1) % count], ux, uy):
                        best, corner, wall = max(far, Decimal(0)), ring[at], None
                elif not stands and abs(off[at - 1]) > nothing and (off[at] > 0) != (off[at - 1] > 0):
                    far = (ax * (by - ay) - ay * (bx - ax)) / across
                    out_of = across > 0  # the free space is on the left of a wall, so this one is crossed from inside
                    if (out_of or far > nothing) and -nothing <= far < best:
                        best, corner, wall = max(far, Decimal(0)), None, (number, at)
        if best <= nothing:
            return Decimal(0), (self._x, self._y), wall
        return best, corner, wall


def _leaves(before: tuple[Decimal, Decimal], at: tuple[Decimal, Decimal], after: tuple[Decimal, Decimal], ux: Decimal, uy: Decimal) -> bool:
    """Return whether free space lies ahead of a corner: between the wall that begins there and the one that ends there, both included."""
    fx, fy, bx, by = after[0] - at[0], after[1] - at[1], before[0] - at[0], before[1] - at[1]
    small = _NOTHING * max(map(abs, (fx, fy, bx, by)))
    left = fx * uy - fy * ux >= -small
    right = ux * by - uy * bx >= -small
    wide = fx * by - fy * bx <= small and not (abs(fx * by - fy * bx) <= small and fx * bx + fy * by > 0)
    return (left or right) if wide else (left and right)


def _decimal(number: Fraction) -> Decimal:
    return Decimal(number.numerator) / Decimal(number.denominator)


def _direction(degrees: Fraction) -> tuple[Decimal, Decimal]:
    """Return cosine and sine of an angle; those of right angles exactly."""
    quarter, rest = divmod(degrees % 360, 90)
    angle = _decimal(rest) * _PI / 180
    cosine, sine, term, number = Decimal(1), Decimal(0), Decimal(1), 0
    while abs(term) > Decimal(10) ** -(_DIGITS + 5) and rest:
        number += 1
        term *= angle / number
        if number % 2:
            sine += term if number % 4 == 1 else -term
        else:
            cosine += term if number % 4 == 0 else -term
    return [(cosine, sine), (-sine, cosine), (-cosine, -sine), (sine, -cosine)][int(quarter)]


def _contains(polygon: Polygon, x: Fraction, y: Fraction) -> bool:
    """Return whether a point lies in the closed polygon."""
    scale = math.lcm(common_denominator(polygon.rings), x.denominator, y.denominator)
    point = int(x * scale), int(y * scale)
    outer, *holes = (side(point, scaled(ring, scale)) for ring in polygon.rings)
    return outer >= 0 and all(each <= 0 for each in holes)
