"""`Annulus`: the points at a distance from a centre that lies in an interval; rings and discs."""

import math
from collections.abc import Sequence

import numpy as np

from ial.contractors.boxes import FloatArray
from ial.contractors.combinators.combination import Union
from ial.contractors.combinators.trivial_sets import EmptySet
from ial.contractors.contractor import Contractor
from ial.contractors.geometry.distance import contract_distance
from ial.contractors.intervals.interval import Interval
from ial.contractors.kernels import kernel
from ial.contractors.row_contractor import RowContractor
from ial.contractors.threads import run


@kernel
def _contract_rows(start, stop, x, y, near, far, lower, upper):  # type: ignore[no-untyped-def]
    """Narrow rows of (x, y) in place."""
    for i in range(start, stop):
        low, high = lower[i], upper[i]
        _, _, _, _, xl, xu, yl, yu, dl, du = contract_distance(x, x, y, y, low[0], high[0], low[1], high[1], near, far)
        if xl > xu or yl > yu or dl > du:
            low[:] = np.inf
            high[:] = -np.inf
        else:
            low[0], low[1] = xl, yl
            high[0], high[1] = xu, yu


class Annulus(RowContractor):
    """The contractor of "(x, y) lies at a distance from a centre that is in an interval", as a beacon's range says it.

    A box shrinks to the hull of its part in the annulus, up to the rounding of a few operations. With a distance from 0 on this is a disc.
    ``~annulus`` is the contractor of the points nearer or farther, both circles included, and ``Separator.of(annulus)`` is both.

    Parameters
    ----------
    centre
        The point x, y that distances are measured from.
    distance
        The interval of the distance, in the same unit; not below 0 as a whole.

    Raises
    ------
    ValueError
        If the centre is not two finite numbers, or no distance is in the interval.
    """

    dimension = 2

    def __init__(self, centre: Sequence[float], distance: Interval) -> None:
        if len(centre) != 2 or not all(map(math.isfinite, centre)):
            raise ValueError(f"the centre is {centre}; give two finite numbers x, y")
        if distance.upper < 0.0:
            raise ValueError(f"the distance is {distance}; give an interval that holds a number of at least 0")
        self.centre = (float(centre[0]), float(centre[1]))
        self.distance = Interval(max(distance.lower, 0.0), distance.upper)

    def __repr__(self) -> str:
        return f"Annulus({self.centre}, {self.distance!r})"

    def complement(self) -> Contractor:
        """Return the contractor of the points nearer or farther, both circles included."""
        parts: list[Contractor] = []
        if self.distance.lower > 0.0:
            parts.append(Annulus(self.centre, Interval(0.0, self.distance.lower)))
        if self.distance.upper < math.inf:
            parts.append(Annulus(self.centre, Interval(self.distance.upper, math.inf)))
        return Union(*parts) if parts else EmptySet(2)

    def _narrow_rows(self, lower: FloatArray, upper: FloatArray) -> None:
        run(_contract_rows, len(lower), *self.centre, self.distance.lower, self.distance.upper, lower, upper)
