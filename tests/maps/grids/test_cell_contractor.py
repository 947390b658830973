"""Both sides of a set of cells, against a twin with exact fractions. The side of the cells is also tested with the cell index."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ial.contractors import Boxes, Separator
from ial.maps import OCCUPIED, CellContractor, CellIndex, OccupancyGrid

INF = math.inf
MASK = np.array([[0, 1, 1], [0, 1, 1]], np.bool_)

Side = tuple[float, float]


def exact_outside(mask: np.ndarray, resolution: float, box: tuple[Side, Side]) -> list[tuple[Fraction, Fraction]] | None:
    """Return the exact hull of the part of a bounded box outside of the cells, or on their border; None if there is none."""
    r = Fraction(resolution)
    rows, columns = mask.shape
    far = Fraction(10**6)
    everywhere, below, above = (-far, far), (-far, Fraction(0)), ((columns * r, far), (rows * r, far))
    pieces = [(below, everywhere), (everywhere, below), (above[0], everywhere), (everywhere, above[1])]
    pieces += [((c * r, (c + 1) * r), (w * r, (w + 1) * r)) for w, c in np.argwhere(~mask).tolist()]
    parts = [
        [(max(Fraction(low), first), min(Fraction(high), last)) for (low, high), (first, last) in zip(box, piece, strict=True)]
        for piece in pieces
    ]
    parts = [part for part in parts if all(low <= high for low, high in part)]
    return [(min(low for low, _ in axis), max(high for _, high in axis)) for axis in zip(*parts, strict=True)] if parts else None


@st.composite
def scenes(draw: st.DrawFn) -> tuple[np.ndarray, float, tuple[Side, Side]]:
    rows, columns = draw(st.integers(1, 4)), draw(st.integers(1, 5))
    mask = np.array(draw(st.lists(st.booleans(), min_size=rows * columns, max_size=rows * columns))).reshape(rows, columns)
    resolution = draw(st.sampled_from([0.05, 0.1, 1 / 3, 0.5]))
    edge = st.integers(-1, 6).map(lambda i: i * resolution)
    bound = st.one_of(edge, edge.map(lambda x: math.nextafter(x, -INF)), edge.map(lambda x: math.nextafter(x, INF)), st.floats(-0.5, 2.5))
    x, y = (sorted((draw(bound), draw(bound))) for _ in range(2))
    return mask, resolution, ((x[0], x[1]), (y[0], y[1]))


@pytest.mark.slow
@settings(max_examples=500)
@given(scenes())
def test_the_outside_is_the_exact_hull_rounded_outward_once(scene: tuple[np.ndarray, float, tuple[Side, Side]]) -> None:
    mask, resolution, box = scene
    narrowed = (~CellContractor(CellIndex(mask, resolution))).contract(Boxes.of(box))
    exact = exact_outside(mask, resolution, box)
    if exact is None:
        assert narrowed.empty[0]
        return
    for lower, upper, (low, high), (first, last) in zip(narrowed.lower[0].tolist(), narrowed.upper[0].tolist(), exact, box, strict=True):
        assert first <= lower <= low < math.nextafter(lower, INF)
        assert math.nextafter(upper, -INF) < high <= upper <= last


def test_boxes_inside_outside_and_across() -> None:
    separator = Separator.of(CellContractor(CellIndex(MASK, 1.0)))
    boxes = Boxes.of(
        [(1.5, 2.5), (0.5, 1.5)],
        [(0.25, 0.75), (0.5, 1.5)],
        [(0.5, 2.5), (0.5, 1.5)],
        [(-INF, INF), (-INF, INF)],
        [(2.5, 9), (0.5, 1)],
        [(1, 2), (0.5, 1)],
        [(INF, -INF), (INF, -INF)],
        [(4, 5), (0, 1)],
    )
    inner, outer = separator.separate(boxes)
    assert outer.lower.tolist() == [[1.5, 0.5], [INF, INF], [1, 0.5], [1, 0], [2.5, 0.5], [1, 0.5], [INF, INF], [INF, INF]]
    assert outer.upper.tolist() == [[2.5, 1.5], [-INF, -INF], [2.5, 1.5], [3, 2], [3, 1], [2, 1], [-INF, -INF], [-INF, -INF]]
    assert inner.lower.tolist() == [[INF, INF], [0.25, 0.5], [0.5, 0.5], [-INF, -INF], [3, 0.5], [1, 0.5], [INF, INF], [4, 0]]
    assert inner.upper.tolist() == [[-INF, -INF], [0.75, 1.5], [1, 1.5], [INF, INF], [9, 1], [1, 1], [-INF, -INF], [5, 1]]


def test_the_complement_of_the_complement_is_the_set() -> None:
    contractor = CellContractor(CellIndex(MASK, 0.1))
    box = Boxes.of([(0.05, 0.15), (0.0, 1.0)])
    assert ((~~contractor).contract(box).lower == contractor.contract(box).lower).all()


def test_the_walls_of_a_map() -> None:
    grid = OccupancyGrid(np.array([[0, 1], [2, 0]], np.uint8), 0.5)
    walls = Separator.of(CellContractor(CellIndex(grid.mask(OCCUPIED), grid.resolution)))
    inner, outer = walls.separate(Boxes.of([(0.6, 0.9), (0.1, 0.4)], [(0.1, 0.4), (0.6, 0.9)]))
    assert inner.empty.tolist() == [True, False]
    assert outer.empty.tolist() == [False, True]


def test_boxes_of_another_dimension_are_refused() -> None:
    contractor = CellContractor(CellIndex(MASK, 0.1))
    for each in (contractor, ~contractor):
        with pytest.raises(ValueError, match="3 dimensions"):
            each.contract(Boxes.none(3))


def test_a_part_of_a_grid_is_refused() -> None:
    with pytest.raises(ValueError, match="part of a grid"):
        CellContractor(CellIndex(MASK, 0.1, origin=(0, 3)))


@pytest.mark.parametrize("resolution", [0.1, 1.0 / 3.0, 0.07])
def test_beyond_a_full_grid_the_outside_begins_at_its_exact_edge(resolution: float) -> None:
    for columns in range(1, 40):
        outside = ~CellContractor(CellIndex(np.ones((3, columns), dtype=np.bool_), resolution))
        edge = columns * Fraction(resolution)
        middle = (1.5 * resolution, 1.5 * resolution)
        narrowed = outside.contract(Boxes.of([(0.5 * resolution, 99.0), middle]))
        assert edge - Fraction(math.ulp(99.0)) <= Fraction(float(narrowed.lower[0, 0])) <= edge
        narrowed = outside.contract(Boxes.of([(-1.0, 0.5 * resolution), middle]))
        assert (narrowed.lower[0, 0], narrowed.upper[0, 0]) == (-1.0, 0.0)


@pytest.mark.parametrize("compact", [False, True])
def test_the_outside_of_a_compact_set_loses_no_hole(compact: bool) -> None:
    """The counts of a compact set begin again at 2¹⁶, between the corners of this box; what is left is the hole in the full grid."""
    mask = np.ones((300, 300), dtype=np.bool_)
    mask[257, 257] = False
    outside = ~CellContractor(CellIndex(mask, 1.0, compact=compact))
    left = outside.contract(Boxes.of([(255.25, 259.75), (255.25, 259.75)]))
    assert (left.lower.tolist(), left.upper.tolist()) == ([[257.0, 257.0]], [[258.0, 258.0]])
