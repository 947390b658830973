"""One run over the embedded sample, and estimates made by hand."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.datasets.odometry import Odometry
from ial.datasets.recording import Step
from ial.datasets.sample import sample_grid, sample_recording
from ial.datasets.scan import LaserScan, Mounting
from ial.lidar.configuration.config import Bounds
from ial.lidar.estimate import Estimate
from ial.lidar.hypothesis import find_hypotheses
from ial.lidar.localizer import Localizer
from ial.lidar.pose_set import PoseSet
from ial.lidar.run import localize
from ial.maps.grids.occupancy_grid import OCCUPIED, OccupancyGrid
from ial.pose import Pose

Run = list[tuple[Step, Estimate]]


@pytest.fixture(scope="session")
def sample_run() -> Run:
    """Every third scan of the sample, with so many outliers allowed that it begins ambiguous; it ends localized."""
    return list(localize(sample_recording(), Localizer(sample_grid(), Bounds(0.05, 0.0, 0.05), outliers=0.12), every=3))


@pytest.fixture(scope="session")
def grid() -> OccupancyGrid:
    """A room of 8 × 6 m in a shifted and turned frame."""
    cells = np.zeros((60, 80), dtype=np.uint8)
    cells[[0, -1], :] = OCCUPIED
    cells[:, [0, -1]] = OCCUPIED
    return OccupancyGrid(cells, 0.1, Pose(-3.0, 2.0, 0.4))


@pytest.fixture
def estimate_of(grid: OccupancyGrid) -> Callable[..., tuple[Step, Estimate]]:
    """Return a function that makes the estimate of one scan from rows of boxes in the grid frame."""

    def make(index: int, *rows: Any, status: str = "ambiguous", unconfirmed: bool = False, **changes: Any) -> tuple[Step, Estimate]:
        boxes = Boxes.of(*rows) if rows else Boxes.none(3)
        poses = PoseSet(boxes, np.full(len(boxes), unconfirmed))
        hypotheses = find_hypotheses(poses, grid)
        stamp = 10**18 + 123456789 * index
        scan = LaserScan(stamp, np.array([1.0, 2.0, np.inf]), -0.5, 0.5, 0.1, 10.0, mounting=Mounting(0.2, 0.1, 0.3, upside_down=True))
        fields: dict[str, Any] = {
            "stamp_ns": stamp,
            "status": status,
            "hypotheses": hypotheses,
            "pose": hypotheses[0].centre if status == "localized" else None,
            "poses": poses,
            "beams": 2,
            "outliers_allowed": 1,
            "uninformative": False,
            "limited": "",
            "elapsed_s": 0.25,
            **changes,
        }
        return Step(index, stamp, None, scan, Odometry.of(Pose(0.1 * index, 0.0, 0.05 * index))), Estimate(**fields)

    return make
