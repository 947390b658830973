import math

import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.maps.grids.alike_plans import alike_plan
from ial.pose import Pose
from tests.active.closed_plans import CLOSED_PLANS, cells_plan
from tests.active.judged_views import JudgedRun, judged_run
from tests.active.scenes import CLEARANCE_M, LIDAR, RADIUS_M
from tests.active.views_oracle import Verdict, ViewsOracle

FIRST, SECOND, THIRD = (Pose(x, 1.0, 0.3) for x in (1.2, 7.0, 14.6))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("plan", "seed", "verdict", "end"),
    [
        ("cells", 0, "localizable", "localized"),
        ("cells", 1, "not", "exhausted"),
        ("slits", 2, "not", "exhausted"),
        ("rooms", 0, "localizable", "localized"),
        ("rooms", 1, "localizable", "localized"),
        ("ring", 0, "localizable", "symmetric"),
    ],
)
def test_the_planner_ends_as_the_oracle_says(plan: str, seed: int, verdict: str, end: str) -> None:
    grid = CLOSED_PLANS[plan]() if plan in CLOSED_PLANS else alike_plan(plan)
    run = judged_run(grid, seed)
    assert (run.verdict, run.end) == (verdict, end)
    assert not run.disagrees


@pytest.mark.parametrize(
    ("poses", "verdict"),
    [
        ([FIRST], "localizable"),
        ([FIRST, Pose(FIRST.x + 0.3, FIRST.y, FIRST.theta)], "localizable"),
        ([FIRST, THIRD], "localizable"),
        ([FIRST, SECOND], "not"),
        ([FIRST, SECOND, THIRD], "not"),
    ],
)
def test_a_copy_is_told_apart_from_nowhere(poses: list[Pose], verdict: Verdict) -> None:
    grid = cells_plan()
    oracle = ViewsOracle(grid, LIDAR, RADIUS_M, CLEARANCE_M, allowed=4, real=2)
    possible = Boxes.around(np.array([(each.x, each.y, each.theta) for each in poses]), [1e-6] * 3)
    assert oracle.judge(FIRST, possible) == verdict


def test_what_is_neither_certain_nor_impossible_is_undecided() -> None:
    oracle = ViewsOracle(cells_plan(), LIDAR, RADIUS_M, CLEARANCE_M, allowed=4, real=2)
    beside = Pose(SECOND.x + 0.02, SECOND.y, SECOND.theta)  # not by whole cells
    possible = Boxes.around(np.array([(each.x, each.y, each.theta) for each in (FIRST, beside)]), [1e-6] * 3)
    assert oracle.judge(FIRST, possible) == "undecided"


def test_the_oracle_reads_what_there_is() -> None:
    oracle = ViewsOracle(cells_plan(), LIDAR, RADIUS_M, CLEARANCE_M, allowed=4, real=2)
    readings = oracle._readings(np.array([(1.2, 1.2, 0.0), (1.2, 1.2, 0.5 * math.pi)]))
    bearings = LIDAR.angle_min + LIDAR.angle_increment * np.arange(LIDAR.beams)
    behind, right = (int(np.argmin(np.abs(bearings - angle))) for angle in (-math.pi, -0.5 * math.pi))
    assert readings[0, [behind, right]] == pytest.approx([1.0, 1.0], abs=0.04)
    assert readings[1, right] == 4.0, "nothing so near"


@pytest.mark.parametrize(
    ("verdict", "end", "disagrees"),
    [
        ("localizable", "localized", False),
        ("localizable", "symmetric", False),
        ("localizable", "exhausted", True),
        ("not", "exhausted", False),
        ("not", "localized", True),
        ("undecided", "exhausted", False),
        ("undecided", "gave up", True),
    ],
)
def test_what_disagrees(verdict: Verdict, end: str, disagrees: bool) -> None:
    assert JudgedRun(verdict, end, 3).disagrees == disagrees
