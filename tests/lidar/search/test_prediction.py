import math

import mpmath
import numpy as np
import pytest

from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.intervals.trigonometric import PI_UPPER
from ial.contractors.threads import set_threads
from ial.datasets.motion import Motion
from ial.lidar.search.prediction import in_rows, move
from tests.cases import cases

mpmath.mp.prec = 300
TURN = 2 * mpmath.pi


def moved(pose: FloatArray, motion: FloatArray) -> list[mpmath.mpf]:
    """Return the moved pose with 90 digits: its error is far below the distance of neighbouring doubles."""
    x, y, theta, dx, dy, turn = (mpmath.mpf(float(value)) for value in (*pose, *motion))
    c, s = mpmath.cos(theta), mpmath.sin(theta)
    return [x + dx * c - dy * s, y + dx * s + dy * c, theta + turn]


def holds(lower: FloatArray, upper: FloatArray, pose: list[mpmath.mpf]) -> bool:
    if not all(float(low) <= at <= float(high) for low, at, high in zip(lower[:2], pose[:2], upper[:2], strict=True)):
        return False
    low, high = mpmath.mpf(float(lower[2])), mpmath.mpf(float(upper[2]))
    return high - low >= TURN or any(low <= pose[2] + turns * TURN <= high for turns in range(-3, 4))


def random_boxes(random: np.random.Generator, rows: int) -> Boxes:
    lower = np.column_stack([random.uniform(-100.0, 100.0, (rows, 2)), random.uniform(-math.pi, math.pi, rows)])
    special = random.choice([-math.pi, -0.5 * math.pi, 0.0, 0.5 * math.pi, math.pi, -PI_UPPER, PI_UPPER], rows)
    lower[:, 2] = np.where(random.random(rows) < 0.3, special, lower[:, 2])
    widths = random.choice([0.0, 1e-15, 1e-3, 0.1, 2.0, 6.0], (rows, 3))
    boxes = Boxes(lower, lower + widths)
    full = random.random(rows) < 0.05
    boxes.lower[full, 2], boxes.upper[full, 2] = -PI_UPPER, PI_UPPER
    return boxes


def random_motion(random: np.random.Generator) -> Motion:
    lower = random.uniform(-1.0, 1.0, 3) * random.choice([0.0, 1e-9, 1.0, 4.0], 3)
    return Motion(lower, lower + random.choice([0.0, 1e-15, 0.1, 3.0, 6.5], 3))


def between(lower: FloatArray, upper: FloatArray, random: np.random.Generator) -> FloatArray:
    share = random.choice([0.0, 1.0, random.random()], 3)
    return np.clip(lower + share * (upper - lower), lower, upper)


def test_a_moved_pose_lies_in_the_moved_box() -> None:
    for seed in range(cases(60, 3)):
        random = np.random.default_rng(seed)
        boxes, motion = random_boxes(random, 20), random_motion(random)
        after = move(boxes, motion)
        assert len(after) == len(boxes)
        for row in range(len(boxes)):
            for _ in range(4):
                pose = between(boxes.lower[row], boxes.upper[row], random)
                step = between(motion.lower, motion.upper, random)
                assert holds(after.lower[row], after.upper[row], moved(pose, step)), (seed, row, pose, step)


def test_headings_keep_the_form_of_angles() -> None:
    for seed in range(cases(60, 3)):
        random = np.random.default_rng(seed)
        after = move(random_boxes(random, 50), random_motion(random))
        assert (np.abs(after.lower[:, 2]) <= PI_UPPER).all()
        wide = after.width()[:, 2] >= 2.0 * math.pi
        assert (after.lower[wide, 2] == -PI_UPPER).all()
        assert (after.upper[wide, 2] == PI_UPPER).all()
        assert (after.lower <= after.upper).all()


def test_the_moved_box_is_hardly_larger_than_the_poses_in_it() -> None:
    after = move(
        Boxes.of([(1.0, 1.0), (2.0, 2.0), (0.5 * math.pi, 0.5 * math.pi)]), Motion(np.array([3.0, 1.0, 2.0]), np.array([3.0, 1.0, 2.0]))
    )
    assert after.width().max() < 1e-14
    assert after.lower[0] == pytest.approx([0.0, 5.0, 0.5 * math.pi + 2.0 - 2.0 * math.pi], abs=1e-14)


def test_standing_still_moves_nothing_by_more_than_rounding() -> None:
    boxes = random_boxes(np.random.default_rng(2), 50)
    after = move(boxes, Motion.identity())
    assert (after.lower <= boxes.lower).all()
    assert (after.upper >= boxes.upper).all()
    assert np.abs(after.lower - boxes.lower).max() < 1e-12
    assert np.abs(after.upper - boxes.upper).max() < 1e-12


def test_an_unknown_motion_leads_everywhere() -> None:
    after = move(random_boxes(np.random.default_rng(3), 10), Motion.unknown())
    assert (after.lower[:, :2] == -np.inf).all()
    assert (after.upper[:, :2] == np.inf).all()
    assert (after.lower[:, 2] == -PI_UPPER).all()
    assert (after.upper[:, 2] == PI_UPPER).all()


def test_no_boxes_stay_no_boxes() -> None:
    assert move(Boxes.none(3), Motion.identity()).lower.shape == (0, 3)


@pytest.mark.many
def test_the_number_of_threads_changes_no_bit() -> None:
    boxes, motion = random_boxes(np.random.default_rng(4), cases(5000, 1000)), random_motion(np.random.default_rng(5))
    outcomes = []
    for threads in (1, 2, 3):
        set_threads(threads)
        after = move(boxes, motion)
        outcomes.append((after.lower.tobytes(), after.upper.tobytes()))
    set_threads(None)
    assert outcomes[0] == outcomes[1] == outcomes[2]


def test_boxes_that_follow_each_other_become_one_row_and_none_is_lost() -> None:
    random = np.random.default_rng(5)
    for _ in range(100):
        edges = np.round(np.cumsum(random.uniform(0.1, 1.0, 9)), 2)
        rows = []
        for y in (0.0, 1.0):
            rows += [[(edges[at], edges[at + 1]), (y, y + 1.0), (0.0, 0.5)] for at in range(8) if random.random() < 0.7]
        boxes = Boxes.of(*rows, [(7.0, 9.0), (3.0, 4.0), (0.0, 0.5)])
        merged = in_rows(boxes)
        assert len(merged) <= len(boxes)
        for lower, upper in zip(boxes.lower, boxes.upper, strict=True):
            assert ((merged.lower <= lower) & (upper <= merged.upper)).all(axis=1).any()
        assert merged.volume() == pytest.approx(boxes.volume())
