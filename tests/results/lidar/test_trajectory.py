from pathlib import Path
from typing import Any

from ial.datasets.trajectory import read_tum
from ial.results.lidar.trajectory import TrajectoryFile


def test_it_holds_exactly_the_poses_that_are_there(sample_run: list[Any], tmp_path: Path) -> None:
    path = tmp_path / "trajectory.tum"
    with TrajectoryFile(path) as file:
        for step, estimate in sample_run:
            file.add(step, estimate)
    expected = [(step.stamp_ns, estimate.pose) for step, estimate in sample_run if estimate.pose is not None]
    trajectory = read_tum(path)
    assert trajectory.stamps_ns.tolist() == [stamp for stamp, _ in expected]
    assert 0 < len(expected) < len(sample_run)
    for row, (_, pose) in enumerate(expected):
        assert (trajectory[row].x, trajectory[row].y) == (pose.x, pose.y)
        assert abs(trajectory[row].theta - pose.theta) < 1e-15


def test_a_run_that_was_never_localized_leaves_an_empty_file(sample_run: list[Any], tmp_path: Path) -> None:
    path = tmp_path / "trajectory.tum"
    with TrajectoryFile(path) as file:
        file.add(*sample_run[0])
    assert path.read_text() == ""
