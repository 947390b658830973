"""`Rays`: what a scan says about free space, in the frame of the robot."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import FloatArray
from ial.contractors.margins import ABOVE


@dataclass(frozen=True, eq=False)
class Rays:
    """Beams as segments in which nothing stands.

    Parameters
    ----------
    origins
        Position of the laser in the base frame at each ray (m), float64 of shape (n, 2).
    angles, turns
        Direction of each ray in the base frame, plus or minus its turn (rad), float64 of shape (n,). Rounding is included.
    lengths
        How far nothing stands (m), float64 of shape (n,); rounded down.
    beams
        The number of the beam, among those of `Beams`, that ended in the same reading; −1 for one without return. int64 of shape (n,).
    margins
        A ray is blocked only if all its neighbours within this distance (m) are, float64 of shape (n,).
    """

    origins: FloatArray
    angles: FloatArray
    turns: FloatArray
    lengths: FloatArray
    beams: npt.NDArray[np.int64]
    margins: FloatArray

    def __len__(self) -> int:
        return len(self.angles)

    def __repr__(self) -> str:
        return f"<Rays: {len(self)}>"

    @property
    def reach_m(self) -> float:
        """How far from the robot something that a ray meets can be, at most (m): beside the end of the ray's strip; 0 without rays."""
        # A strip is looked at along an axis of the map that it is within 57° of: there it is less than twice as wide.
        reaches = np.hypot(*self.origins.T) + self.lengths + 2.0 * self.margins
        return float(reaches.max(initial=0.0) * ABOVE)
