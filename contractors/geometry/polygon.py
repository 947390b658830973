"""Polygons: the contractor `Polygon` of a region with straight edges, and that of its complement."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import FloatArray
from ial.contractors.geometry.box_tree import following
from ial.contractors.geometry.orientation import orientation
from ial.contractors.geometry.segment import Segments, checked_points, contract_segments, widen
from ial.contractors.kernels import kernel
from ial.contractors.row_contractor import RowContractor
from ial.contractors.threads import run

INSIDE, OUTSIDE = 1, -1
_UNDECIDED = 0


@kernel
def _side(x, y, tree_lower, tree_upper, starts, ends):  # type: ignore[no-untyped-def]
    """Return INSIDE or OUTSIDE for a point off the edges; for one on an edge, either of these or _UNDECIDED.

    The edges that a ray to the right crosses are counted. Of the two end points of an edge, the lower one belongs to it here.
    """
    leaves = len(tree_lower) >> 1
    side = OUTSIDE
    node = 1
    while True:
        descend = False
        if tree_lower[node, 1] <= y < tree_upper[node, 1] and x <= tree_upper[node, 0]:
            if node < leaves:
                descend = True
            elif x < tree_lower[node, 0]:
                side = -side
            else:
                i = node - leaves
                turn = orientation(starts[i, 0], starts[i, 1], ends[i, 0], ends[i, 1], x, y)
                if turn == 0.0:
                    return _UNDECIDED
                if (turn > 0.0) == (ends[i, 1] > starts[i, 1]):
                    side = -side
        node = 2 * node if descend else following(node)
        if node == 1:
            return side


@kernel
def _contract_rows(start, stop, wanted, tree_lower, tree_upper, starts, ends, lower, upper):  # type: ignore[no-untyped-def]
    """Narrow rows in place to the hull of their part on the wanted side.

    A bound of that part is reached on an edge, or on a side of the box. Along such a side one comes to an edge or to a corner of the box.
    So the part on the edges and the corners on the wanted side have the same hull.
    """
    low, high = np.empty(2), np.empty(2)
    part_low, part_high = np.empty(2), np.empty(2)
    for i in range(start, stop):
        low[:] = lower[i]
        high[:] = upper[i]
        new_low, new_high = lower[i], upper[i]
        contract_segments(low, high, tree_lower, tree_upper, starts, ends, new_low, new_high, part_low, part_high)
        if not (low[0] <= high[0] and low[1] <= high[1]):
            continue
        uniform = new_low[0] > new_high[0]  # no edge: all of the box is on one side
        for corner in range(4):
            x = high[0] if corner & 1 else low[0]
            y = high[1] if corner & 2 else low[1]
            if not (new_low[0] <= x <= new_high[0] and new_low[1] <= y <= new_high[1]):
                side = _side(x, y, tree_lower, tree_upper, starts, ends) if abs(x) < np.inf and abs(y) < np.inf else OUTSIDE
                if side != -wanted:
                    part_low[0], part_low[1] = x, y
                    widen(new_low, new_high, low if uniform else part_low, high if uniform else part_low)
            if uniform:
                break


class _Side(RowContractor):
    """The closed region on one side of the edges of a polygon.

    Parameters
    ----------
    edges
        All edges.
    side
        INSIDE or OUTSIDE.
    """

    dimension = 2

    def __init__(self, edges: Segments, side: int) -> None:
        self.edges = edges
        self._wanted = side

    def __repr__(self) -> str:
        return f"<{type(self).__name__} with {len(self.edges.starts)} edges>"

    def complement(self) -> "_Side":
        """Return the contractor of the points on the other side, or on an edge."""
        return _Side(self.edges, -self._wanted)

    def _narrow_rows(self, lower: FloatArray, upper: FloatArray) -> None:
        edges, tree = self.edges, self.edges.tree
        run(_contract_rows, len(lower), self._wanted, tree.lower, tree.upper, edges.starts, edges.ends, lower, upper)


class Polygon(_Side):
    """The contractor of "(x, y) lies in a polygon": its interior, its edges, and the edges of its holes, but not the holes.

    Boxes shrink to the hull of their part in the polygon, which is the smallest but for the rounding on slanting edges; a box that meets no
    edge is kept or emptied as a whole, by an exact decision. ``~polygon`` is the contractor of what lies outside or in a hole, edges
    included, and ``Separator.of(polygon)`` is both.

    Parameters
    ----------
    vertices
        The corners in order, in either direction, shape (k, 2) with k >= 3; the first one may be repeated at the end.
    holes
        The corners of each hole, in the same form.

    Attributes
    ----------
    edges
        The contractor of the edges, holes included.

    Raises
    ------
    ValueError
        If there are too few corners, a coordinate is not finite, edges cross, or a hole lies outside.
    """

    def __init__(self, vertices: npt.ArrayLike, holes: Sequence[npt.ArrayLike] = ()) -> None:
        import shapely  # type: ignore[import-untyped]

        rings = [_checked_ring(vertices, "polygon")]
        rings += [_checked_ring(hole, f"hole {number} of the polygon") for number, hole in enumerate(holes)]
        super().__init__(_edges_of(shapely.Polygon(rings[0], rings[1:])), INSIDE)

    @classmethod
    def from_shapely(cls, geometry: Any) -> "Polygon":
        """Return the contractor of a polygon or of several that do not overlap, as shapely holds them. Heights (z) are left out.

        Parameters
        ----------
        geometry
            A ``shapely.Polygon`` or ``shapely.MultiPolygon``.

        Raises
        ------
        ValueError
            If it is another geometry (a line is open and has no inside), is empty, or is not valid.
        """
        polygon = cls.__new__(cls)
        _Side.__init__(polygon, _edges_of(geometry), INSIDE)
        return polygon


def _checked_ring(vertices: npt.ArrayLike, name: str) -> npt.NDArray[np.float64]:
    ring = checked_points(vertices, f"vertices of the {name}")
    if ring.shape[1] != 2:
        raise ValueError(f"the vertices of the {name} have {ring.shape[1]} coordinates each; give 2: x, y")
    different = len(np.unique(ring, axis=0))
    if different < 3:
        raise ValueError(f"the {name} has {different} different vertices; give at least 3")
    return ring


def _edges_of(geometry: Any) -> Segments:
    """Return the edges of all rings of a polygon or several."""
    import shapely

    if not isinstance(geometry, shapely.Polygon | shapely.MultiPolygon):
        kind = getattr(geometry, "geom_type", type(geometry).__name__)
        raise ValueError(f"the geometry is a {kind}, which has no inside; give a shapely Polygon or MultiPolygon")
    if geometry.is_empty:
        raise ValueError("the polygon is empty; give one with an inside")
    if not geometry.is_valid:
        raise ValueError(
            f"the polygon is not valid: {shapely.is_valid_reason(geometry)} (the place is in brackets); "
            "its edges must not cross or overlap, and holes must lie inside and apart from each other"
        )
    rings = [shapely.get_coordinates(ring) for part in shapely.get_parts(geometry) for ring in (part.exterior, *part.interiors)]
    return Segments(np.concatenate([ring[:-1] for ring in rings]), np.concatenate([ring[1:] for ring in rings]))
