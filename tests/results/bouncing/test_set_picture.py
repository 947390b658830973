from fractions import Fraction
from itertools import islice
from pathlib import Path

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.patches import Circle

from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.filters.goal import Goal
from ial.bouncing.filters.piece_filter import PieceFilter
from ial.bouncing.rays.piece_map import PieceMap
from ial.bouncing.rays.real_robot import RealPose, RealRobot
from ial.errors import StreamError
from ial.results.bouncing.set_picture import draw_sets, moments, set_page
from ial.results.palette import TRUTH
from tests.bouncing.judged_runs import WORLDS
from tests.results.bouncing.drawn_filter import pixels, read

HALL, ROBOT = WORLDS["hall"], (Fraction(100), Fraction(1, 4), ExecutionBounds(Fraction(2), Fraction(1, 50), 1))


def made(radius: Fraction) -> PieceFilter:
    pieces = PieceMap.of(HALL, *ROBOT, Fraction(1, 2), 36, radius)
    return PieceFilter(pieces, "hall", *ROBOT, Goal(width=Fraction(7)), radius)


def run(radius: Fraction, count: int = 260) -> list[RealPose]:
    return list(islice(RealRobot(HALL, ROBOT[0], ROBOT[1], radius, ROBOT[2], seed=6).run(), count))


def drawn_parts(axes: Axes) -> np.ndarray:
    (lines,) = (each for each in axes.collections if isinstance(each, LineCollection))
    return np.array(lines.get_segments())


def distance(segments: np.ndarray, x: float, y: float) -> float:
    a, way = segments[:, 0], segments[:, 1] - segments[:, 0]
    part = np.clip(((np.array([x, y]) - a) * way).sum(axis=1) / np.square(way).sum(axis=1), 0.0, 1.0)
    return float(np.linalg.norm(a + part[:, None] * way - [x, y], axis=1).min())


def test_moments_double_and_end_with_the_last_bump() -> None:
    assert moments(1) == [1]
    assert moments(8) == [1, 2, 4, 8]
    assert moments(29) == [1, 2, 4, 8, 16, 29]


@pytest.mark.parametrize("radius", ["0", "1/5"])
def test_each_panel_shows_the_parts_that_are_left_and_the_true_robot_on_one_of_them(radius: str) -> None:
    filter_, poses = made(Fraction(radius)), run(Fraction(radius))
    page = set_page(filter_, HALL, filter_.after_bumps(pose.observation for pose in poses), poses)
    bumps = [at for at, pose in enumerate(poses) if pose.observation]
    assert len(page.panels) == len(moments(len(bumps))) > 4
    model, count = filter_.model, int(filter_.map.parts.sum())
    states = model.universe()
    left = []
    for pose in poses:
        states = model.step(states, None, pose.observation)
        left += [states] if pose.observation else []
    for axes, bump in zip(page.panels, moments(len(bumps)), strict=True):
        expected, pose = left[bump - 1], poses[bumps[bump - 1]]
        segments = drawn_parts(axes)
        assert len(segments) == len(set((expected.pieces % count).tolist()))
        assert f"bump {bump}: " in axes.get_title(loc="left")
        assert f"{len(expected)} of {len(filter_.map)} pieces" in axes.get_title(loc="left")
        assert distance(segments, float(pose.x_m), float(pose.y_m)) < filter_.map.walls.bulge.max() + 1e-6
        (way,) = (line for line in axes.lines if line.get_label() == "truth")
        assert np.array_equal(way.get_xydata(), [(float(each.x_m), float(each.y_m)) for each in poses[: bumps[bump - 1] + 1]])
        circles = [each.get_radius() for each in axes.patches if isinstance(each, Circle)]
        assert circles == ([float(Fraction(radius))] if Fraction(radius) else [])
    assert len(drawn_parts(page.panels[-1])) < len(drawn_parts(page.panels[0]))
    told = ["localized" in axes.get_title(loc="left") for axes in page.panels]
    assert told == [filter_.is_localized(left[bump - 1]) for bump in moments(len(bumps))]
    assert any(told)
    assert not all(told)


def test_without_a_truth_there_is_none_in_the_picture(tmp_path: Path) -> None:
    filter_, poses = made(Fraction(0)), run(Fraction(0))
    sets = filter_.after_bumps(pose.observation for pose in poses)
    draw_sets(tmp_path / "a.png", filter_, HALL, sets)
    assert pixels(read(tmp_path / "a.png"), TRUTH) == 0
    assert pixels(read(tmp_path / "a.png"), "#4a5058") > 1000  # outside of the environment
    draw_sets(tmp_path / "a.png", filter_, HALL, sets, poses)
    assert pixels(read(tmp_path / "a.png"), TRUTH) > 50


def test_a_robot_that_is_elsewhere() -> None:
    filter_ = made(Fraction(0))
    page = set_page(filter_, HALL, filter_.after_bumps([1, 0, 0, *[0] * 60, 1]))
    assert page.panels[-1].get_title(loc="left") == "bump 2: rejected"
    assert len(drawn_parts(page.panels[-1])) == 0


def test_what_cannot_be_drawn() -> None:
    with pytest.raises(StreamError, match="has not bumped yet"):
        set_page(made(Fraction(0)), HALL, [])
    filter_ = made(Fraction(0))
    with pytest.raises(StreamError, match="and the robot observed 1; give the truth of the same run"):
        set_page(filter_, HALL, filter_.after_bumps([0, 1]), run(Fraction(0)))
