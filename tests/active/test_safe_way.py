import math
from dataclasses import replace

import numpy as np
import pytest

from ial.active.clearance_field import ClearanceField
from ial.active.safe_way import Distances, safe_ways
from ial.contractors.boxes import Boxes
from ial.errors import ConfigError
from ial.pose import Pose
from tests.active.scenes import CLEARANCE_M, LONGEST_S, MOTION, RADIUS_M, distance_to_walls, room

GRID = room()
FIELD = ClearanceField.of(GRID, CLEARANCE_M)
KEPT = Distances(RADIUS_M, CLEARANCE_M)


def some_poses(random: np.random.Generator) -> np.ndarray:
    """Poses with clearance."""
    found = []
    while len(found) < 3:
        x, y, theta = random.uniform([0.4, 0.4, -3.0], [5.6, 3.6, 3.0]).tolist()
        if distance_to_walls(GRID, x, y) >= CLEARANCE_M + 0.12:
            found.append((x, y, theta))
    return np.array(found)


@pytest.mark.parametrize("seed", range(6))
def test_whatever_pose_is_true_and_however_it_errs_it_keeps_its_distances(seed: int) -> None:
    random = np.random.default_rng(seed)
    turns = random.uniform(-math.pi, math.pi, 6)
    boxes = Boxes.around(some_poses(random), [0.05, 0.05, 0.02])
    ways = safe_ways(boxes, turns, 1.0, FIELD, KEPT, MOTION, LONGEST_S)
    assert (ways > 0.0).any()
    for turn, way in zip(turns.tolist(), ways.tolist(), strict=True):
        if way < 0.0:
            continue
        told = MOTION.enclose(Pose(way * math.cos(turn), way * math.sin(turn), turn), LONGEST_S)
        half = 0.5 * (told.upper - told.lower)[:2]
        for row in range(len(boxes)):
            for _ in range(30):
                x, y, theta = (
                    random.choice([boxes.lower[row], boxes.upper[row]])
                    if random.random() < 0.3
                    else random.uniform(boxes.lower[row], boxes.upper[row])
                )
                if distance_to_walls(GRID, x, y) < CLEARANCE_M:
                    continue  # it cannot be there
                error = half * random.choice([-1.0, 1.0], 2)
                for part in np.linspace(0.0, 1.0, 12).tolist():
                    ahead, aside = part * way * math.cos(turn) + part * error[0], part * way * math.sin(turn) + part * error[1]
                    at = (x + math.cos(theta) * ahead - math.sin(theta) * aside, y + math.sin(theta) * ahead + math.cos(theta) * aside)
                    assert distance_to_walls(GRID, *at) >= (CLEARANCE_M if part == 1.0 else RADIUS_M)


def test_a_way_is_nearly_as_long_as_it_can_be() -> None:
    at = Boxes.around([(1.0, 1.0, 0.0)], [0.0, 0.0, 0.0])
    (way,) = safe_ways(at, [0.0], 10.0, FIELD, KEPT, MOTION, LONGEST_S).tolist()
    assert 5.95 - 1.0 - CLEARANCE_M - 0.35 < way < 5.95 - 1.0 - CLEARANCE_M


def test_of_several_poses_the_nearest_to_a_wall_decides() -> None:
    one, other = Boxes.around([(1.0, 1.0, 0.0)], [0.01] * 3), Boxes.around([(3.0, 1.0, 0.0)], [0.01] * 3)
    ways = [safe_ways(each, [0.0, 1.0], 10.0, FIELD, KEPT, MOTION, LONGEST_S) for each in (one, other, Boxes.concatenate([one, other]))]
    assert (ways[2] <= np.minimum(ways[0], ways[1])).all()


@pytest.mark.parametrize("seed", range(4))
def test_from_beside_a_wall_too_it_keeps_its_distances_and_can_leave(seed: int) -> None:
    random = np.random.default_rng(seed)
    skids = replace(MOTION, translation=replace(MOTION.translation, per_radian=0.02))
    boxes = Boxes.around([(0.39, 2.0, math.pi)], [0.03, 0.03, 0.02])  # the wall ends at 0.05, so most of this is too near to it
    turns = np.array([math.pi, 0.8 * math.pi, 0.6 * math.pi, math.pi / 2, 0.0])
    ways = safe_ways(boxes, turns, 0.8, FIELD, KEPT, skids, LONGEST_S)
    assert ways[0] > 0.5
    assert ways[-1] == -1.0
    for turn, way in zip(turns.tolist(), ways.tolist(), strict=True):
        told = skids.enclose(Pose(way * math.cos(turn), way * math.sin(turn), turn), LONGEST_S)
        half = 0.5 * (told.upper - told.lower)[:2]
        for _ in range(300 if way > 0.0 else 0):
            x, y, theta = random.uniform(boxes.lower[0], boxes.upper[0])
            if distance_to_walls(GRID, x, y) < CLEARANCE_M:
                continue
            error = half * random.choice([-1.0, 1.0], 2)
            for part in np.linspace(0.0, 1.0, 12).tolist():
                ahead, aside = part * way * math.cos(turn) + error[0], part * way * math.sin(turn) + error[1]
                at = (x + math.cos(theta) * ahead - math.sin(theta) * aside, y + math.sin(theta) * ahead + math.cos(theta) * aside)
                assert distance_to_walls(GRID, *at) >= (CLEARANCE_M if part == 1.0 else RADIUS_M)


def test_a_way_that_passes_too_near_to_something_ends_before_it_however_free_its_end_is() -> None:
    beside, past = Boxes.around([(2.4, 1.36, 0.0)], [0.0] * 3), Boxes.around([(2.4, 0.9, 0.0)], [0.0] * 3)  # a pillar begins at 3.0, 1.5
    assert safe_ways(beside, [0.0], 2.0, FIELD, KEPT, MOTION, LONGEST_S)[0] < 0.5
    assert safe_ways(past, [0.0], 2.0, FIELD, KEPT, MOTION, LONGEST_S)[0] == 2.0


def test_a_way_with_a_limit_ends_where_a_robot_may_stop() -> None:
    """Beside a pillar it has its radius and not its clearance: it may pass there, and may not be stopped there."""
    beside, ahead = Boxes.around([(2.4, 1.2, 0.0)], [0.0] * 3), [0.0, 0.0, 0.0]
    limits = np.array([math.inf, 0.9, -0.1])  # the pillar is 0.6 to 1.1 m on
    whole, cut, none = safe_ways(beside, ahead, 2.0, FIELD, KEPT, MOTION, LONGEST_S, limits).tolist()
    assert (whole, none) == (2.0, -1.0)
    assert 0.0 < cut < 0.6
    assert safe_ways(beside, [0.0], cut, FIELD, KEPT, MOTION, LONGEST_S)[0] > cut - 0.02


def test_among_very_many_poses_one_decides() -> None:
    many, one = Boxes.around([(3.0, 1.0, 0.0)] * 300, [0.01] * 3), Boxes.around([(5.0, 1.0, 0.0)], [0.01] * 3)
    alone = safe_ways(one, [0.0], 2.0, FIELD, KEPT, MOTION, LONGEST_S)
    assert alone[0] < 0.6 < safe_ways(many, [0.0], 2.0, FIELD, KEPT, MOTION, LONGEST_S)[0]
    for boxes in ([one, many], [many, one]):
        assert safe_ways(Boxes.concatenate(boxes), [0.0], 2.0, FIELD, KEPT, MOTION, LONGEST_S) == alone


def test_a_pose_without_clearance_is_impossible_and_in_nobodys_way() -> None:
    near, far = Boxes.around([(0.2, 2.0, 0.0)], [0.01] * 3), Boxes.around([(3.0, 1.0, 0.0)], [0.01] * 3)
    assert safe_ways(Boxes.concatenate([near, far]), [0.0], 0.5, FIELD, KEPT, MOTION, LONGEST_S) == safe_ways(
        far, [0.0], 0.5, FIELD, KEPT, MOTION, LONGEST_S
    )


def test_where_something_has_stopped_it_a_pose_that_is_nearer_to_a_wall_counts() -> None:
    near, stopped = Boxes.around([(0.35, 2.0, 0.0)], [0.01] * 3), Distances(RADIUS_M, CLEARANCE_M, RADIUS_M)
    ahead, aside = safe_ways(near, [0.0, 0.5 * math.pi], 0.5, FIELD, KEPT, MOTION, LONGEST_S).tolist()
    assert (ahead, aside) == (0.5, 0.5), "nothing is there"
    ahead, aside = safe_ways(near, [0.0, 0.5 * math.pi], 0.5, FIELD, stopped, MOTION, LONGEST_S).tolist()
    assert ahead > 0.3
    assert aside == -1.0, "along the wall it has not its clearance"


@pytest.mark.parametrize(("radius", "clearance"), [(-0.1, 0.2), (0.3, 0.2), (math.nan, 0.2), (0.1, math.inf)])
def test_distances_that_cannot_be_meant(radius: float, clearance: float) -> None:
    with pytest.raises(ConfigError, match=r"radius of the robot is|clearance is"):
        Distances(radius, clearance)
