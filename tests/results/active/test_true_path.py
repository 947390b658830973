from pathlib import Path

from ial.datasets.trajectory import read_tum
from ial.pose import Pose
from ial.results.active.true_path import TruePath


def test_poses_are_written_and_the_last_is_known(tmp_path: Path) -> None:
    first, second = Pose(1.25, -2.0, 0.5), Pose(3.0, 4.5, -1.0)
    with TruePath(tmp_path / "truth.tum") as path:
        assert path.at(10**9) is None
        path.add(10**9, first)
        assert path.at(10**9) == first
        path.add(2 * 10**9, second)
        assert (path.at(10**9), path.at(2 * 10**9)) == (None, second)
    written = read_tum(tmp_path / "truth.tum")
    assert written.stamps_ns.tolist() == [10**9, 2 * 10**9]
    assert abs(written[1].theta - second.theta) < 1e-12
    assert (written[0].x, written[0].y) == (first.x, first.y)
