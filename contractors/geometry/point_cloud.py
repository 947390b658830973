"""`PointCloud`: the contractor of a finite set of points."""

import numpy.typing as npt

from ial.contractors.geometry.segment import Segments


class PointCloud(Segments):
    """The contractor of "this point is one of m given points": boxes shrink to the hull of the points in them, exactly.

    A box is narrowed in a time that hardly depends on m: a point is a segment without a length, and whole groups of points are found inside
    or outside of the box at once.

    Parameters
    ----------
    points
        The points, shape (m, d) with m >= 1.

    Raises
    ------
    ValueError
        If they are not finite numbers in such an array.
    """

    def __init__(self, points: npt.ArrayLike) -> None:
        super().__init__(points, points)
