"""`Headings`: the directions a robot can have, the cells it moves by in each, and how a bump turns it."""

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, lru_cache

import numpy as np
import numpy.typing as npt

from ial.errors import ConfigError
from ial.maps.polygons.exact_cosine import cosine_bounds, rational_cosine

MOST_HEADINGS = 2**15
LONGEST_STEP = 2**30  # cells; offsets are int32
_FULL_DEG = 360


@dataclass(frozen=True)
class Headings:
    """Equally spaced headings, of which number t is t / count of a full turn, counter-clockwise from the x axis.

    Parameters
    ----------
    count
        How many there are.
    turn
        φ: by how many of them a bump turns the robot, counter-clockwise, 1 … count − 1.
    step
        h: how far the robot moves in one step, in widths of a cell.

    Raises
    ------
    ConfigError
        If there is no heading or too many, the turn is a multiple of a full turn, or the step is not positive, too long, or so short
        that it leads nowhere in some heading.
    """

    count: int
    turn: int
    step: Fraction = Fraction(1)

    def __post_init__(self) -> None:
        if not 1 <= self.count <= MOST_HEADINGS:
            raise ConfigError(f"the number of headings is {self.count}; give 1 to {MOST_HEADINGS}")
        if self.turn % self.count == 0:
            raise ConfigError(
                "the bouncing angle is a multiple of 360°, so a robot at a wall would stay there for ever; give another angle"
            )
        object.__setattr__(self, "turn", self.turn % self.count)
        if not 0 < self.step <= LONGEST_STEP:
            raise ConfigError(f"the step is {float(self.step):g} cells; give a length greater than 0, and at most {LONGEST_STEP}")
        for heading, (x, y) in enumerate(self.offsets):
            if x == y == 0:
                raise ConfigError(
                    f"a step of {float(self.step):g} cells is too short: in heading {heading} ({float(self.angle_deg(heading)):g}°) it "
                    "rounds to offset (0, 0); give a longer step, or smaller cells"
                )

    @classmethod
    def of_angle(cls, angle_deg: Fraction, count: int | None = None, step: Fraction = Fraction(1)) -> "Headings":
        """Return the headings for a bouncing angle in degrees, by default as few as the angle needs.

        Raises
        ------
        ConfigError
            If the angle is not a multiple of the distance between two headings, or as for the constructor.
        """
        if count is None:
            count = (angle_deg / _FULL_DEG).denominator
        if count < 1:
            raise ConfigError(f"the number of headings is {count}; give 1 to {MOST_HEADINGS}")
        turn = angle_deg * count / _FULL_DEG
        if turn.denominator != 1:
            least = (angle_deg / _FULL_DEG).denominator
            raise ConfigError(
                f"the bouncing angle {float(angle_deg):g}° is not a multiple of {float(Fraction(_FULL_DEG, count)):g}°, the distance "
                f"between {count} headings; give a multiple of {least} headings"
            )
        return cls(count, int(turn), step)

    def angle_deg(self, heading: int) -> Fraction:
        """Return a heading in degrees."""
        return Fraction(_FULL_DEG * heading, self.count)

    @property
    def bounce_deg(self) -> Fraction:
        """φ in degrees."""
        return self.angle_deg(self.turn)

    @property
    def orbit(self) -> int:
        """How many bumps bring a heading back."""
        return self.count // math.gcd(self.turn, self.count)

    @cached_property
    def offsets(self) -> npt.NDArray[np.int32]:
        """The (columns, rows) of each step, int32 of shape (headings, 2); step·(cos, sin) rounded, with halves away from zero."""
        moves = np.empty((self.count, 2), dtype=np.int32)
        for heading in range(self.count):
            part = Fraction(heading, self.count)
            moves[heading] = rounded_cosine(part, self.step), rounded_cosine(part - Fraction(1, 4), self.step)
        moves.setflags(write=False)
        return moves

    @cached_property
    def offset_errors(self) -> tuple[float, float]:
        """By how much offsets are beside the steps they stand for, at most: their direction in degrees, their length as a part of it.

        A robot that is put back to the centre of its cell goes along the offsets; a real one does not.
        """
        moves = self.offsets.astype(np.float64)
        aside = np.degrees(np.arctan2(moves[:, 1], moves[:, 0])) - _FULL_DEG * np.arange(self.count) / self.count
        longer = np.hypot(moves[:, 0], moves[:, 1]) / float(self.step) - 1.0
        return float(np.abs((aside + 180.0) % _FULL_DEG - 180.0).max()), float(np.abs(longer).max())


@lru_cache(maxsize=2**12)  # headings that differ by their bouncing angle only have the same offsets
def rounded_cosine(turn: Fraction, length: Fraction) -> int:
    """Return length·cos(turn) rounded to the nearest whole number, a half away from zero: as if computed without any error.

    Rounding halves away from zero makes opposite headings have opposite offsets, which ``floor(x + 0.5)`` does not; and doubles would
    decide the halves at 60° and 120° by their last bit.

    Parameters
    ----------
    turn
        An angle as a part of a full turn.
    length
        A positive number.
    """
    exact = rational_cosine(turn)
    if exact is not None:
        return _rounded(exact * length)
    for lower, upper in cosine_bounds(turn):  # ends, since an irrational number is no half
        if (rounded := _rounded(lower * length)) == _rounded(upper * length):
            return rounded
    raise AssertionError("bounds end only when the number is decided")


def _rounded(value: Fraction) -> int:
    size = math.floor(abs(value) + Fraction(1, 2))
    return size if value >= 0 else -size
