import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from ial.contractors.boxes import Boxes
from ial.results.lidar.markers import rectangles

CORNERS = st.lists(st.tuples(st.floats(0.0, 9.0), st.floats(0.0, 9.0), st.floats(0.0, 1.0)), min_size=1, max_size=40)


@given(corners=CORNERS, limit=st.integers(1, 50))
def test_few_rectangles_cover_every_box(corners: list[tuple[float, float, float]], limit: int) -> None:
    boxes = Boxes.of(*([(x, x + size), (y, y + size), (0.0, 1.0)] for x, y, size in corners))
    cover = rectangles(boxes, limit)
    assert len(cover) <= limit
    for lower, upper in zip(boxes.lower, boxes.upper, strict=True):
        covered = (cover[:, :2] <= lower[:2] + 1e-9).all(axis=1) & (upper[:2] - 1e-9 <= cover[:, 2:]).all(axis=1)
        assert covered.any()


def test_points_are_widened_too() -> None:
    boxes = Boxes.of(*([(0.1 * i, 0.1 * i), (0.0, 0.0), (0.0, 1.0)] for i in range(100)))
    assert 1 <= len(rectangles(boxes, 3)) <= 3


def test_headings_of_one_place_make_one_rectangle() -> None:
    boxes = Boxes.of(*([(1.0, 2.0), (3.0, 4.0), (0.1 * i, 0.1 * i + 0.1)] for i in range(5)))
    assert rectangles(boxes, 100).tolist() == [[1.0, 3.0, 2.0, 4.0]]


def test_no_boxes_make_no_rectangle() -> None:
    assert rectangles(Boxes.none(3), 10).shape == (0, 4)
    assert np.isfinite(rectangles(Boxes.none(3), 10)).all()
