"""`Sequence`: motions after which a robot with a compass knows where it is, from wherever it starts."""

from dataclasses import dataclass
from typing import Any

from ial.compass.primitive import Direction, bits, primitive
from ial.maps.polygons.polygon import ExactPoint, Polygon

Sizes = tuple[int, int]


@dataclass(frozen=True)
class Sequence:
    """A localizing sequence and its certificate.

    The certificate is about the whole closed polygon. Every point of it lies on the way of a point of the boundary, which the same motion
    leads to the same place: go back from it against the motion until a wall is there. So one motion maps the polygon to what it maps the
    boundary to, and the boundary is all that has to be followed; a robot that starts inside needs no motion before the first one, and an
    arbitrary one there does no harm.

    Parameters
    ----------
    polygon
        The environment.
    directions
        Where the robot drives until it is stopped, step by step: whole numbers or fractions (x, y), which are kept as whole numbers
        without a common divisor.
    sizes
        Of how many open pieces of walls and how many further points the information state consists: at first, when it is the whole
        boundary, and after each step.
    end
        Where the robot is at last, exactly, in metres.

    Raises
    ------
    ConfigError
        If a direction is given in floats, or is (0, 0).
    """

    polygon: Polygon
    directions: tuple[Direction, ...]
    sizes: tuple[Sizes, ...]
    end: ExactPoint

    def __post_init__(self) -> None:
        given: tuple[tuple[Any, Any], ...] = self.directions
        object.__setattr__(self, "directions", tuple(primitive(*each) for each in given))

    def __len__(self) -> int:
        return len(self.directions)

    def __repr__(self) -> str:
        return f"<Sequence of {len(self)} motions in {self.polygon!r}, ends at ({float(self.end[0]):g}, {float(self.end[1]):g})>"

    @property
    def bits(self) -> int:
        """How many bits the longest component of a direction has."""
        return max(map(bits, self.directions), default=0)
