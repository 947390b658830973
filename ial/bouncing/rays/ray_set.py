"""`RaySet`: where a robot with real geometry can be, as pieces of walls with intervals of headings."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.maps.polygons.walls import FloatArray, IntArray

BoolArray = npt.NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class RaySet:
    """Closed pieces of walls, each with headings; the robot is on a leg that one of them describes.

    Parameters
    ----------
    walls
        The wall of each piece, int32 of shape (pieces,).
    lower, upper
        Bounds of the part of the wall, from 0 to 1, and of the heading in radians, float64 of shape (pieces, 2).
    steps
        How many steps were observed since the last bump, int32 of shape (pieces,).
    arriving
        False if the robot left from the piece, in these headings; true if it has not bumped yet, and will bump there, in these headings.
    reach
        How far the robot can drive from the piece, or can have driven to it, at most, in metres, float64 of shape (pieces,).
    """

    walls: IntArray
    lower: FloatArray
    upper: FloatArray
    steps: IntArray
    arriving: BoolArray
    reach: FloatArray

    def __len__(self) -> int:
        return len(self.walls)

    def __repr__(self) -> str:
        return f"<RaySet of {len(self)} pieces>"

    def only(self, kept: npt.NDArray[np.bool_] | npt.NDArray[np.int64]) -> "RaySet":
        """Return some of the pieces."""
        return RaySet(self.walls[kept], self.lower[kept], self.upper[kept], self.steps[kept], self.arriving[kept], self.reach[kept])

    @classmethod
    def joined(cls, *sets: "RaySet") -> "RaySet":
        """Return the union of sets."""
        names = ("walls", "lower", "upper", "steps", "arriving", "reach")
        return cls(*(np.concatenate([getattr(each, name) for each in sets]) for name in names))
