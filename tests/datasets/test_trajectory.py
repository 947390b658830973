"""Tests of trajectories in TUM files."""

import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from ial.datasets.trajectory import Trajectory, interpolate, read_tum, write_tum
from ial.errors import OutputError, TrajectoryError
from ial.pose import Pose

MS = 10**6


def _file(folder: Path, text: str) -> Path:
    path = folder / "test.tum"
    path.write_text(text)
    return path


@pytest.mark.slow
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    st.lists(
        st.tuples(st.integers(0, 2**62), *[st.floats(-1e4, 1e4)] * 2, st.floats(-math.pi, math.pi)), min_size=1, unique_by=lambda s: s[0]
    )
)
def test_what_is_written_is_read(tmp_path: Path, samples: list[tuple[int, float, float, float]]) -> None:
    samples.sort()
    trajectory = Trajectory.of((stamp, Pose(x, y, theta)) for stamp, x, y, theta in samples)
    write_tum(trajectory, tmp_path / "out.tum")
    copy = read_tum(tmp_path / "out.tum")
    assert copy.stamps_ns.tolist() == trajectory.stamps_ns.tolist()
    assert (copy.poses[:, :2] == trajectory.poses[:, :2]).all()
    assert np.abs(copy.poses[:, 2] - trajectory.poses[:, 2]) == pytest.approx(0.0, abs=1e-14)
    assert [path.name for path in tmp_path.iterdir()] == ["out.tum"]


def test_references_are_read_to_the_nanosecond(data_folder: Path) -> None:
    trajectory = read_tum(data_folder / "mrpt_malaga" / "pseudo_reference_map_demo.tum")
    assert len(trajectory) == 37
    assert trajectory.stamps_ns[0] == 1137772793094853000


def test_comments_blank_lines_and_commas_are_fine(tmp_path: Path) -> None:
    trajectory = read_tum(_file(tmp_path, "# time x y z\n\n1.5 1 2 9 0 0 0 1 # here\n2,3,4,0,0,0,1,0\n"))
    assert trajectory.stamps_ns.tolist() == [1_500_000_000, 2_000_000_000]
    assert trajectory[0] == Pose(1.0, 2.0, 0.0)
    assert trajectory[1].theta == math.pi


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("1 0 0 0 0 0 0 1\n2 0 0 0 0 0 1\n", "line 2: 7 words"),
        ("x 0 0 0 0 0 0 1\n", "line 1: 'x' is not a time"),
        ("1 a 0 0 0 0 0 1\n", "line 1"),
        ("1 nan 0 0 0 0 0 1\n", "line 1: a number that is not finite"),
        ("1 0 0 0 0 0 0 0\n", "line 1"),
        ("1 0 0 0 1 0 0 0\n", "line 1"),
        ("1 0 0 0 0.5 0 0 1\n", "line 1: the rotation is tilted"),
        ("2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n", "line 2: stamp 1 does not come after"),
        ("1 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n", "line 2"),
        ("# nothing\n", "holds no pose"),
    ],
)
def test_bad_lines_are_named(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(TrajectoryError, match=message):
        read_tum(_file(tmp_path, text))


def test_files_that_cannot_be_read_or_written_are_named(tmp_path: Path) -> None:
    with pytest.raises(TrajectoryError, match="cannot be read"):
        read_tum(tmp_path / "missing.tum")
    (tmp_path / "binary.tum").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(TrajectoryError, match="not a text file"):
        read_tum(tmp_path / "binary.tum")
    with pytest.raises(OutputError, match="cannot be written"):
        write_tum(Trajectory.of([(0, Pose())]), tmp_path / "nowhere" / "out.tum")


def test_a_pose_is_exact_or_between_near_neighbours() -> None:
    trajectory = Trajectory.of([(0, Pose(0.0, 0.0, 3.0)), (400 * MS, Pose(4.0, 8.0, -3.0)), (1000 * MS, Pose(9.0)), (2100 * MS, Pose(9.0))])
    assert trajectory.at(400 * MS) == Pose(4.0, 8.0, -3.0)
    between = trajectory.at(100 * MS)
    assert between is not None
    assert (between.x, between.y) == pytest.approx((1.0, 2.0))
    assert between.theta == pytest.approx(3.0 + 0.25 * (2 * math.pi - 6.0))
    assert trajectory.at(700 * MS) is not None, "300 ms from both neighbours, although they are 600 ms apart"
    assert trajectory.at(450 * MS) is None, "550 ms from the second neighbour"
    assert trajectory.at(1500 * MS) is None
    assert trajectory.at(-1) is None
    assert trajectory.at(2100 * MS + 1) is None


def test_an_empty_trajectory_has_no_pose() -> None:
    empty = Trajectory.of([])
    assert len(empty) == 0
    assert empty.at(0) is None


@given(st.floats(-math.pi, math.pi), st.floats(-math.pi, math.pi), st.floats(0.0, 1.0))
def test_headings_turn_the_shorter_way(start: float, end: float, share: float) -> None:
    theta = interpolate(Pose(0.0, 0.0, start), Pose(0.0, 0.0, end), share).theta
    turn = math.remainder(end - start, 2 * math.pi)
    assert abs(math.remainder(theta - start, 2 * math.pi)) <= abs(turn) + 1e-12


def test_stamps_must_increase_and_poses_be_finite() -> None:
    with pytest.raises(TrajectoryError, match=r"stamp 0\.000000001 of pose 1"):
        Trajectory.of([(2, Pose()), (1, Pose())])
    with pytest.raises(TrajectoryError, match="pose 1 is not finite"):
        Trajectory.of([(1, Pose()), (2, Pose(math.nan))])
    with pytest.raises(TrajectoryError, match="1 stamps for 2 poses"):
        Trajectory(np.array([1]), np.zeros((2, 3)))
