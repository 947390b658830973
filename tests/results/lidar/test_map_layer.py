import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.figure import Figure

from ial.contractors.boxes import Boxes
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, UNKNOWN, OccupancyGrid
from ial.pose import Pose
from ial.results.lidar import map_layer
from ial.results.lidar.map_layer import MapLayer, covered_cells

SIDE = st.tuples(st.integers(-5, 12), st.integers(0, 6)).map(lambda pair: (0.5 * pair[0], 0.5 * (pair[0] + pair[1])))


def overlaps(side: tuple[float, float], cell: int) -> bool:
    """Whether an interval overlaps a cell; one without width belongs to the cell above."""
    lower, upper = side
    return lower < cell + 1 and upper > cell if upper > lower else cell <= lower < cell + 1


@given(st.lists(st.tuples(SIDE, SIDE), max_size=6))
def test_covered_cells_are_those_that_overlap_a_box(rectangles: list[tuple[tuple[float, float], tuple[float, float]]]) -> None:
    grid = OccupancyGrid(np.zeros((4, 5), dtype=np.uint8), 1.0)
    boxes = Boxes.of(*([*pair, (0.0, 1.0)] for pair in rectangles)) if rectangles else Boxes.none(3)
    expected = [[any(overlaps(x, column) and overlaps(y, row) for x, y in rectangles) for column in range(5)] for row in range(4)]
    assert covered_cells(boxes, grid).tolist() == expected


def test_the_view_holds_what_is_known_of_a_turned_map() -> None:
    cells = np.full((40, 60), UNKNOWN, dtype=np.uint8)
    cells[10:20, 30:50] = FREE
    grid = OccupancyGrid(cells, 0.1, Pose(5.0, 6.0, 1.0))
    left, right, bottom, top = MapLayer(grid).view
    for column, row in ((30, 10), (50, 10), (30, 20), (50, 20)):
        corner = grid.pose_to_map(Pose(0.1 * column, 0.1 * row))
        assert left < corner.x < right
        assert bottom < corner.y < top
    assert right - left < 5.0


def test_a_map_of_unknown_cells_alone_is_shown_whole() -> None:
    left, right, _, _ = MapLayer(OccupancyGrid(np.full((4, 5), UNKNOWN, dtype=np.uint8), 1.0)).view
    assert left < 0.0 < 5.0 < right


def test_a_thin_wall_survives_in_a_large_map(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(map_layer, "_CELLS", 100)
    cells = np.zeros((101, 103), dtype=np.uint8)
    cells[37, :] = OCCUPIED
    layer = MapLayer(OccupancyGrid(cells, 0.1))
    darkest = layer._pixels[:, :, 0].min(axis=0)
    assert layer._pixels.shape[0] * layer._pixels.shape[1] <= 150
    assert (darkest < 0.2).all()


def test_the_view_takes_the_shape_of_the_axes() -> None:
    grid = OccupancyGrid(np.zeros((40, 60), dtype=np.uint8), 0.1)
    axes = Figure(figsize=(8, 2)).add_axes((0.0, 0.0, 1.0, 1.0))
    MapLayer(grid).draw(axes)
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    assert (right - left) / (top - bottom) == pytest.approx(4.0)
    assert left < 0.0 < 6.0 < right
