"""What the localizer's arithmetic in cells may be wrong by, and up to which sizes that is proved.

Positions are divided by the width of a cell and counted from a corner of a table; from there on all is compared with whole numbers. These
*cells* are those of a table: cells of the map, or the equal parts into which they are split for a fine precision. Everything else that is
rounded takes a part of its own size, as `ial.contractors.margins` has it.
"""

from ial.contractors.margins import UNIT
from ial.maps.grids.occupancy_grid import LARGEST_RESOLUTION, LARGEST_SIDE

MOST_CELLS = 2**22
"""Cells along a side of a whole map; `Sections` refuses more."""

NEAR = LARGEST_SIDE + 2.0
"""Cells from the corner of a table within which a robot may be; a table has at most `LARGEST_SIDE` cells a side."""

REACH = 2.0 * NEAR
"""Cells from the robot beyond which an end point is drawn in: from everywhere near it is outside the table either way."""

MARGIN = 2.0**-28
"""Cells by which every bound of an end point or a ray, relative to the robot, is widened. At 5 cm that is 0.2 nanometres.

It covers what comes before and after it, with u = 2⁻⁵³, N = `MOST_CELLS` and coordinates below 8·2¹⁶ in a table:

- the position of the robot: the width of a cell may itself be rounded, and so is the quotient by it: 2u·N;
- a cell of the lattice (`Lattice.part_m`): the same once more, for the ratio of the two widths: 2u·N;
- going back from a cell to a position in metres: the origin of the table added, and a product: 2u·N;
- the end point: its errors or, for any heading, its radius: four roundings; the error of the map, a quotient by the width of a cell, the
  margin, the origin of the table, `rectangle_indices.OFFSET`, the position and the drift of the lattice; or a strip along rays: of its
  start two quotients and sums, a slope times a difference, and three sums: at most 12 roundings of coordinates, each off by less than
  u·8·2¹⁶.
"""

assert 6.0 * UNIT * MOST_CELLS + 12.0 * UNIT * 8.0 * LARGEST_SIDE < MARGIN

ANYWHERE_M = 2.0**40
"""Metres: what may be off by so much may be anywhere in any map. No side is longer than `MOST_CELLS` cells of at most 1 km."""

assert MOST_CELLS * LARGEST_RESOLUTION < 0.01 * ANYWHERE_M

MOST_PARTS = 128
"""Cells of a table along an axis of a cell of the lattice; `divide` refuses more. Each thread counts in 4 KB times their square."""

MOST_BEAMS = 2**13
"""Beams that are used, and as many rays without return: numbers of bad ones are kept in 16 bits. The configuration refuses more."""

FITTING = 1.0 + 2.0**-20
"""By so much a width may exceed another one that it shall not exceed: it is no bound, but says which cells and boxes are taken for equal.

A map's width of a cell has often been a float32, wrong by 2⁻²⁴ of it; what the bounds of 2¹³ layers round off is 2⁻³⁹ of their width.
"""
