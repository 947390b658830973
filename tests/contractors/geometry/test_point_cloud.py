import math

import numpy as np
import pytest

from ial.contractors import Boxes, PointCloud


@pytest.mark.parametrize("dimension", [1, 2, 3])
@pytest.mark.parametrize("count", [1, 7, 5000])
def test_contraction_is_the_hull_of_the_points_in_the_box(dimension: int, count: int) -> None:
    rng = np.random.default_rng(count)
    points = np.where(rng.random((count, dimension)) < 0.3, rng.integers(0, 11, (count, dimension)), rng.uniform(0, 10, (count, dimension)))
    lower = np.where(rng.random((600, dimension)) < 0.5, rng.integers(-1, 10, (600, dimension)), rng.uniform(-1, 10, (600, dimension)))
    boxes = Boxes(lower, lower + rng.choice([0.0, 0.5, 3.0, 12.0, np.inf], (600, dimension)))
    narrowed = PointCloud(points).contract(boxes)
    for i in range(600):
        inside = points[((points >= boxes.lower[i]) & (points <= boxes.upper[i])).all(axis=1)]
        assert (narrowed.lower[i] == inside.min(axis=0, initial=np.inf)).all()
        assert (narrowed.upper[i] == inside.max(axis=0, initial=-np.inf)).all()


def test_points_may_coincide() -> None:
    narrowed = PointCloud([[1, 2]] * 5).contract(Boxes.of([(0, 1), (2, 3)], [(0, 1), (2.5, 3)]))
    assert narrowed.empty.tolist() == [False, True]
    assert (narrowed.lower[0].tolist(), narrowed.upper[0].tolist()) == ([1, 2], [1, 2])


def test_clouds_that_cannot_be_meant() -> None:
    with pytest.raises(ValueError, match="shape"):
        PointCloud(np.empty((0, 2)))
    with pytest.raises(ValueError, match="row 1"):
        PointCloud([[0, 0], [1, math.inf]])
    with pytest.raises(ValueError, match="PointCloud needs 2"):
        PointCloud([[0, 0]]).contract(Boxes.of([(0, 1)]))
