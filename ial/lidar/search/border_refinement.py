"""How far an answer really reaches: its outer cells are cut back to the pieces of them that may hold a consistent pose.

A search ends with cells of one size. Where few of them are left, their outer faces, those without a neighbour, can be refined:
the cell is halved along every axis, again and again, and each outer face is moved to the outermost piece that may hold a consistent pose.
A cell without such a piece is dropped. Faces between two cells stay where they are, so that what belongs together stays connected.
"""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.groups import group_rows
from ial.contractors.kernels import kernel
from ial.contractors.paving.clusters import Clusters, cluster
from ial.contractors.threads import run
from ial.lidar.evidence.beams import Beams
from ial.lidar.evidence.end_points import relative_bounds
from ial.lidar.search.flat_table import FlatTable, flat_table
from ial.lidar.search.lattice import Lattice
from ial.lidar.search.map_tables import Sections
from ial.lidar.search.outer_faces import outer_faces
from ial.lidar.search.scan_contractor import fits
from ial.lidar.search.table_coordinates import in_cells
from ial.maps.grids.cell_index import meets
from ial.maps.grids.cell_table import CellTable


class _Layers(NamedTuple):
    """Which cells belong to each layer of headings: order[edges[i]] … order[edges[i + 1] - 1]."""

    order: npt.NDArray[np.intp]
    edges: npt.NDArray[np.intp]


class _Cells(NamedTuple):
    """Cells, which of their faces may be moved, bool of shape (n, 2, 3), and which cells are to be cut."""

    lower: FloatArray
    upper: FloatArray
    outer: npt.NDArray[np.bool_]
    wanted: npt.NDArray[np.bool_]


class _Refined(NamedTuple):
    """What is left of the cells, and of which anything is."""

    lower: FloatArray
    upper: FloatArray
    kept: npt.NDArray[np.bool_]


class _Tables(NamedTuple):
    """The tables of a section: the cells that beams may end at, the same as one line, and those in which the robot may be."""

    occupied: CellTable
    flat: FlatTable
    domain: CellTable


class _Tree(NamedTuple):
    """The halves of a cell's headings, halved `depth` times: for each node whether the beams' relative bounds are known, and these."""

    depth: int
    known: npt.NDArray[np.bool_]
    bounds: FloatArray


@kernel
def _interval(lower, upper, depth, number):  # type: ignore[no-untyped-def]
    """Return one of the 2**depth pieces of an interval, which is halved again and again."""
    for level in range(depth):
        middle = lower + 0.5 * (upper - lower)
        if (number >> (depth - 1 - level)) & 1:
            lower = middle
        else:
            upper = middle
    return lower, upper


@kernel
def _reach(cell, outer, evidence, tables, tree, failing, stack, reached):  # type: ignore[no-untyped-def]
    """Write how far the pieces of a cell that may hold a consistent pose reach; return whether there are any.

    Pieces are looked at from the outer faces inward, and none that would not reach farther than those found before.

    Parameters
    ----------
    cell
        Lower and upper bounds, float64 of shape (2, 3).
    outer
        Which faces may be moved: lower and upper along each axis, bool of shape (2, 3).
    evidence
        The `Evidence` of the scan.
    tables
        The `_Tables` of a section.
    tree
        The `_Tree` of the cell's headings.
    failing
        An order of the beams; see `fits`.
    stack
        Working space.
    reached
        Where to write the bounds. Those at other faces are those of the cell.
    """
    resolution, origin = tables.occupied.resolution, tables.occupied.origin
    depth, known, bounds = tree
    first = 0
    for axis in range(3):
        reached[0, axis] = np.inf if outer[0, axis] else cell[0, axis]
        reached[1, axis] = -np.inf if outer[1, axis] else cell[1, axis]
        first |= (outer[1, axis] and not outer[0, axis]) << axis  # the half along each axis that lies at an outer face
    met = False
    stack[0, :] = 0
    height = 1
    while height:
        height -= 1
        level, nx, ny, nt = stack[height]
        xl, xu = _interval(cell[0, 0], cell[1, 0], level, nx)
        yl, yu = _interval(cell[0, 1], cell[1, 1], level, ny)
        tl, tu = _interval(cell[0, 2], cell[1, 2], level, nt)
        if level:
            if (
                reached[0, 0] <= xl
                and xu <= reached[1, 0]
                and reached[0, 1] <= yl
                and yu <= reached[1, 1]
                and reached[0, 2] <= tl
                and tu <= reached[1, 2]
            ):
                continue
            if not meets(tables.domain, xl, xu, yl, yu):
                continue
            node = (1 << level) + nt
            if not known[node]:
                relative_bounds(tl, tu, evidence, resolution, bounds[node])
                known[node] = True
            left, below, right, above, near = in_cells(xl, yl, xu, yu, resolution, origin)
            if near and not fits(tables.flat, bounds[node], evidence.outliers, failing, left, below, right, above):
                continue
        if level == depth:
            met = True
            for axis in range(3):
                low, high = (xl, xu) if axis == 0 else (yl, yu) if axis == 1 else (tl, tu)
                if outer[0, axis]:
                    reached[0, axis] = min(reached[0, axis], low)
                if outer[1, axis]:
                    reached[1, axis] = max(reached[1, axis], high)
            continue
        for number in range(8):  # the last one put on the stack is the next
            child = (7 - number) ^ first
            stack[height, 0] = level + 1
            stack[height, 1] = 2 * nx + (child & 1)
            stack[height, 2] = 2 * ny + ((child >> 1) & 1)
            stack[height, 3] = 2 * nt + (child >> 2)
            height += 1
    return met


@kernel
def _refine(start, stop, layers, cells, evidence, occupied, domain, trees, refined):  # type: ignore[no-untyped-def]
    """Cut the wanted cells of layers start … stop - 1, and write which of them hold a piece.

    Parameters
    ----------
    layers
        `_Layers`.
    cells
        `_Cells`.
    evidence
        The `Evidence` of the scan.
    occupied, domain
        The cells that beams may end at, and those in which the robot may be: a `CellTable` each.
    trees
        The `_Tree` of each layer, from one call to the next; arrays have one more axis, the first.
    refined
        `_Refined`.
    """
    tables = _Tables(occupied, flat_table(occupied.bordered), domain)
    failing = np.arange(len(evidence.ends))
    stack = np.empty((8 * (trees.depth + 1), 4), dtype=np.int64)
    cell, reached = np.empty((2, 3)), np.empty((2, 3))
    for layer in range(start, stop):
        for at in range(layers.edges[layer], layers.edges[layer + 1]):
            row = layers.order[at]
            if cells.wanted[row]:
                for axis in range(3):
                    cell[0, axis], cell[1, axis] = cells.lower[row, axis], cells.upper[row, axis]
                tree = _Tree(trees.depth, trees.known[layer], trees.bounds[layer])
                refined.kept[row] = _reach(cell, cells.outer[row], evidence, tables, tree, failing, stack, reached)
                for axis in range(3):
                    refined.lower[row, axis], refined.upper[row, axis] = reached[0, axis], reached[1, axis]


def refine_border(cells: Boxes, lattice: Lattice, sections: Sections, beams: Beams, depth: int) -> tuple[Boxes, npt.NDArray[np.bool_]]:
    """Return cells whose outer faces are moved to the outermost pieces that may hold a consistent pose, and which of them are left.

    A cell without such a piece is dropped, and the faces of its neighbours behind it are moved, too.

    Parameters
    ----------
    cells
        Different cells of the finest level of the lattice.
    lattice
        The lattice.
    sections
        The tables of the map.
    beams
        The evidence of the scan, and how many of its beams may be bad.
    depth
        How often cells are halved along each axis.
    """
    lower, upper, kept = cells.lower.copy(), cells.upper.copy(), np.ones(len(cells), dtype=np.bool_)
    order = group_rows(lower[:, 2], upper[:, 2])
    edges = np.flatnonzero(np.concatenate([[True], np.diff(lower[order, 2]) != 0.0, [True]]))
    known = np.zeros((len(edges) - 1, 2 << depth), dtype=np.bool_)
    trees = _Tree(depth, known, np.empty((*known.shape, len(beams.ends), 4)))
    layers, refined = _Layers(order, edges), _Refined(lower, upper, kept)
    places = [(key, rows) for key, rows, _ in sections.parts(cells)]
    outer = outer_faces(cells, lattice)
    uncovered = np.asarray(outer.any(axis=(1, 2)))
    while uncovered.any():
        before = np.count_nonzero(kept)
        for key, rows in places:
            wanted = np.zeros(len(cells), dtype=np.bool_)
            wanted[rows] = uncovered[rows]
            of_map = sections[key].occupied.cells, sections[key].domain.cells
            of_cells = _Cells(cells.lower, cells.upper, outer, wanted)
            run(_refine, len(edges) - 1, layers, of_cells, beams.evidence, *of_map, trees, refined, minimum=4)
        if np.count_nonzero(kept) in (0, before):
            break
        faces = outer.copy()
        faces[kept] = outer_faces(cells[kept], lattice)
        uncovered = (faces != outer).any(axis=(1, 2))
        outer = faces
    return Boxes(lower, upper), kept


def mend(cells: Boxes, lattice: Lattice, refined: Boxes, kept: npt.NDArray[np.bool_], parts: Clusters) -> npt.NDArray[np.bool_]:
    """Give hypotheses that `refine_border` has torn apart their cells back, as far as these lie in the hull of what was found in them.

    Parameters
    ----------
    cells, lattice
        As they were given to `refine_border`.
    refined, kept
        What it has returned; the boxes of hypotheses that have fallen apart are replaced.
    parts
        The clusters of the kept boxes.

    Returns
    -------
    kept
        Which boxes are left then; the very same mask where nothing is torn.
    """
    if len(parts) < 2:
        return kept
    whole = cluster(cells, circular=(2,))
    labels = whole.labels
    torn = np.flatnonzero(np.bincount(np.unique(np.stack([labels[kept], parts.labels]), axis=1)[0]) > 1)
    if not len(torn):
        return kept
    lower, upper, kept = refined.lower, refined.upper, kept.copy()
    turns = (lattice.layer(cells) - lattice.layer(whole.hulls)[labels]) % lattice.layers
    for label in torn:
        own = kept & (labels == label)
        low, high = lower[own].min(axis=0), upper[own].max(axis=0)
        first, last = turns[own].min(), turns[own].max()
        low[2], high[2] = lower[own & (turns == first), 2].min(), upper[own & (turns == last), 2].max()
        rows = np.flatnonzero((labels == label) & (first <= turns) & (turns <= last))
        lowest, highest = np.tile(low, (len(rows), 1)), np.tile(high, (len(rows), 1))
        lowest[turns[rows] != first, 2], highest[turns[rows] != last, 2] = -np.inf, np.inf
        lower[rows], upper[rows] = np.maximum(cells.lower[rows], lowest), np.minimum(cells.upper[rows], highest)
        kept[rows] = (lower[rows] < upper[rows]).all(axis=1)
    return kept
