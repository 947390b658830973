import itertools
import math
from collections.abc import Callable, Iterator

import numpy as np
import pytest

from ial.contractors import paver
from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.kernels import kernel
from ial.contractors.paver import Paving, pave
from ial.contractors.threads import run, set_threads

SEEDS = range(40)
UNLIMITED = 10**6
MARGIN = 1e-9  # a box is emptied only if it is farther from the shape than this, which covers the rounding of the test


@kernel
def ring_misses(start, stop, lower, upper, centre, inner, outer, emptied):  # type: ignore[no-untyped-def]
    for i in range(start, stop):
        near, far = 0.0, 0.0
        for axis in range(2):
            gap = max(lower[i, axis] - centre[axis], centre[axis] - upper[i, axis], 0.0)
            reach = max(upper[i, axis] - centre[axis], centre[axis] - lower[i, axis])
            near += gap * gap
            far += reach * reach
        emptied[i] = near > (outer + MARGIN) ** 2 or (inner > MARGIN and far < (inner - MARGIN) ** 2)


class Ring:
    """The points from `inner` to `outer` away from a centre: a disc if `inner` is 0. It empties boxes and cuts off what sticks out."""

    dimension = 2

    def __init__(self, centre: FloatArray, inner: float, outer: float) -> None:
        self.centre, self.inner, self.outer = centre, inner, outer
        self.batches: list[int] = []

    def contract(self, boxes: Boxes) -> Boxes:
        self.batches.append(len(boxes))
        emptied = np.empty(len(boxes), dtype=np.bool_)
        run(ring_misses, len(boxes), boxes.lower, boxes.upper, self.centre, self.inner, self.outer, emptied, minimum=2)
        reach = self.outer + MARGIN
        return Boxes(np.maximum(boxes.lower, self.centre - reach), np.minimum(boxes.upper, self.centre + reach)).where(~emptied)

    def holds(self, points: FloatArray) -> FloatArray:
        distance = np.hypot(*(points - self.centre).T)
        return (self.inner <= distance) & (distance <= self.outer)


class HalfPlane:
    """The points on one side of a slanted line. It only empties boxes."""

    dimension = 2

    def __init__(self, normal: FloatArray, offset: float) -> None:
        self.normal, self.offset = normal, offset

    def contract(self, boxes: Boxes) -> Boxes:
        least = np.where(self.normal > 0.0, boxes.lower, boxes.upper) @ self.normal
        return boxes.where(least <= self.offset + MARGIN)

    def holds(self, points: FloatArray) -> FloatArray:
        return points @ self.normal <= self.offset


class Nothing:
    """A constraint without solutions."""

    dimension = 2

    def contract(self, boxes: Boxes) -> Boxes:
        return boxes.where(np.zeros(len(boxes), dtype=np.bool_))


def shape(random: np.random.Generator) -> Ring | HalfPlane:
    kind = random.integers(3)
    if kind == 0:
        return HalfPlane(random.normal(size=2), float(random.normal()))
    outer = float(random.uniform(0.1, 2.0))
    return Ring(random.uniform(-2.0, 2.0, 2), float(outer * random.uniform(0.3, 0.99)) if kind == 1 else 0.0, outer)


def start(random: np.random.Generator) -> Boxes:
    """Return one to four boxes, which may overlap; some are flat."""
    lower = random.uniform(-3.0, 1.0, (int(random.integers(1, 5)), 2))
    return Boxes(lower, lower + random.uniform(0.0, 4.0, lower.shape) * (random.random(lower.shape) < 0.9))


def corners(boxes: Boxes) -> FloatArray:
    rows = np.stack([boxes.lower, boxes.upper], axis=-1)
    return np.concatenate([np.stack(each, axis=-1) for each in itertools.product(*np.moveaxis(rows, 1, 0).transpose(0, 2, 1))])


def points_of(boxes: Boxes, random: np.random.Generator) -> FloatArray:
    inside = [boxes.lower + random.random(boxes.lower.shape) * (boxes.upper - boxes.lower) for _ in range(300)]
    return np.concatenate([corners(boxes), *inside])


def covered(boxes: Boxes, points: FloatArray) -> FloatArray:
    inside = (boxes.lower[:, None] <= points) & (points <= boxes.upper[:, None])
    return np.asarray(inside.all(axis=2).any(axis=0))


def assert_covers(paving: Paving, contractor: Ring | HalfPlane, boxes: Boxes, random: np.random.Generator) -> int:
    points = points_of(boxes, random)
    solutions = points[contractor.holds(points)]
    assert covered(paving.boxes, solutions).all()
    return len(solutions)


def as_set(boxes: Boxes) -> set[tuple[float, ...]]:
    return set(map(tuple, np.hstack([boxes.lower, boxes.upper]).tolist()))


@pytest.fixture
def threads() -> Iterator[Callable[[int | None], None]]:
    yield set_threads
    set_threads(None)


def test_corners_are_all_four() -> None:
    assert sorted(map(tuple, corners(Boxes.of([(0, 1), (2, 3)])).tolist())) == [(0, 2), (0, 3), (1, 2), (1, 3)]


def test_every_solution_is_covered_and_every_box_is_small_and_not_excluded() -> None:
    solutions = 0
    for seed in SEEDS:
        random = np.random.default_rng(seed)
        contractor, boxes, precision = shape(random), start(random), random.uniform(0.05, 0.5, 2)
        paving = pave(contractor, boxes, precision, max_boxes=UNLIMITED)
        solutions += assert_covers(paving, contractor, boxes, random)
        assert paving.limited == ""
        assert (paving.boxes.width() <= precision).all()
        assert not paving.boxes.empty.any()
        assert not contractor.contract(paving.boxes).empty.any()
        inside = (boxes.lower[:, None] <= paving.boxes.lower) & (paving.boxes.upper <= boxes.upper[:, None])
        assert inside.all(axis=2).any(axis=0).all()
    assert solutions > 5000


def test_touching_points_of_the_shape_are_covered() -> None:
    # Numbers that doubles hold exactly: the disc touches the box from outside in one point, a corner and a side's middle.
    disc = Ring(np.array([0.25, 0.5]), 0.0, 0.75)
    for box, point in [([(1.0, 2.0), (0.0, 1.0)], (1.0, 0.5)), ([(-2.0, -0.5), (0.5, 3.0)], (-0.5, 0.5))]:
        paving = pave(disc, Boxes.of(box), np.full(2, 1e-3), max_boxes=UNLIMITED)
        assert paving.boxes.contain(point).any()
        assert not paving.boxes.contain((box[0][1], box[1][1])).any()


def test_a_side_is_bisected_only_down_to_its_own_precision() -> None:
    plane = HalfPlane(np.array([0.0, 0.0]), 0.0)
    paving = pave(plane, Boxes.of([(0, 8), (0, 8)]), np.array([8.0, 0.5]), max_boxes=UNLIMITED)
    assert as_set(paving.boxes) == {(0.0, 0.5 * i, 8.0, 0.5 * i + 0.5) for i in range(16)}


def test_the_side_widest_in_units_of_its_precision_is_bisected_first() -> None:
    plane = HalfPlane(np.array([0.0, 0.0]), 0.0)
    paving = pave(plane, Boxes.of([(0, 8), (0, 4)]), np.array([4.0, 1.0]), max_boxes=2)
    assert as_set(paving.boxes) == {(0.0, 0.0, 8.0, 2.0), (0.0, 2.0, 8.0, 4.0)}


@pytest.mark.parametrize("max_boxes", [1, 7, 100])
@pytest.mark.parametrize("batch", [8, 1 << 18])
def test_a_limit_on_boxes_gives_a_coarser_paving_that_covers_and_says_so(max_boxes: int, batch: int) -> None:
    for seed in range(10):
        random = np.random.default_rng(seed)
        boxes, contractor = Boxes.of([(-3, 3), (-3, 3)]), Ring(random.uniform(-1.0, 1.0, 2), 1.0, 1.5)
        free = pave(contractor, boxes, np.full(2, 0.05), max_boxes=UNLIMITED)
        paving = pave(contractor, boxes, np.full(2, 0.05), max_boxes=max_boxes, batch=batch)
        assert paving.limited == "boxes"
        assert len(paving.boxes) <= 2 * max_boxes  # a level at most doubles what was still allowed
        assert paving.boxes.width().max() > 0.05
        assert paving.nodes < free.nodes
        assert paving.boxes.volume() > free.boxes.volume()
        assert assert_covers(paving, contractor, boxes, random) > 10


def test_a_paving_just_within_the_limit_is_not_called_limited() -> None:
    plane = HalfPlane(np.array([0.0, 0.0]), 0.0)
    box, precision = Boxes.of([(0, 8), (0, 8)]), np.full(2, 1.0)
    assert pave(plane, box, precision, max_boxes=64).limited == ""
    assert pave(plane, box, precision, max_boxes=63).limited == "boxes"


def test_a_limit_on_time_gives_a_coarser_paving_that_covers_and_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    now = itertools.count()
    monkeypatch.setattr(paver.time, "monotonic", lambda: float(next(now)))
    random = np.random.default_rng(3)
    boxes, contractor = Boxes.of([(-3, 3), (-3, 3)]), Ring(np.array([0.1, 0.2]), 1.0, 1.5)
    paving = pave(contractor, boxes, np.full(2, 0.01), max_boxes=UNLIMITED, max_seconds=6.5)
    assert paving.limited == "time"
    assert len(contractor.batches) == 6
    assert paving.boxes.width().max() > 0.01
    assert assert_covers(paving, contractor, boxes, random) > 10
    plenty = pave(contractor, boxes, np.full(2, 0.1), max_boxes=UNLIMITED, max_seconds=1e9)
    assert plenty.limited == ""
    assert as_set(plenty.boxes) == as_set(pave(contractor, boxes, np.full(2, 0.1), max_boxes=UNLIMITED).boxes)


def test_the_result_does_not_depend_on_the_number_of_threads(threads: Callable[[int | None], None]) -> None:
    for limit in (300, UNLIMITED):
        found = []
        for count in (1, 2, 3):
            threads(count)
            found.append(pave(Ring(np.array([0.3, 0.1]), 0.5, 1.7), Boxes.of([(-3, 3), (-3, 3)]), np.full(2, 0.03), max_boxes=limit))
        for other in found[1:]:
            assert other.boxes.lower.tobytes() == found[0].boxes.lower.tobytes()
            assert other.boxes.upper.tobytes() == found[0].boxes.upper.tobytes()
            assert (other.limited, other.nodes) == (found[0].limited, found[0].nodes)


@pytest.mark.parametrize("batch", [1, 2, 3, 64, 1000])
def test_a_smaller_batch_finds_the_same_boxes_and_is_never_exceeded(batch: int) -> None:
    boxes = Boxes.of(*[[(-3, 3), (-3, 3)], [(-5, 3), (1, 2)], [(0, 0), (0, 2)]])
    whole, parts = Ring(np.array([0.3, 0.1]), 0.9, 1.1), Ring(np.array([0.3, 0.1]), 0.9, 1.1)
    expected = pave(whole, boxes, np.full(2, 0.1), max_boxes=UNLIMITED)
    paving = pave(parts, boxes, np.full(2, 0.1), max_boxes=UNLIMITED, batch=batch)
    assert max(parts.batches) <= batch
    assert as_set(paving.boxes) == as_set(expected.boxes)
    assert len(paving.boxes) == len(expected.boxes)
    assert paving.nodes == expected.nodes == sum(parts.batches)


def test_what_waits_stays_small_when_batches_are_small(monkeypatch: pytest.MonkeyPatch) -> None:
    # Level by level the search would hold a whole level; part by part it holds about one batch for each level.
    waiting = []
    split = paver._split

    def recording_split(boxes: Boxes, batch: int) -> list[Boxes]:
        waiting.append(len(boxes))
        return split(boxes, batch)

    monkeypatch.setattr(paver, "_split", recording_split)
    plane = HalfPlane(np.array([0.0, 0.0]), 0.0)
    paving = pave(plane, Boxes.of([(0, 128), (0, 128)]), np.full(2, 1.0), max_boxes=UNLIMITED, batch=16)
    assert len(paving.boxes) == 1 << 14
    assert max(waiting) == 32


def test_batches_are_split_evenly_and_in_order() -> None:
    lower = np.arange(10.0)[:, None]
    for batch, sizes in [(3, [2, 3, 2, 3]), (5, [5, 5]), (10, [10]), (99, [10]), (1, [1] * 10)]:
        parts = paver._split(Boxes(lower, lower), batch)
        assert [len(part) for part in parts] == sizes
        assert (Boxes.concatenate(parts).lower == lower).all()
    assert paver._split(Boxes.none(1), 5) == []


def test_no_boxes_and_empty_boxes_give_no_boxes() -> None:
    disc = Ring(np.zeros(2), 0.0, 1.0)
    for boxes in (Boxes.none(2), Boxes(np.full((3, 2), math.inf), np.full((3, 2), -math.inf))):
        paving = pave(disc, boxes, np.full(2, 0.1), max_boxes=1)
        assert paving.boxes.lower.shape == (0, 2)
        assert paving.limited == ""
    assert len(pave(Nothing(), Boxes.of([(0, 1), (0, 1)]), np.full(2, 0.1), max_boxes=1).boxes) == 0


def test_a_precision_that_no_double_reaches_ends_at_the_limit() -> None:
    box = Boxes.of([(1.0, math.nextafter(1.0, 2.0)), (1.0, 1.0)])
    paving = pave(Ring(np.zeros(2), 0.0, 2.0), box, np.full(2, 1e-300), max_boxes=100)
    assert paving.limited == "boxes"
    assert covered(paving.boxes, corners(box)).all()


def test_the_input_is_not_modified() -> None:
    boxes = Boxes.of([(-3, 3), (-3, 3)])
    pave(Ring(np.zeros(2), 0.5, 1.0), boxes, np.full(2, 0.1), max_boxes=UNLIMITED)
    assert as_set(boxes) == {(-3.0, -3.0, 3.0, 3.0)}
