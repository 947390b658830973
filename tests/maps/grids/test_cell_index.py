"""The cell index: every answer against a twin that loops over all cells with exact fractions."""

import itertools
import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ial.contractors import threads
from ial.contractors.boxes import Boxes
from ial.contractors.margins import ROUNDINGS
from ial.errors import MapError
from ial.maps.grids.cell_contractor import CellContractor
from ial.maps.grids.cell_index import CellIndex, count, meets
from ial.maps.grids.occupancy_grid import OCCUPIED, OccupancyGrid
from tests.cases import cases

RESOLUTIONS = (0.05, 0.1, 0.03, 0.02, float(np.float32(0.05)), 1 / 3, 0.5)

Box = tuple[float, float, float, float]


def exact_hull(mask: np.ndarray, resolution: float, box: Box, slack: Fraction = Fraction(0)) -> tuple[Fraction, ...] | None:
    """Return the hull of the box and the closed cells, widened by a slack in metres, or None if they do not meet."""
    xl, xu, yl, yu = (Fraction(each) for each in box)
    r = Fraction(resolution)
    hulls = []
    for row, column in np.argwhere(mask).tolist():
        left, right = max(xl, column * r - slack), min(xu, (column + 1) * r + slack)
        below, above = max(yl, row * r - slack), min(yu, (row + 1) * r + slack)
        if left <= right and below <= above:
            hulls.append((left, right, below, above))
    if not hulls:
        return None
    lefts, rights, belows, aboves = zip(*hulls, strict=True)
    return min(lefts), max(rights), min(belows), max(aboves)


@st.composite
def scenes(draw: st.DrawFn) -> tuple[np.ndarray, float, Box]:
    """Draw cells, a resolution, and a box whose bounds are often edges of cells, or a bit step beside them."""
    rows, columns = draw(st.integers(1, 6)), draw(st.integers(1, 6))
    bits = draw(st.integers(0, 2 ** (rows * columns) - 1))
    mask = np.array([bits >> i & 1 for i in range(rows * columns)], dtype=np.bool_).reshape(rows, columns)
    resolution = draw(st.sampled_from(RESOLUTIONS))
    edge = st.integers(-1, 7).map(lambda i: i * resolution)
    bound = (
        edge
        | edge.map(lambda x: math.nextafter(x, math.inf))
        | edge.map(lambda x: math.nextafter(x, -math.inf))
        | st.floats(-resolution, 8 * resolution)
        | st.floats(-1e300, 1e300)
    )
    x, y = (sorted(draw(st.tuples(bound, bound))) for _ in range(2))
    return mask, resolution, (x[0], x[1], y[0], y[1])


@pytest.mark.slow
@settings(max_examples=600)
@given(scenes())
def test_meets_is_never_wrongly_false_and_wrongly_true_only_within_the_slack(scene: tuple[np.ndarray, float, Box]) -> None:
    mask, resolution, box = scene
    index = CellIndex(mask, resolution)
    met = meets(index.cells, *box)
    if exact_hull(mask, resolution, box) is not None:
        assert met
    elif met:
        assert exact_hull(mask, resolution, box, slack=Fraction(9 * ROUNDINGS * resolution)) is not None


@pytest.mark.slow
@settings(max_examples=600)
@given(scenes())
def test_contraction_is_the_exact_hull_rounded_outward_once(scene: tuple[np.ndarray, float, Box]) -> None:
    mask, resolution, box = scene
    xl, xu, yl, yu = box
    narrowed = CellContractor(CellIndex(mask, resolution)).contract(Boxes.of([(xl, xu), (yl, yu)]))
    exact = exact_hull(mask, resolution, box)
    if exact is None:
        assert narrowed.empty[0]
        return
    bounds = narrowed.lower[0, 0], narrowed.upper[0, 0], narrowed.lower[0, 1], narrowed.upper[0, 1]
    for bound, best, outward in zip(bounds, exact, (-math.inf, math.inf) * 2, strict=True):
        inward = Fraction(math.nextafter(bound, -outward))
        assert inward < best <= bound if outward > 0 else bound <= best < inward
    assert xl <= bounds[0]
    assert bounds[1] <= xu
    assert yl <= bounds[2]
    assert bounds[3] <= yu


@pytest.mark.slow
@settings(max_examples=200)
@given(scenes())
def test_contracting_twice_changes_nothing(scene: tuple[np.ndarray, float, Box]) -> None:
    mask, resolution, (xl, xu, yl, yu) = scene
    contractor = CellContractor(CellIndex(mask, resolution))
    once = contractor.contract(Boxes.of([(xl, xu), (yl, yu)]))
    twice = contractor.contract(once)
    assert (once.lower == twice.lower).all()
    assert (once.upper == twice.upper).all()


@pytest.mark.parametrize("resolution", RESOLUTIONS)
@pytest.mark.parametrize("column", [0, 1, 3, 63, 1000, 65535])
def test_touching_an_edge_is_meeting(resolution: float, column: int) -> None:
    mask = np.zeros((1, 65536), np.bool_)
    mask[0, column] = True
    index = CellIndex(mask, resolution)
    left, right = Fraction(resolution) * column, Fraction(resolution) * (column + 1)
    inside_left, inside_right = float(left), float(right)
    if Fraction(inside_left) < left:
        inside_left = math.nextafter(inside_left, math.inf)
    if Fraction(inside_right) > right:
        inside_right = math.nextafter(inside_right, -math.inf)
    box = Boxes.of(
        [(-5.0, inside_left), (0.0, resolution)],
        [(inside_right, 1e6), (0.0, resolution)],
        [(inside_left, inside_left), (-1.0, 0.0)],
        [(inside_right, inside_right), (resolution, 1.0)],
        [(-5.0, inside_left - 1e-9), (0.0, resolution)],
        [(inside_right + 1e-9, 1e6), (0.0, resolution)],
    )
    assert index.meet(box).tolist() == [True] * 4 + [False] * 2
    assert (~CellContractor(index).contract(box).empty).tolist() == [True] * 4 + [False] * 2


@pytest.mark.parametrize("resolution", [*RESOLUTIONS, 0.0333])
@pytest.mark.parametrize(("split", "column"), [(1, 65_536), (5, 327_680), (64, 2**22)])
def test_touching_an_edge_far_from_the_corner_of_a_map_is_meeting(resolution: float, split: int, column: int) -> None:
    """Also where cells are parts of wider ones, so that their width is rounded."""
    random, width = np.random.default_rng(column), Fraction(resolution) / split
    index = CellIndex(np.ones((1, 10), np.bool_), resolution / split, origin=(0, column - 10), whole=(1, column))
    for _ in range(100):
        left, right = (column - 10) * width, column * width
        before, past = float(left), float(right)  # the doubles beside them that still lie in the cells
        before = before if Fraction(before) >= left else math.nextafter(before, math.inf)
        past = past if Fraction(past) <= right else math.nextafter(past, -math.inf)
        far = float(random.uniform(0.0, 3.0)) * resolution
        assert index.meet(Boxes.of([(before - far, before), (0.0, 0.0)], [(past, past + far), (0.0, 0.0)])).all()
        beside = float(3 * ROUNDINGS * column * width)
        assert not index.meet(Boxes.of([(before - far - beside, before - beside), (0.0, 0.0)], [(past + beside, 1e9), (0.0, 0.0)])).any()


def test_count_is_a_sum_over_the_cells() -> None:
    mask = np.random.default_rng(5).random((5, 7)) < 0.4
    table = CellIndex(mask, 0.1).cells.table
    assert table.shape == (6, 8)
    assert table.dtype == np.int32
    for row0, row1 in itertools.combinations_with_replacement(range(6), 2):
        for column0, column1 in itertools.combinations_with_replacement(range(8), 2):
            assert count(table, row0, row1, column0, column1) == mask[row0:row1, column0:column1].sum()


def test_a_compact_table_counts_modulo_two_to_the_sixteen() -> None:
    mask = np.random.default_rng(7).random((300, 400)) < 0.9  # many more cells than 16 bits hold
    mask[100:200, 50:300] = False
    full, compact = CellIndex(mask, 0.1), CellIndex(mask, 0.1, compact=True)
    assert compact.cells.bordered.nbytes == full.cells.bordered.nbytes // 2
    assert (compact.cells.bordered == full.cells.bordered.astype(np.uint16)).all()
    rng = np.random.default_rng(8)
    for _ in range(cases(3000, 200)):
        (row0, row1), (column0, column1) = np.sort(rng.integers(0, 301, 2)), np.sort(rng.integers(0, 401, 2))
        exact, modular = (count(each.cells.table, row0, row1, column0, column1) for each in (full, compact))
        if (row1 - row0) * (column1 - column0) < 2**16:
            assert modular == exact
        else:
            assert modular >= 1


@pytest.mark.many
def test_a_compact_index_never_misses_a_cell() -> None:
    rng = np.random.default_rng(9)
    mask = np.zeros((400, 500), np.bool_)
    mask[:, 490:] = True
    full, compact = CellIndex(mask, 0.1), CellIndex(mask, 0.1, compact=True)
    lower = rng.uniform(-1.0, 45.0, (4000, 2))
    boxes = Boxes(lower, lower + rng.uniform(0.0, 1.0, (4000, 1)) ** 3 * rng.uniform(0.0, 50.0, (4000, 2)))
    exact, met = full.meet(boxes), compact.meet(boxes)
    assert (met | ~exact).all()
    assert (met & ~exact).any()  # where 2¹⁶ cells or more were asked for
    small = (boxes.width() < 20.0).all(axis=1)
    assert (met[small] == exact[small]).all()
    narrowed = [CellContractor(each).contract(boxes) for each in (full, compact)]
    kept = ~narrowed[0].empty
    assert (narrowed[1].lower[kept] <= narrowed[0].lower[kept]).all()
    assert (narrowed[1].upper[kept] >= narrowed[0].upper[kept]).all()


def test_endless_empty_and_far_boxes() -> None:
    mask = np.zeros((3, 4), np.bool_)
    mask[1, 2] = True
    index = CellIndex(mask, 0.5)
    inf = math.inf
    boxes = Boxes(
        np.array([[-inf, -inf], [inf, inf], [1e308, 0], [-1e308, -1e308], [-inf, 0.75], [2.0, 0.0]]),
        np.array([[inf, inf], [-inf, -inf], [1.7e308, 9], [-1e300, 9], [inf, 0.75], [1.0, 1.0]]),
    )
    assert index.meet(boxes).tolist() == [True, False, False, False, True, False]
    narrowed = CellContractor(index).contract(boxes)
    assert narrowed.empty.tolist() == [False, True, True, True, False, True]
    assert (narrowed.lower[narrowed.empty] == inf).all()
    assert (narrowed.upper[narrowed.empty] == -inf).all()
    assert narrowed[[0, 4]].lower.tolist() == [[1.0, 0.5], [1.0, 0.75]]
    assert narrowed[[0, 4]].upper.tolist() == [[1.5, 1.0], [1.5, 0.75]]


@pytest.mark.many
def test_large_batches_are_the_same_on_any_number_of_threads() -> None:
    rng = np.random.default_rng(6)
    index = CellIndex(rng.random((200, 300)) < 0.02, 0.05)
    lower = rng.uniform(-1, 15, (5000, 2))
    boxes = Boxes(lower, lower + rng.uniform(0, 2, (5000, 2)))
    before = boxes.lower.copy(), boxes.upper.copy()
    results = []
    try:
        for number in (1, 2, 3):
            threads.set_threads(number)
            narrowed = CellContractor(index).contract(boxes)
            results.append((index.meet(boxes), narrowed.lower, narrowed.upper))
    finally:
        threads.set_threads(None)
    for result in results[1:]:
        assert all((a == b).all() for a, b in zip(result, results[0], strict=True))
    meet, new_lower, new_upper = results[0]
    assert 0 < meet.sum() < 5000
    assert (meet == ~Boxes(new_lower, new_upper).empty).all()
    assert (boxes.lower == before[0]).all()
    assert (boxes.upper == before[1]).all()


def test_no_occupied_point_of_a_large_box_is_lost() -> None:
    rng = np.random.default_rng(7)
    mask = rng.random((40, 50)) < 0.01
    contractor = CellContractor(CellIndex(mask, 0.05))
    row, column = np.argwhere(mask).T
    for _ in range(cases(200, 40)):
        lower = rng.uniform(-0.5, 2, 2)
        box = Boxes(lower[None], (lower + rng.uniform(0, 1.5, 2))[None])
        at = rng.integers(len(row))
        point = (column[at] + rng.random()) * 0.05, (row[at] + rng.random()) * 0.05
        if box.contain(point)[0]:
            assert contractor.contract(box).contain(point)[0]


def test_a_grid_gives_its_mask() -> None:
    grid = OccupancyGrid(np.array([[0, 1, 2]], np.uint8), 0.5)
    index = CellIndex(grid.mask(OCCUPIED), grid.resolution)
    assert index.cells.table.tolist() == [[0, 0, 0, 0], [0, 0, 1, 1]]


def test_bad_input_is_refused() -> None:
    with pytest.raises(MapError, match="uint8"):
        CellIndex(np.zeros((2, 2), np.uint8), 0.05)  # type: ignore[arg-type]
    with pytest.raises(MapError, match="shape"):
        CellIndex(np.zeros(2, np.bool_), 0.05)
    with pytest.raises(MapError, match="0 × 2"):
        CellIndex(np.zeros((2, 0), np.bool_), 0.05)
    with pytest.raises(MapError, match="resolution"):
        CellIndex(np.zeros((2, 2), np.bool_), math.nan)
    index = CellIndex(np.zeros((2, 2), np.bool_), 0.05)
    with pytest.raises(ValueError, match="3 dimensions"):
        index.meet(Boxes.none(3))
    with pytest.raises(ValueError, match="3 dimensions"):
        CellContractor(index).contract(Boxes.none(3))


def test_a_part_with_its_origin_answers_as_the_whole_grid_does() -> None:
    random = np.random.default_rng(4)
    for _ in range(cases(200, 40)):
        mask = random.random((30, 40)) < 0.05
        row, column = random.integers(0, 20, 2)
        part = mask[row : row + 10, column : column + 15]
        alone = np.zeros_like(mask)
        alone[row : row + 10, column : column + 15] = part
        resolution = float(random.choice([0.05, 1.0 / 3.0, 0.1]))
        lower = random.uniform(-5.0, 45.0, (50, 2)) * resolution
        lower[::2] = np.round(lower[::2] / resolution) * resolution
        boxes = Boxes(lower, lower + random.uniform(0.0, 8.0, (50, 2)) * random.integers(0, 2, (50, 2)) * resolution)
        met = CellIndex(part, resolution, origin=(int(row), int(column))).meet(boxes)
        assert (met == CellIndex(alone, resolution).meet(boxes)).all()


@pytest.mark.many
@pytest.mark.parametrize("resolution", [0.013, 0.042, 0.045, 0.052, 0.09, 0.05, 0.1])
def test_a_box_that_only_touches_a_cell_meets_it_whatever_the_inverse_of_the_resolution_is(resolution: float) -> None:
    """A resolution times its rounded inverse may be less than 1; multiples by powers of 2 are exact, so the edge is a double."""
    for power in range(11):
        mask = np.zeros((1, 2048), dtype=np.bool_)
        mask[0, 2**power] = True
        edge = 2**power * resolution
        index = CellIndex(mask, resolution)
        assert index.meet(Boxes.of([(edge - resolution, edge), (0.0, 0.0)])).all()
        assert CellIndex(np.ascontiguousarray(mask.T), resolution).meet(Boxes.of([(0.0, 0.0), (edge, edge)])).all()
        mask[0, 2**power - 1 : 2**power + 1] = True, False
        assert CellIndex(mask, resolution).meet(Boxes.of([(edge, edge + resolution), (0.0, 0.0)])).all()


@pytest.mark.parametrize("rows", [256, 512])
def test_a_compact_index_meets_a_block_of_as_many_cells_as_it_counts_as_none(rows: int) -> None:
    mask = np.zeros((600, 600), dtype=np.bool_)
    mask[10 : 10 + rows, 20 : 20 + 65_536 // rows] = True
    box = Boxes.of([(2.05, 0.1 * (20 + 65_536 // rows) - 0.05), (1.05, 0.1 * (10 + rows) - 0.05)])
    assert CellIndex(mask, 0.1, compact=True).meet(box).all()
