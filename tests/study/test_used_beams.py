"""Which beams are used, and how they are seen from the base, against docs/guarantee.md worked out by hand."""

import cmath
import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from ial.datasets.motion import ErrorBound, MotionBounds
from ial.datasets.scan import LaserScan, Mounting
from ial.lidar.configuration.config import Bounds, FreeSpace, LidarBounds, LocalizerConfig
from ial.pose import Pose
from ial.study.used_beams import UsedBeams, in_grid, spread
from tests.study.scans import swept

NAN, INF = math.nan, math.inf


def used(ranges: list[float], config: LocalizerConfig | None = None, **scan: Any) -> UsedBeams:
    given = {"angle_min": -0.5, "angle_increment": 0.25, "range_min": 0.5, "range_max": 8.0} | scan
    return UsedBeams.of(LaserScan(0, np.array(ranges, np.float32), **given), config or LocalizerConfig())


def test_hits_are_used_and_nothing_else() -> None:
    beams = used([1.0, NAN, INF, -INF, 0.5, 0.25, 8.0, 7.5, -1.0, 9.0])
    assert beams.numbers.tolist() == [0, 4, 7]
    assert beams.readings.tolist() == [1.0, 0.5, 7.5]
    assert used([0.0, -0.0, 1.0, INF], range_min=0.0, range_max=INF).numbers.tolist() == [2]


def test_of_too_many_those_numbered_by_equal_shares_are_used() -> None:
    assert spread(np.arange(10), 4).tolist() == [0, 2, 5, 7]
    assert spread(np.arange(4), 4).tolist() == [0, 1, 2, 3]
    hits = [1.0, INF, 1.0, 1.0, NAN, 1.0, 1.0, 1.0, 1.0]
    beams = used(hits, LocalizerConfig(max_beams=5, free_space=FreeSpace(max_rays=2)))
    assert beams.numbers.tolist() == [0, 2, 3, 6, 7]  # of the hits 0, 2, 3, 5, 6, 7, 8 those at 0, 1, 2, 4, 5
    assert beams.rays.tolist() == [0, 2]


def test_beams_without_return_are_used_where_they_speak() -> None:
    ranges = [INF, 1.0, 8.0, 2.0, INF, INF, NAN]
    silent = used(ranges, LocalizerConfig(free_space=FreeSpace(max_rays=2)))
    assert (len(silent), silent.rays.tolist()) == (2, [0, 1])
    free = FreeSpace(margin_m=0.25, max_rays=3, no_return_m=20.0)
    beams = used(ranges, LocalizerConfig(bounds=Bounds(0.5), free_space=free))
    assert beams.numbers.tolist() == [1, 3, 0, 2, 4]  # of four without return three: those at 0, 1, 2
    assert beams.rays.tolist() == [0, 1, 2, 3, 4]
    assert beams.lengths.tolist() == [0.25, 1.25, 7.25, 7.25, 7.25]
    near = replace(free, no_return_m=3.0)
    assert used(ranges, LocalizerConfig(bounds=Bounds(0.5), free_space=near)).lengths[2:].tolist() == [2.25, 2.25, 2.25]
    off = replace(free, use=False)
    assert (len(used(ranges, LocalizerConfig(free_space=off))), len(used(ranges, LocalizerConfig(free_space=off)).rays)) == (2, 0)


def test_the_errors_are_those_of_the_lidar() -> None:
    bounds = Bounds(0.5, 0.1, 0.2, lidars={"rear": LidarBounds(0.25, 0.0)})
    assert used([1.0], LocalizerConfig(bounds=bounds), frame_id="rear").bounds.range_error_m == 0.25
    assert used([1.0], LocalizerConfig(bounds=bounds), frame_id="front").bounds.range_error_m == 0.5


@pytest.mark.parametrize("upside_down", [False, True])
@pytest.mark.parametrize("increment", [0.25, -0.5])
def test_a_beam_is_seen_from_its_mounting(upside_down: bool, increment: float) -> None:
    mounting = Mounting(0.25, -1.0, 0.75, upside_down)
    beams = used([1.0, 2.0, 4.0], angle_increment=increment, mounting=mounting)
    for i, reading in enumerate((1.0, 2.0, 4.0)):
        bearing = -0.5 + i * increment
        end = complex(0.25, -1.0) + cmath.rect(reading, mounting.yaw + (-bearing if upside_down else bearing))
        assert beams.ends[i] == pytest.approx([end.real, end.imag], abs=1e-12)


def test_the_motion_during_a_scan_is_taken_out_where_that_is_wanted() -> None:
    """The laser of each beam stands where the base was then, and the error is that share of what the bounds say but for the scan's part."""
    motion = MotionBounds(ErrorBound(0.02, 0.1, 0.2, 0.01, 9.0), ErrorBound(0.001, 0.01, 0.03, 0.0, 9.0))
    config = LocalizerConfig(bounds=Bounds(0.0, 0.0, 0.0, motion), deskew=True)
    scan = {"mounting": Mounting(0.5, 0.25, 0.3), "sweep": swept(Pose(0.3, -0.4, 0.2))}
    ranges = [1.0, NAN, 2.0, 1.5, 3.0]
    beams = used(ranges, config, **scan)
    for i, number in enumerate(beams.numbers.tolist()):
        share = number / 4
        turned = cmath.exp(1j * share * 0.2)
        start = share * complex(0.3, -0.4) + turned * complex(0.5, 0.25)
        end = start + turned * cmath.rect(ranges[number], 0.3 - 0.5 + 0.25 * number)
        assert beams.ends[i] == pytest.approx([end.real, end.imag], abs=1e-12)
        assert np.ptp(beams.moves[i], axis=0) == pytest.approx([2.0 * share * 0.12, 2.0 * share * 0.12, 2.0 * share * 0.012], abs=1e-12)
    origins, angles = beams.seen(np.array([0.0]))
    assert origins.shape == (4, 9, 2)
    assert np.ptp(angles, axis=1) == pytest.approx(np.ptp(beams.moves[:, :, 2], axis=1))
    still = used(ranges, replace(config, deskew=False), **scan)
    assert not still.moves.any()
    assert still.seen(np.zeros(1))[0].shape == (4, 1, 2)


def test_bearings_are_tried_to_both_ends_of_their_error() -> None:
    beams = used([1.0, 4.0], LocalizerConfig(bounds=Bounds(0.0, 0.02)))
    turns = beams.turns(0.03)
    assert sorted(turns.tolist()) == pytest.approx([-1.0, -2 / 3, -1 / 3, 0.0, 1 / 3, 2 / 3, 1.0])
    assert turns[0] == 0.0
    _, angles = beams.seen(turns)
    assert angles[0] == pytest.approx(beams.bearings[0] + 0.02 * turns)
    assert used([1.0], LocalizerConfig(bounds=Bounds(0.0, 0.0))).turns(0.1).tolist() == [0.0]


def test_no_beams() -> None:
    beams = used([NAN, INF], LocalizerConfig(bounds=Bounds(0.1, 0.1), deskew=True))
    assert len(beams) == 0
    assert beams.ends.shape == (0, 2)


def test_points_are_seen_from_each_pose() -> None:
    poses = np.array([[1.0, 2.0, 0.5 * math.pi], [0.0, 0.0, math.pi]])
    at, heading = in_grid(poses, np.array([[[1.0, 0.0], [0.0, 1.0]]] * 2), np.array([[0.25, 0.5]] * 2))
    assert at == pytest.approx(np.array([[[1.0, 3.0], [0.0, 2.0]], [[-1.0, 0.0], [0.0, -1.0]]]))
    assert heading == pytest.approx(np.array([[0.25, 0.5]]) + poses[:, 2:])
