from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.datasets.motion import Motion
from ial.datasets.odometry import Odometry
from ial.datasets.recording import Step
from ial.datasets.scan import LaserScan, Mounting
from ial.datasets.trajectory import Trajectory
from ial.lidar.configuration.config import Bounds, LocalizerConfig
from ial.lidar.estimate import Estimate
from ial.lidar.hypothesis import find_hypotheses
from ial.lidar.localizer import Localizer
from ial.lidar.pose_set import PoseSet
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid
from ial.maps.grids.ray_casting import cast_rays
from ial.pose import Pose
from ial.study.containment import Containment

ORIGIN = Pose(10.0, -3.0, 0.5)
CELLS = np.full((30, 40), FREE, dtype=np.uint8)
CELLS[[0, -1], :] = CELLS[:, [0, -1]] = OCCUPIED
GRID = OccupancyGrid(CELLS, 0.1, ORIGIN)
LOCALIZER = Localizer(GRID, config=LocalizerConfig(bounds=Bounds(0.02, 0.0, 0.01), outliers=2))
PATH = [Pose(1.0 + 0.1 * i, 1.5, 0.2) for i in range(6)]  # in the grid's frame
MOUNTING = Mounting(0.2, -0.1, 0.3)
ANGLES = np.linspace(-3.0, 3.0, 41)


def scan(at: Pose, spoiled: int = 0, mounting: Mounting = MOUNTING) -> LaserScan:
    laser = at @ mounting.pose
    ranges = cast_rays(CELLS == OCCUPIED, 0.1, laser.x, laser.y, laser.theta + ANGLES) + 0.001
    ranges[:spoiled] *= 0.5
    return LaserScan(0, ranges, -3.0, float(ANGLES[1] - ANGLES[0]), mounting=mounting)


def around(motion: Pose, room: float = 0.01) -> Motion:
    at = np.array([motion.x, motion.y, motion.theta])
    return Motion(at - room, at + room)


def step(index: int, **changes: Any) -> Step:
    motion = around(PATH[index - 1].inverse() @ PATH[index]) if index else None
    return replace(Step(index, stamp(index), motion, scan(PATH[index]), Odometry.of(Pose())), **changes)


def stamp(index: int) -> int:
    return 10**10 * (index + 1)  # so far apart that nothing is interpolated


def answer(index: int, *, contained: bool = True, localized: bool = False) -> Estimate:
    at = PATH[index]
    x = at.x if contained else at.x + 1.0
    poses = PoseSet(Boxes.of([(x - 0.1, x + 0.1), (at.y - 0.1, at.y + 0.1), (at.theta - 0.1, at.theta + 0.1)]))
    hypotheses = find_hypotheses(poses, GRID)
    return Estimate(
        stamp(index),
        "localized" if localized else "ambiguous",
        hypotheses,
        hypotheses[0].centre if localized else None,
        poses,
        41,
        2,
        False,
        "",
        0.0,
    )


def truth(count: int = 6, *, without: tuple[int, ...] = ()) -> Trajectory:
    return Trajectory.of((stamp(i), ORIGIN @ PATH[i]) for i in range(count) if i not in without)


def summary(*pairs: tuple[Step, Estimate], known: Trajectory | None = None, **options: Any) -> dict[str, Any]:
    counted = Containment(options.pop("localizer", LOCALIZER), known or truth(), **options)
    for each, estimate in pairs:
        counted.add(each, estimate)
    return counted.summary() | {"misses": counted.misses}


def broken(**counts: int) -> dict[str, int]:
    return {"beams": 0, "motion": 0, "domain": 0, "lost_before": 0} | counts


def test_where_all_holds_all_counts() -> None:
    shares = summary(*[(step(i), answer(i, localized=i > 0)) for i in range(4)])
    assert shares["median_position_error_m"] == pytest.approx(0.0, abs=1e-9)
    del shares["median_position_error_m"]
    assert shares == {
        "scans_with_reference": 4,
        "contained": 1.0,
        "contained_hull": 1.0,
        "assumptions_hold": 1.0,
        "scans_where_assumptions_hold": 4,
        "contained_when_assumptions_hold": 1.0,
        "broken": broken(),
        "truth_frame": "base",
        "misses": [],
    }


def test_nothing_added_gives_no_shares() -> None:
    shares = summary()
    assert shares["scans_with_reference"] == shares["scans_where_assumptions_hold"] == 0
    for share in ("contained", "contained_hull", "assumptions_hold", "contained_when_assumptions_hold", "median_position_error_m"):
        assert shares[share] is None


def test_no_scan_at_which_the_assumptions_hold_gives_no_share() -> None:
    shares = summary((step(0, scan=scan(PATH[0], spoiled=10)), answer(0)))
    assert shares["contained"] == 1.0
    assert shares["contained_when_assumptions_hold"] is None
    assert shares["assumptions_hold"] == 0.0


@pytest.mark.parametrize(("spoiled", "holds"), [(0, 2), (2, 2), (3, 1), (20, 1)])
def test_more_bad_beams_than_allowed_break_the_beams(spoiled: int, holds: int) -> None:
    shares = summary((step(0), answer(0)), (step(1, scan=scan(PATH[1], spoiled)), answer(1, contained=False)))
    assert shares["scans_where_assumptions_hold"] == holds
    assert shares["broken"] == broken(beams=2 - holds)
    assert shares["contained_when_assumptions_hold"] == 1.0 / holds
    assert shares["contained"] == shares["contained_hull"] == 0.5


def test_a_motion_outside_its_interval_breaks_the_motion() -> None:
    false = around(Pose(0.3, 0.0, 0.0))
    shares = summary((step(0), answer(0)), (step(1, motion=false), answer(1)), (step(2), answer(2)))
    assert shares["broken"] == broken(motion=1)
    assert shares["scans_where_assumptions_hold"] == 2  # the reference was contained all the same, so the next scan holds
    assert summary((step(0), answer(0)), (step(1, motion=false), answer(1)), static=True)["broken"] == broken()


def test_a_reference_in_a_wall_breaks_the_domain() -> None:
    wall = Pose(0.05, 1.5, 0.2)
    known = Trajectory.of([(stamp(0), ORIGIN @ wall)])
    shares = summary((step(0, scan=LaserScan(0, np.full(5, np.inf), 0.0, 0.1)), answer(0)), known=known)
    assert shares["broken"] == broken(domain=1)
    assert shares["misses"] == [{"index": 0, "status": "ambiguous", "broken": ["domain"]}]


def test_one_scan_may_break_several() -> None:
    shares = summary((step(0), answer(0)), (step(1, scan=scan(PATH[1], 10), motion=around(Pose(0.3, 0.0, 0.0))), answer(1)))
    assert shares["broken"] == broken(beams=1, motion=1)


def test_after_a_miss_nothing_holds_until_the_reference_is_contained_again() -> None:
    pairs = [(step(i), answer(i, contained=i not in (1, 2))) for i in range(5)]
    shares = summary(*pairs)
    assert shares["broken"] == broken(lost_before=2)
    assert shares["scans_where_assumptions_hold"] == 3
    assert shares["contained"] == 0.6
    assert shares["contained_when_assumptions_hold"] == pytest.approx(2 / 3)
    assert shares["misses"] == [
        {"index": 1, "status": "ambiguous", "broken": []},  # nothing to blame: the guarantee is broken
        {"index": 2, "status": "ambiguous", "broken": ["lost_before"]},
    ]
    assert summary(*pairs, static=True)["broken"] == broken()


def test_a_missing_reference_breaks_the_chain_once() -> None:
    pairs = [(step(i), answer(i)) for i in range(4)]
    shares = summary(*pairs, known=truth(without=(1,)))
    assert shares["scans_with_reference"] == 3
    assert shares["broken"] == broken(lost_before=1)
    first = summary(*pairs, known=truth(without=(0,)))
    assert first["broken"] == broken(lost_before=1)
    assert summary(*pairs, known=truth(without=(1,)), static=True)["scans_where_assumptions_hold"] == 3


def test_a_start_without_the_reference_is_an_assumption_that_does_not_hold() -> None:
    for at, holds in ((PATH[0], 1), (Pose(3.0, 0.5, 2.0), 0)):
        there = ORIGIN @ at
        region = Boxes.of([(there.x - 0.1, there.x + 0.1), (there.y - 0.1, there.y + 0.1), (there.theta - 0.1, there.theta + 0.1)])
        localizer = Localizer(GRID, config=LOCALIZER.config, initial=region)
        shares = summary((step(0), answer(0, contained=holds == 1)), localizer=localizer)
        assert shares["scans_where_assumptions_hold"] == holds
        assert shares["broken"] == broken(lost_before=1 - holds)


def test_a_start_that_the_search_has_lost_is_no_broken_assumption(monkeypatch: pytest.MonkeyPatch) -> None:
    there = ORIGIN @ PATH[0]
    region = Boxes.of([(there.x - 0.1, there.x + 0.1), (there.y - 0.1, there.y + 0.1), (there.theta - 7.0, there.theta - 6.0)])
    localizer = Localizer(GRID, config=LOCALIZER.config, initial=region)
    monkeypatch.setattr(localizer, "_start", PoseSet(Boxes.none(3)))
    shares = summary((step(0), answer(0, contained=False)), localizer=localizer)
    assert (shares["scans_where_assumptions_hold"], shares["contained_when_assumptions_hold"]) == (1, 0.0)


def test_a_reference_of_the_laser_is_taken_back_to_the_base() -> None:
    lasers = Trajectory.of((stamp(i), ORIGIN @ PATH[i] @ MOUNTING.pose) for i in range(3))
    pairs = [(step(i), answer(i, localized=True)) for i in range(3)]
    right = summary(*pairs, known=lasers, frame="laser")
    assert (right["contained"], right["contained_when_assumptions_hold"], right["truth_frame"]) == (1.0, 1.0, "laser")
    assert right["median_position_error_m"] == pytest.approx(0.0, abs=1e-9)
    wrong = summary(*pairs, known=lasers)
    assert wrong["contained"] == 0.0
    assert wrong["broken"]["beams"] == 3
    assert wrong["median_position_error_m"] == pytest.approx(np.hypot(0.2, 0.1))


def test_the_hull_may_hold_what_no_box_holds() -> None:
    at = PATH[0]
    parts = [
        [(at.x + dx, at.x + dx + 0.1), (at.y + dy, at.y + dy + 0.1), (at.theta - 0.1, at.theta + 0.1)]
        for dx, dy in ((-0.15, 0.05), (-0.05, 0.02), (0.05, -0.08))
    ]
    poses = PoseSet(Boxes.of(*parts))
    shares = summary((step(0), replace(answer(0), poses=poses, hypotheses=find_hypotheses(poses, GRID))))
    assert (shares["contained"], shares["contained_hull"]) == (0.0, 1.0)
