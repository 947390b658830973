import math
from collections.abc import Callable

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.contractor import Contractor
from ial.contractors.intervals.angle import contains_angle
from ial.contractors.intervals.trigonometric import PI_UPPER
from ial.contractors.paving.paver import pave
from ial.lidar.search.lattice import Lattice, layer_edges

PLENTY = 10**6


def covers(cells: Boxes, x: float, y: float, theta: float) -> bool:
    inside = np.flatnonzero(((cells.lower[:, :2] <= (x, y)) & ((x, y) <= cells.upper[:, :2])).all(axis=1))
    return any(contains_angle(cells.lower[row, 2], cells.upper[row, 2], theta) for row in inside)


def assert_covered(cells: Boxes, boxes: Boxes, random: np.random.Generator) -> None:
    for lower, upper in zip(boxes.lower, boxes.upper, strict=True):
        shares = np.vstack([np.array(np.meshgrid(*[[0.0, 1.0]] * 3)).reshape(3, -1).T, random.random((10, 3))])
        for at in np.clip(lower + shares * (upper - lower), lower, upper):
            assert covers(cells, *at.tolist()), (lower, upper, at)


def keys(lattice: Lattice, cells: Boxes, level: int) -> set[tuple[int, int, int]]:
    """Return the numbers of cells of a level, each of which must be one."""
    step, layers = lattice.position_m * 2.0**level, max(1, lattice.layers >> level)
    numbers = np.rint(cells.lower[:, :2] / step)
    assert (cells.lower[:, :2] == numbers * step).all()
    assert (cells.upper[:, :2] == (numbers + 1.0) * step).all()
    width = 2.0 * math.pi / layers
    layer = np.rint((cells.lower[:, 2] + math.pi) / width)
    assert np.abs(cells.lower[:, 2] - (layer * width - math.pi)).max() < 1e-14
    assert np.abs(cells.upper[:, 2] - ((layer + 1) * width - math.pi)).max() < 1e-14
    assert ((layer >= 0) & (layer < layers)).all()
    return {(int(x), int(y), int(turn)) for (x, y), turn in zip(numbers, layer, strict=True)}


@st.composite
def batches(draw: Callable[..., float]) -> tuple[Lattice, Boxes]:
    """Return a lattice and boxes, many with bounds on the edges of its cells, headings in the form of `ial.contractors.intervals.angle`."""
    lattice = Lattice(draw(st.sampled_from([0.1, 0.25, 1.0, 0.3])), draw(st.sampled_from([0.1, 0.3, 0.5, 2.0, 4.0])))
    rows = []
    for _ in range(int(draw(st.integers(1, 4)))):
        row = []
        for _ in range(2):
            number = draw(st.integers(-40, 40) | st.floats(-40.0, 40.0))
            cells = draw(st.integers(0, 3) | st.floats(0.0, 4.0))
            row.append((number * lattice.position_m, (number + cells) * lattice.position_m))
        turn = draw(st.integers(0, lattice.layers) | st.floats(0.0, lattice.layers))
        lower = min(max(-math.pi + 2.0 * math.pi * turn / lattice.layers, -PI_UPPER), PI_UPPER)
        row.append((lower, lower + draw(st.sampled_from([0.0, 2.0 * math.pi / lattice.layers, 3.0]) | st.floats(0.0, 6.0))))
        rows.append(draw(st.sampled_from([row, [*row[:2], (-PI_UPPER, PI_UPPER)]])))
    return lattice, Boxes.of(*rows)


@pytest.mark.slow
@given(batches(), st.sampled_from([PLENTY, 5000, 50, 1]))
@settings(max_examples=150)
def test_the_cells_are_distinct_and_cover_every_point_of_every_box(batch: tuple[Lattice, Boxes], max_cells: int) -> None:
    lattice, boxes = batch
    cells = lattice.cover(boxes, max_cells)
    assert len(cells) <= max(max_cells, 4)  # no level has fewer cells than the four around a corner of all levels
    assert_covered(cells, boxes, np.random.default_rng(0))
    level = round(math.log2((cells.upper[0, 0] - cells.lower[0, 0]) / lattice.position_m))
    assert len(keys(lattice, cells, level)) == len(cells)
    if level:
        finer = Lattice(lattice.position_m * 2.0 ** (level - 1), 1.0)
        finer.layers = max(1, lattice.layers >> (level - 1))
        assert len(finer.cover(boxes, PLENTY)) > max_cells


@pytest.mark.slow
@given(batches())
@settings(max_examples=100)
def test_no_cell_is_far_from_every_box(batch: tuple[Lattice, Boxes]) -> None:
    lattice, boxes = batch
    cells = lattice.cover(boxes, PLENTY)
    slack = 1e-8  # headings take a margin of 1e-9 cells
    meets = ((cells.lower[:, None, :2] <= boxes.upper[:, :2]) & (boxes.lower[:, :2] <= cells.upper[:, None, :2])).all(axis=2)
    turned = np.zeros_like(meets)
    for turn in (-2.0 * math.pi, 0.0, 2.0 * math.pi):
        turned |= (cells.lower[:, None, 2] + turn <= boxes.upper[:, 2] + slack) & (
            boxes.lower[:, 2] <= cells.upper[:, None, 2] + turn + slack
        )
    assert (meets & turned).any(axis=1).all()


def test_a_box_on_the_edges_of_a_cell_is_that_cell_alone() -> None:
    lattice = Lattice(0.5, 0.5)
    cells = lattice.cover(Boxes.of([(-1.0, -0.5), (0.5, 1.0), (0.1, 0.2)]), PLENTY)
    assert cells.lower[:, :2].tolist() == [[-1.0, 0.5]]
    assert cells.upper[:, :2].tolist() == [[-0.5, 1.0]]


def test_overlapping_boxes_are_counted_once() -> None:
    lattice = Lattice(0.1, 0.1)
    boxes = Boxes.of(*[[(-0.05 + 1e-4 * i, 0.05 + 1e-4 * i), (0.0, 0.1), (0.0, 0.05)] for i in range(100)])
    assert len(lattice.cover(boxes, PLENTY)) == 2 * len(keys(lattice, lattice.cover(boxes[:1], PLENTY), 0)) // 2
    assert len(lattice.cover(boxes, PLENTY)) == len(lattice.cover(boxes.hull(), PLENTY))


def test_headings_across_the_cut_meet_the_last_and_the_first_layer() -> None:
    lattice = Lattice(1.0, math.pi / 4.0)
    assert lattice.layers == 8
    cells = lattice.cover(Boxes.of([(0.2, 0.4), (0.2, 0.4), (3.0, 3.4)]), PLENTY)
    assert {turn for _, _, turn in keys(lattice, cells, 0)} == {7, 0}
    assert cells.lower[:, 2].min() == -PI_UPPER
    assert cells.upper[:, 2].max() == PI_UPPER


def test_the_full_circle_takes_each_layer_once() -> None:
    lattice = Lattice(1.0, 0.1)
    cells = lattice.cover(Boxes.of([(0.2, 0.4), (0.2, 0.4), (-PI_UPPER, PI_UPPER)]), PLENTY)
    assert len(cells) == len(keys(lattice, cells, 0)) == lattice.layers


@pytest.mark.parametrize(("heading", "layers"), [(0.025, 256), (2.0 * math.pi / 64, 64), (math.pi, 2), (1.0, 8)])
def test_the_circle_is_divided_into_a_power_of_two(heading: float, layers: int) -> None:
    lattice = Lattice(0.1, heading)
    assert lattice.layers == layers
    assert 0.1 <= lattice.widths[0] <= 0.1 * (1.0 + 1e-5)
    assert lattice.widths[2] == pytest.approx(2.0 * math.pi / layers, rel=1e-5)


def test_empty_boxes_need_no_cells() -> None:
    lattice = Lattice(0.1, 0.1)
    assert len(lattice.cover(Boxes.none(3), 1)) == 0
    assert len(lattice.cover(Boxes(np.full((2, 3), np.inf), np.full((2, 3), -np.inf)), 1)) == 0


def test_a_large_box_is_covered_by_a_coarser_level_at_once() -> None:
    lattice = Lattice(0.001, 1e-4)
    box = Boxes.of([(-2000.0, 3000.0), (0.0, 5000.0), (-PI_UPPER, PI_UPPER)])
    cells = lattice.cover(box, 1000)
    assert 1 <= len(cells) <= 1000
    assert_covered(cells, box, np.random.default_rng(0))


class Point:
    """Keeps the boxes that hold one point."""

    dimension = 3

    def __init__(self, at: FloatArray) -> None:
        self.at = at

    def contract(self, boxes: Boxes) -> Boxes:
        return boxes.where(boxes.contain(self.at.tolist()))


@pytest.mark.parametrize("size", [(10.0, 3.0), (3.2, 3.3), (0.05, 0.02), (12.8, 12.8), (0.1, 409.7), (0.7, 0.3)])
@pytest.mark.parametrize("position", [0.1, 0.25, 0.3])
def test_the_root_holds_the_map_and_is_bisected_down_to_the_cells(size: tuple[float, float], position: float) -> None:
    lattice = Lattice(position, 0.1)
    root = lattice.root(*size)
    assert (root.lower[0, :2] == 0.0).all()
    assert (root.upper[0, :2] >= size).all()
    assert root.upper[0, 0] < 2.0 * max(*size, position)
    assert (root.lower[0, 2], root.upper[0, 2]) == (-PI_UPPER, PI_UPPER)
    at = np.random.default_rng(0).random(3) * [*size, 6.0] + [0.0, 0.0, -3.0]
    contractor: Contractor = Point(at)
    paving = pave(contractor, root, lattice.widths, max_boxes=PLENTY)
    assert len(keys(lattice, paving.boxes, 0)) == len(paving.boxes) == 1
    assert len(lattice.cover(paving.boxes, PLENTY)) <= 3  # the margin of the heading may take in its neighbours, nothing else


@pytest.mark.many
@pytest.mark.parametrize("position", [0.1, 0.05, 0.3, 1.0 / 3.0, 0.25])
def test_halves_of_cells_never_stick_out_of_their_cell(position: float) -> None:
    # A half that sticks out by one bit would take a whole cell more; the paver bisects down to halves.
    lattice = Lattice(position, 3.0)
    root = lattice.root(40.0, 1e-3)
    lines = Boxes(root.lower * [1.0, 0.0, 0.0], root.upper * [1.0, 0.0, 0.0])
    while lines.width()[0, 0] > 0.6 * position:
        lines = lines.bisect(np.zeros(len(lines), dtype=np.intp))
    middle = np.array([0.0, 0.5 * position, 1.0])
    inside = Boxes(lines.lower + middle, lines.upper + middle)
    assert len(inside) >= 80.0 / position
    assert all(len(lattice.cover(inside[[row]], PLENTY)) == 1 for row in range(len(inside)))


@pytest.mark.parametrize("position", [0.1, 0.05, 0.3, 1.0 / 3.0, 0.25, 1e-3, 1e4])
def test_the_width_of_a_cell_is_the_wanted_one_to_seven_digits(position: float) -> None:
    assert position <= Lattice(position, 0.1).position_m <= Lattice(position, 0.1).widths[0] <= position * (1.0 + 2e-6)


@pytest.mark.many
@pytest.mark.parametrize("position", [0.1, 1.0 / 3.0, 0.0333, 0.05, 1.0, 0.7])
def test_a_double_beside_the_edge_of_a_cell_is_in_the_cell_on_its_side(position: float) -> None:
    lattice = Lattice(position, 1.0)
    edges = lattice.position_m * np.concatenate([np.arange(-300, 1500), 2 ** np.arange(1, 17) + 1, np.arange(65_000, 65_536)])
    for side in (-1.0, 1.0):
        at = np.nextafter(edges, side * np.inf)[edges != 0.0]
        for axis in (0, 1):
            bounds = np.zeros((len(at), 3))
            bounds[:, axis] = at
            cells = [lattice.bitmaps(Boxes(row[None], row[None])) for row in bounds[:: 97 if axis else 1]]
            boxes = [lattice.boxes(each) for each in cells]
            for row, box in zip(bounds[:: 97 if axis else 1], boxes, strict=True):
                assert len(box) == 1
                assert box.lower[0, axis] < row[axis] < box.upper[0, axis]


@pytest.mark.parametrize("heading", [0.5, 0.1, 0.02, pytest.param(0.003, marks=pytest.mark.many)])
def test_a_heading_a_bit_beyond_the_edge_of_a_layer_takes_the_layer_behind_it(heading: float) -> None:
    lattice = Lattice(1.0, heading)
    edges = layer_edges(lattice.layers)[1:-1]
    for start, stop in ((np.nextafter(edges, -9.0), edges), (edges, np.nextafter(edges, 9.0)), (edges, edges)):
        layers = np.array(
            [[hull.lower[0, 2], hull.upper[0, 2]] for hull in (_around(lattice, *each) for each in zip(start, stop, strict=True))]
        )
        assert (layers[:, 0] <= start).all()
        assert (layers[:, 1] >= stop).all()


@pytest.mark.slow
@pytest.mark.parametrize("heading", [0.5, 0.1, 0.02])
def test_an_arc_across_the_cut_takes_the_layer_in_which_it_ends(heading: float) -> None:
    lattice = Lattice(1.0, heading)
    with mpmath.workdps(40):
        turn = 2 * mpmath.pi
        for edge in layer_edges(lattice.layers)[: lattice.layers // 2].tolist():
            for beyond in (0.0, 2e-15, 1e-12, 3e-9):
                stop = float(edge + turn) + beyond
                cells = lattice.boxes(lattice.bitmaps(Boxes.of([(0.5, 0.5), (0.5, 0.5), (3.0, stop)])))
                lower, upper = cells.lower[:, 2].tolist(), cells.upper[:, 2].tolist()
                assert any(low <= stop - turn <= high or low <= stop <= high for low, high in zip(lower, upper, strict=True))


def _around(lattice: Lattice, start: float, stop: float) -> Boxes:
    return lattice.boxes(lattice.bitmaps(Boxes.of([(0.5, 0.5), (0.5, 0.5), (start, stop)]))).hull()
