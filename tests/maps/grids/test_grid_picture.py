import cv2
import numpy as np

from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, UNKNOWN, OccupancyGrid


def pixels(grid: OccupancyGrid) -> np.ndarray:
    return cv2.imdecode(np.frombuffer(grid._repr_png_(), dtype=np.uint8), cv2.IMREAD_UNCHANGED)


def test_a_small_grid_is_enlarged_with_its_first_row_at_the_bottom() -> None:
    seen = pixels(OccupancyGrid(np.array([[FREE, OCCUPIED], [UNKNOWN, FREE]], dtype=np.uint8), 0.1))
    assert seen.shape == (600, 600)
    assert [int(seen[y, x]) for y, x in ((599, 0), (599, 599), (0, 0), (0, 599))] == [255, 40, 200, 255]


def test_a_thin_wall_of_a_large_grid_stays_visible() -> None:
    cells = np.full((10, 5000), FREE, dtype=np.uint8)
    cells[:, 1234] = OCCUPIED
    cells[:, 4000] = UNKNOWN
    seen = pixels(OccupancyGrid(cells, 0.1))
    assert seen.shape[1] <= 600
    assert (seen.min(axis=0) == 40).sum() == 1
    assert set(np.unique(seen)) == {40, 255}
