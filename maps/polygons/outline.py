"""`outlines`: the polygons whose union is exactly the free cells of a grid, by following the cracks between free and other cells.

Corners are corners of cells, so nothing is shifted by half a cell as with contours through the centres of pixels. Free cells that meet in
a corner only are apart (4-connected), other cells that meet in a corner hang together (8-connected).
"""

from collections.abc import Iterator
from fractions import Fraction

import numpy as np
import numpy.typing as npt
from scipy import ndimage

from ial.contractors.kernels import kernel
from ial.errors import MapError
from ial.maps.polygons.polygon import ExactPoint, ExactRing, Polygon
from ial.maps.polygons.ring import Point, doubled_area

MaskArray = npt.NDArray[np.bool_]

_ORIGIN = (Fraction(0), Fraction(0))


@kernel
def _start_cracks(free, cracks):  # type: ignore[no-untyped-def]
    """Mark the cracks by their first corner and direction (0 right, 1 up, 2 left, 3 down), the free cell to the left; count them."""
    rows, columns = free.shape
    count = 0
    for row in range(rows):
        for column in range(columns):
            if not free[row, column]:
                continue
            below, right = row == 0 or not free[row - 1, column], column == columns - 1 or not free[row, column + 1]
            above, left = row == rows - 1 or not free[row + 1, column], column == 0 or not free[row, column - 1]
            cracks[row, column, 0] = below
            cracks[row, column + 1, 1] = right
            cracks[row + 1, column + 1, 2] = above
            cracks[row + 1, column, 3] = left
            count += below + right + above + left
    return count


@kernel
def _follow(cracks, corners, starts):  # type: ignore[no-untyped-def]
    """Follow all cracks, each once; write the corners where a ring turns, and where each ring starts; return the number of rings."""
    rings = written = 0
    for first_row in range(cracks.shape[0]):
        for first_column in range(cracks.shape[1]):
            # Every ring begins at the left end of its lowest edge that runs to the right, with a free cell above: never within an edge.
            if not cracks[first_row, first_column, 0]:
                continue
            starts[rings] = written
            rings += 1
            row, column, direction, last = first_row, first_column, 0, -1
            closed = False
            while not closed:
                cracks[row, column, direction] = False
                if direction != last:
                    corners[written, 0], corners[written, 1] = column, row
                    written += 1
                last = direction
                column += (direction == 0) - (direction == 2)
                row += (direction == 1) - (direction == 3)
                # The left turn comes first: it stays with the free cell, and so keeps free cells apart that meet in a corner.
                for turn in (1, 0, 3):
                    direction = (last + turn) % 4
                    closed = row == first_row and column == first_column and direction == 0
                    if closed or cracks[row, column, direction]:
                        break
    starts[rings] = written
    return rings


def outlines(free: MaskArray, cell: Fraction = Fraction(1), corner: ExactPoint = _ORIGIN) -> tuple[Polygon, ...]:
    """Return the free cells of a grid as polygons, one for each 4-connected part, in the order of their lowest rows.

    Parameters
    ----------
    free
        bool of shape (rows, columns), row 0 at the bottom.
    cell
        The width of a cell.
    corner
        Where the lower left corner of the grid lies.

    Returns
    -------
    tuple
        Corners are multiples of the width of a cell from there. Rings that would pass a corner twice are split there, so that rings touch.

    Raises
    ------
    MapError
        If no cell is free.
    """
    if not free.any():
        raise MapError("no cell of the grid is free, so there is no outline; check the map")
    cracks = np.zeros((free.shape[0] + 1, free.shape[1] + 1, 4), dtype=np.bool_)
    count = _start_cracks(np.ascontiguousarray(free), cracks)
    corners, starts = np.empty((count, 2), dtype=np.int64), np.empty(count + 1, dtype=np.int64)
    rings = _follow(cracks, corners, starts)
    parts, number = ndimage.label(free)
    outer: dict[int, ExactRing] = {}
    holes: dict[int, list[ExactRing]] = {part: [] for part in range(1, number + 1)}
    for at in range(rings):
        ring: list[Point] = [(int(x), int(y)) for x, y in corners[starts[at] : starts[at + 1]]]
        part = int(parts[ring[0][1], ring[0][0]])  # its first edge runs to the right, below a free cell
        for simple in _split(ring):
            exact = tuple((corner[0] + x * cell, corner[1] + y * cell) for x, y in simple)
            if doubled_area(simple) > 0:
                outer[part] = exact
            else:
                holes[part].append(exact)
    return tuple(Polygon.trusted(outer[part], tuple(holes[part])) for part in range(1, number + 1))


def _split(ring: list[Point]) -> Iterator[list[Point]]:
    """Yield the rings without repeated corners that a ring consists of."""
    path: list[Point] = []
    place: dict[Point, int] = {}
    for point in ring:
        if point in place:
            loop = path[place[point] :]
            for passed in loop:
                del place[passed]
            del path[-len(loop) :]
            yield loop
        place[point] = len(path)
        path.append(point)
    yield path
