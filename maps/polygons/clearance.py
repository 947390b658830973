"""`Clearance`: on which parts of its contact edges a disk can stand, as far as single walls tell."""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
import numpy.typing as npt

from ial.contractors.kernels import kernel
from ial.contractors.margins import BELOW
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.walls import FloatArray, IntArray, Walls

_X, _Y, _DX, _DY, _LENGTH = range(5)


@kernel
def _overlaps(px, py, qx, qy, table, shift_x, shift_y, limit, overlaps):  # type: ignore[no-untyped-def]
    """Fill in whether all points of segments lie within a distance of one and the same wall: their two ends do, and walls are convex."""
    for i in range(len(px)):
        overlaps[i] = False
        for j in range(len(table)):
            x, y = table[j, _X] + shift_x, table[j, _Y] + shift_y
            ex, ey, length = table[j, _DX], table[j, _DY], table[j, _LENGTH]
            near = True
            for end in range(2):
                dx, dy = (px[i] - x, py[i] - y) if end == 0 else (qx[i] - x, qy[i] - y)
                along = min(max((dx * ex + dy * ey) / length, 0.0), length) / length
                near = near and (dx - along * ex) ** 2 + (dy - along * ey) ** 2 < limit[i] ** 2
            if near:
                overlaps[i] = True
                break


@dataclass(frozen=True, eq=False)
class Clearance:
    """What the walls of an environment leave to a disk.

    Parameters
    ----------
    solid
        The walls themselves.
    radius
        The radius of the disk.
    """

    solid: Walls
    radius: Fraction

    def __repr__(self) -> str:
        return f"<Clearance of {float(self.radius):g} m from {len(self.solid)} walls>"

    @classmethod
    def of(cls, environment: Environment, radius: Fraction) -> "Clearance":
        """Return the clearance that a disk needs in an environment.

        Raises
        ------
        MapError
            As `Walls.of`.
        """
        return cls(Walls.of(environment), radius)

    def of_parts(self, edges: Walls, walls: IntArray, first: FloatArray, last: FloatArray) -> npt.NDArray[np.bool_]:
        """Return for each part of an edge whether it may hold a disk: False if all of it certainly overlaps one and the same wall.

        Parameters
        ----------
        edges
            The walls that stop the centre, of the same environment and radius.
        walls, first, last
            The parts: numbers of edges, and where on them each part begins and ends, from 0 to 1.
        """
        if not self.radius:
            return np.ones(len(walls), dtype=np.bool_)
        shift = [float(solid - edge) for solid, edge in zip(self.solid.origin, edges.origin, strict=True)]
        table, _ = edges.table
        ends = [table[walls, _X + side] + part * table[walls, _DX + side] for part in (first, last) for side in (0, 1)]
        # What is rounded in a distance is less than what the margin of lengths is for; the shift is one number more in each.
        limit = float(self.radius) * BELOW - 2.0 * edges.margin - edges.bulge[walls]
        overlaps = np.zeros(len(walls), dtype=np.bool_)
        _overlaps(*ends, self.solid.table[0], *shift, np.maximum(limit, 0.0), overlaps)
        return ~overlaps
