from collections.abc import Callable
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import numpy.typing as npt
import pytest

from ial.datasets.sample import sample_grid
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose
from ial.results.lidar.picture import Picture
from ial.results.palette import PATH, STATUS_COLOURS, TRUTH, VANISHING, rgb

BOX = [(1.0, 1.6), (3.0, 3.4), (0.1, 0.2)]


def has(image: npt.NDArray[Any], colour: str) -> bool:
    blue_green_red = np.array(rgb(colour)[::-1]) * 255
    return bool((np.abs(image.astype(np.float64) - blue_green_red).max(axis=2) < 2.0).any())


def drawn(path: Path, grid: OccupancyGrid, run: list[Any], **options: Any) -> npt.NDArray[Any]:
    with Picture(path, grid, "run.bag", **options) as picture:
        for step, estimate in run:
            picture.add(step, estimate)
    image = cv2.imread(str(path))
    assert image is not None
    return image


@pytest.mark.slow
def test_a_run_with_a_reference(sample_run: list[Any], tmp_path: Path) -> None:
    poses = [estimate.pose for _, estimate in sample_run]
    stamps = [step.stamp_ns for step, _ in sample_run]
    image = drawn(tmp_path / "picture.png", sample_grid(), sample_run, reference=lambda step: poses[stamps.index(step.stamp_ns)])
    assert image.shape[1] == 1680
    for colour in (PATH, TRUTH, STATUS_COLOURS["localized"], STATUS_COLOURS["ambiguous"]):
        assert has(image, colour)


@pytest.mark.slow
def test_without_a_reference_none_is_drawn(estimate_of: Callable[..., Any], grid: OccupancyGrid, tmp_path: Path) -> None:
    image = drawn(tmp_path / "picture.png", grid, [estimate_of(0, BOX), estimate_of(1, BOX)])
    assert has(image, STATUS_COLOURS["ambiguous"])
    assert not has(image, PATH)
    assert not has(image, STATUS_COLOURS["localized"])


@pytest.mark.slow
@pytest.mark.parametrize("count", [0, 1, 2000])
def test_runs_of_any_length(estimate_of: Callable[..., Any], grid: OccupancyGrid, tmp_path: Path, count: int) -> None:
    step, estimate = estimate_of(0, BOX, status="localized")
    run = [(type(step)(3 * index, index, None, step.scan, Pose()), estimate) for index in range(count)]
    image = drawn(tmp_path / "picture.png", grid, run)
    assert has(image, STATUS_COLOURS["localized"]) is (count > 0)


@pytest.mark.slow
def test_a_scan_that_left_no_pose(estimate_of: Callable[..., Any], grid: OccupancyGrid, tmp_path: Path) -> None:
    assert has(drawn(tmp_path / "picture.png", grid, [estimate_of(0, status="blind")]), STATUS_COLOURS["blind"])


@pytest.mark.slow
def test_vanishing_scans_are_marked(estimate_of: Callable[..., Any], grid: OccupancyGrid, tmp_path: Path) -> None:
    for marked in (False, True):
        run = [estimate_of(0, BOX, status="localized"), estimate_of(1, BOX, status="localized", vanishing=marked)]
        assert has(drawn(tmp_path / "picture.png", grid, run), VANISHING) is marked


def test_an_interrupted_run_draws_nothing(grid: OccupancyGrid, tmp_path: Path) -> None:
    def run() -> None:
        with Picture(tmp_path / "picture.png", grid, "run.bag"):
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run()
    assert list(tmp_path.iterdir()) == []
