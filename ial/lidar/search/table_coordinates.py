"""Where boxes of positions lie in a table of the map: their bounds in cells from its corner."""

from ial.contractors.kernels import kernel
from ial.lidar.margins import NEAR


@kernel
def in_cells(xl, yl, xu, yu, resolution, origin):  # type: ignore[no-untyped-def]
    """Return (left, below, right, above), a box's bounds in cells from the corner of a table, and whether it lies near the table.

    Of a box that does not, indices would be wrong, and nothing is known.

    These bounds are rounded to nearest, not outward. With u = 2⁻⁵³ and N = `margins.MOST_CELLS`, those of a box that is near are off by
    less than 2u·N + 4u·NEAR:

    - `resolution` is the width of a cell of the map, or a part of it, which is rounded; and so is the quotient: each by u of it. The
      corner of a table lies at most N cells from that of the map, and a bound at most `NEAR` from there: 2u·(N + NEAR), and less than
      u·NEAR of higher order.
    - The origin is a whole number; a difference that is at most `NEAR` is off by u·NEAR.

    `margins.MARGIN`, by which every bound of an end point or a ray is widened, counts 2u·N for the position, and two of its roundings of
    coordinates, u·8·2¹⁶ each, for the rest. So whatever is added to these bounds has to include it.

    Parameters
    ----------
    xl, yl, xu, yu
        The box, in metres, in the grid's frame; it may be unbounded, but not empty.
    resolution
        The width of a cell of the table.
    origin
        Row and column of the table's first cell in the grid.
    """
    left, right = xl / resolution - origin[1], xu / resolution - origin[1]
    below, above = yl / resolution - origin[0], yu / resolution - origin[0]
    return left, below, right, above, min(left, below) >= -NEAR and max(right, above) <= NEAR
