import itertools
import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest

from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.contractor import ContractorLike
from ial.contractors.kernels import kernel
from ial.contractors.paving.bisection import Rule
from ial.contractors.paving.limits import Deadline
from ial.contractors.paving.paver import Progress, pave
from ial.contractors.paving.paving import Paving
from ial.contractors.paving.waiting import Order
from ial.contractors.separator import Separator
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


@pytest.mark.slow
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


@pytest.mark.many
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


def test_the_result_does_not_depend_on_the_number_of_threads(threads: Callable[[int | None], None]) -> None:
    for limit in (300, UNLIMITED):
        pavings = []
        for count in (1, 2, 3):
            threads(count)
            pavings.append(pave(Ring(np.array([0.3, 0.1]), 0.5, 1.7), Boxes.of([(-3, 3), (-3, 3)]), np.full(2, 0.03), max_boxes=limit))
        for other in pavings[1:]:
            assert other.boxes.lower.tobytes() == pavings[0].boxes.lower.tobytes()
            assert other.boxes.upper.tobytes() == pavings[0].boxes.upper.tobytes()
            assert (other.limited, other.nodes) == (pavings[0].limited, pavings[0].nodes)


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


def test_what_waits_stays_small_in_depth_when_batches_are_small() -> None:
    # Level by level the search holds a whole level; part by part it holds about one batch for each level.
    plane = HalfPlane(np.array([0.0, 0.0]), 0.0)
    largest = {}
    for order in ("depth", "breadth"):
        reports: list[Progress] = []
        paving = pave(plane, Boxes.of([(0, 128), (0, 128)]), 1.0, batch=16, order=order, progress=reports.append)
        assert len(paving.boxes) == 1 << 14
        largest[order] = max(report.waiting for report in reports)
    assert largest == {"depth": 32 + 16 * 9, "breadth": 1 << 14}


def test_no_boxes_and_empty_boxes_give_no_boxes() -> None:
    disc = Ring(np.zeros(2), 0.0, 1.0)
    for boxes in (Boxes.none(2), Boxes(np.full((3, 2), math.inf), np.full((3, 2), -math.inf))):
        paving = pave(disc, boxes, np.full(2, 0.1), max_boxes=1)
        assert paving.boxes.lower.shape == (0, 2)
        assert paving.limited == ""
    assert len(pave(Nothing(), Boxes.of([(0, 1), (0, 1)]), np.full(2, 0.1), max_boxes=1).boxes) == 0


def test_a_precision_that_no_double_reaches_ends_at_neighbouring_doubles() -> None:
    following = [math.nextafter(1.0, 2.0)]
    for _ in range(3):
        following.append(math.nextafter(following[-1], 2.0))
    paving = pave(HalfPlane(np.zeros(2), 0.0), Boxes.of([(1.0, following[3]), (1.0, 1.0)]), 1e-300)
    assert paving.limited == ""
    assert as_set(paving.boxes) == {(low, 1.0, high, 1.0) for low, high in itertools.pairwise([1.0, *following])}


def test_the_input_is_not_modified() -> None:
    boxes = Boxes.of([(-3, 3), (-3, 3)])
    pave(Ring(np.zeros(2), 0.5, 1.0), boxes, np.full(2, 0.1), max_boxes=UNLIMITED)
    assert as_set(boxes) == {(-3.0, -3.0, 3.0, 3.0)}


EVERYTHING = HalfPlane(np.zeros(2), 0.0)


class Inverted:
    """The same shape, with a contractor that removes only points inside: it empties boxes of which all corners are inside by a margin.

    For a half-plane, and for the outside of a disc seen from within the disc, the corners decide.
    """

    dimension = 2

    def __init__(self, contractor: Ring | HalfPlane) -> None:
        self.contractor = contractor

    def contract(self, boxes: Boxes) -> Boxes:
        if isinstance(self.contractor, HalfPlane):
            most = np.where(self.contractor.normal > 0.0, boxes.upper, boxes.lower) @ self.contractor.normal
            return boxes.where(most > self.contractor.offset - MARGIN)
        ring = self.contractor
        reach = np.maximum(np.abs(boxes.lower - ring.centre), np.abs(boxes.upper - ring.centre))
        gap = np.maximum(np.maximum(boxes.lower - ring.centre, ring.centre - boxes.upper), 0.0)
        inside = (np.hypot(*reach.T) < ring.outer - MARGIN) & ((ring.inner == 0.0) | (np.hypot(*gap.T) > ring.inner + MARGIN))
        return boxes.where(~inside)


class Slab:
    """The points with lower <= x <= upper along one axis; exact, as all it does is compare."""

    dimension = 2

    def __init__(self, axis: int, lower: float, upper: float) -> None:
        self.axis, self.lower, self.upper = axis, lower, upper

    def contract(self, boxes: Boxes) -> Boxes:
        lower, upper = boxes.lower.copy(), boxes.upper.copy()
        lower[:, self.axis] = np.maximum(lower[:, self.axis], self.lower)
        upper[:, self.axis] = np.minimum(upper[:, self.axis], self.upper)
        cut = Boxes(lower, upper)
        return cut.where(~cut.empty)


def interiors_meet(boxes: Boxes) -> bool:
    """Return whether two boxes share more than faces; flat boxes have no interior."""
    full = boxes[(boxes.lower < boxes.upper).all(axis=1)]
    low, high = np.maximum(full.lower[:, None], full.lower), np.minimum(full.upper[:, None], full.upper)
    meet = (low < high).all(axis=2)
    return bool(meet.sum() > len(full))


ORDERS: list[Order] = ["depth", "breadth", "best", lambda boxes: -np.abs(boxes.lower[:, 0] - 0.3)]
RULES: list[Rule] = ["largest", "round_robin", lambda boxes: np.abs(boxes.lower) + np.array([0.1, 0.2])]


@pytest.mark.parametrize("order", ORDERS, ids=["depth", "breadth", "best", "key"])
@pytest.mark.parametrize("rule", RULES, ids=["largest", "round_robin", "weights"])
def test_every_order_and_rule_covers_every_solution_with_small_boxes(order: Order, rule: Rule) -> None:
    for seed in range(8):
        random = np.random.default_rng(seed)
        contractor, boxes, precision = shape(random), start(random), random.uniform(0.05, 0.5, 2)
        paving = pave(contractor, boxes, precision, order=order, rule=rule, batch=64)
        assert_covers(paving, contractor, boxes, random)
        assert paving.limited == ""
        assert (paving.boxes.width() <= precision).all()


@pytest.mark.parametrize("rule", RULES, ids=["largest", "round_robin", "weights"])
def test_the_order_changes_only_the_order(rule: Rule) -> None:
    pavings = [pave(Ring(np.array([0.3, 0.1]), 0.9, 1.1), Boxes.of([(-3, 3), (-2, 3)]), 0.05, order=order, rule=rule) for order in ORDERS]
    for paving in pavings[1:]:
        assert as_set(paving.boxes) == as_set(pavings[0].boxes)
        assert (len(paving.boxes), paving.nodes) == (len(pavings[0].boxes), pavings[0].nodes)


def test_the_sides_are_cut_as_the_rule_says() -> None:
    box, precision = Boxes.of([(0, 8), (0, 4)]), [1.0, 1.0]

    def halves(rule: Rule, most: int) -> set[tuple[float, ...]]:
        return as_set(pave(EVERYTHING, box, precision, rule=rule, max_boxes=most).boxes)

    assert halves("largest", 4) == {(0.0, 0.0, 2.0, 4.0), (2.0, 0.0, 4.0, 4.0), (4.0, 0.0, 6.0, 4.0), (6.0, 0.0, 8.0, 4.0)}
    assert halves("round_robin", 4) == {(0.0, 0.0, 4.0, 2.0), (0.0, 2.0, 4.0, 4.0), (4.0, 0.0, 8.0, 2.0), (4.0, 2.0, 8.0, 4.0)}
    assert halves(lambda boxes: np.tile([0.0, 1.0], (len(boxes), 1)), 4) == {(0.0, float(i), 8.0, i + 1.0) for i in range(4)}
    # A side that is narrow enough is passed over, whatever its weight.
    assert len(halves(lambda boxes: np.tile([0.0, 1.0], (len(boxes), 1)), 32)) == 32


def test_a_rule_sees_no_empty_box_and_its_weights_may_be_nan_or_infinite() -> None:
    def rule(boxes: Boxes) -> FloatArray:
        assert not boxes.empty.any()
        return np.tile([np.nan, np.inf], (len(boxes), 1))

    ring = Ring(np.zeros(2), 0.5, 1.0)
    assert (pave(ring, Boxes.of([(-3, 3), (-3, 3)]), 0.2, rule=rule).boxes.width() <= 0.2).all()


def test_an_infinite_precision_leaves_an_axis_alone() -> None:
    paving = pave(Slab(0, -np.inf, np.inf), Boxes.of([(-np.inf, np.inf), (0, 4)]), [np.inf, 1.0])
    assert as_set(paving.boxes) == {(-np.inf, float(i), np.inf, i + 1.0) for i in range(4)}


def test_an_unbounded_box_is_cut_into_bounded_ones() -> None:
    paving = pave(Slab(0, -1.0, 2.0), Boxes.of([(-np.inf, np.inf), (0, 0)]), 1.0)
    assert paving.limited == ""
    assert paving.hull().lower.tolist() == [[-1.0, 0.0]]
    assert paving.hull().upper.tolist() == [[2.0, 0.0]]


def test_a_limited_breadth_first_paving_is_equally_coarse_and_the_best_first_one_follows_its_key() -> None:
    box = Boxes.of([(0, 64), (0, 64)])
    even = pave(EVERYTHING, box, 1.0, order="breadth", max_boxes=256, batch=8)
    assert np.ptp(even.boxes.width().prod(axis=1)) == 0.0
    near = pave(EVERYTHING, box, 1.0, order=lambda boxes: -boxes.lower.sum(axis=1), max_boxes=64, batch=1)
    sizes = near.boxes.width().prod(axis=1)
    assert near.limited == "boxes"
    assert sizes[near.boxes.lower.sum(axis=1) < 4.0].max() == 1.0
    assert sizes.max() > 500.0


def test_a_separator_gives_inner_boxes_of_solutions_only_and_a_paving_that_covers() -> None:
    inner_points = 0
    for seed in range(30):
        random = np.random.default_rng(seed)
        contractor, boxes = shape(random), start(random)
        boxes = boxes[:1]
        precision = random.uniform(0.03, 0.3, 2)
        paving = pave(Separator(inner=Inverted(contractor), outer=contractor), boxes, precision)
        assert_covers(paving, contractor, boxes, random)
        assert (paving.boundary.width() <= precision).all()
        if len(paving.inner):
            points = points_of(paving.inner, random)
            assert contractor.holds(points).all()
            inner_points += len(points)
        assert not interiors_meet(paving.boxes)
        assert not paving.boxes.empty.any()
    assert inner_points > 10_000


def test_what_the_inner_contractor_cuts_off_is_collected() -> None:
    # S = [1, 3] × [0, 4] in [0, 4] × [0, 4]; the inner contractor knows one of its sides only.
    paving = pave(Separator(inner=Slab(0, 2.5, np.inf), outer=Slab(0, 1.0, 3.0)), Boxes.of([(0, 4), (0, 4)]), 8.0)
    assert as_set(paving.inner) == {(1.0, 0.0, 2.5, 4.0)}
    assert as_set(paving.boundary) == {(2.5, 0.0, 3.0, 4.0)}
    assert paving.volume().lower == 6.0
    assert paving.volume().upper == 8.0
    assert paving.nodes == 1


def test_a_contractor_is_a_separator_that_proves_nothing_inside() -> None:
    class Whole:
        dimension = 2

        def contract(self, boxes: Boxes) -> Boxes:
            return boxes

    ring, box = Ring(np.array([0.3, 0.1]), 0.9, 1.1), Boxes.of([(-3, 3), (-3, 3)])
    alone, pair = pave(ring, box, 0.05), pave(Separator(inner=Whole(), outer=ring), box, 0.05)
    assert len(pair.inner) == len(alone.inner) == 0
    assert pair.boxes.lower.tobytes() == alone.boxes.lower.tobytes()
    assert pair.nodes == alone.nodes


@pytest.mark.many
@pytest.mark.parametrize("order", ORDERS, ids=["depth", "breadth", "best", "key"])
def test_a_separator_paving_does_not_depend_on_the_number_of_threads(order: Order, threads: Callable[[int | None], None]) -> None:
    ring = Ring(np.array([0.3, 0.1]), 0.5, 1.7)
    pavings = []
    for count in (1, 2, 3):
        threads(count)
        pavings.append(pave(Separator(inner=Inverted(ring), outer=ring), Boxes.of([(-3, 3), (-3, 3)]), 0.004, order=order, batch=1 << 15))
    for other in pavings[1:]:
        for part in ("inner", "boundary"):
            assert getattr(other, part).lower.tobytes() == getattr(pavings[0], part).lower.tobytes()
            assert getattr(other, part).upper.tobytes() == getattr(pavings[0], part).upper.tobytes()


@pytest.mark.many
def test_a_limit_on_memory_keeps_the_boxes_within_it() -> None:
    box = Boxes.of([(-3, 3), (-3, 3)])
    ring = Ring(np.array([0.1, 0.2]), 0.2, 2.5)
    paving = pave(ring, box, 0.01, max_bytes=64 * 1000, batch=32)
    assert paving.limited == "memory"
    assert 500 < len(paving.boxes) <= 1000
    assert assert_covers(paving, ring, box, np.random.default_rng(0)) > 10
    assert pave(ring, box, 0.01, max_bytes=64 * 1000, max_boxes=500, batch=32).limited == "boxes"
    assert pave(ring, box, 0.01, max_bytes=1 << 30).limited == ""


def test_a_limit_on_time_leaves_a_paving_that_covers_and_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    calls = itertools.count()
    monkeypatch.setattr(Deadline, "portion", lambda self, rows: rows if next(calls) < 6 else 0)
    random = np.random.default_rng(3)
    boxes, contractor = Boxes.of([(-3, 3), (-3, 3)]), Ring(np.array([0.1, 0.2]), 1.0, 1.5)
    paving = pave(contractor, boxes, 0.01, max_seconds=1.0)
    assert paving.limited == "time"
    assert len(contractor.batches) == 6
    assert paving.nodes == sum(contractor.batches)
    assert paving.boxes.width().max() > 0.01
    assert assert_covers(paving, contractor, boxes, random) > 10


@pytest.mark.parametrize("order", ["depth", "breadth", "best"])
def test_a_batch_in_which_the_time_runs_out_is_returned_partly_contracted(order: Order, monkeypatch: pytest.MonkeyPatch) -> None:
    done = 0

    def portion(self: Deadline, rows: int) -> int:
        nonlocal done
        now = min(rows, 7, 500 - done)
        done += now
        return now

    monkeypatch.setattr(Deadline, "portion", portion)
    ring, box = Ring(np.array([0.1, 0.2]), 1.0, 1.5), Boxes.of([(-3, 3), (-3, 3)])
    for constraint in (ring, Separator(inner=Inverted(ring), outer=ring)):
        done = 0
        paving = pave(constraint, box, 0.01, max_seconds=1.0, order=order)
        assert paving.limited == "time"
        assert paving.nodes == 500
        assert_covers(paving, ring, box, np.random.default_rng(0))
        assert not interiors_meet(paving.boxes)


def test_portions_do_not_change_the_result(monkeypatch: pytest.MonkeyPatch) -> None:
    ring, box = Ring(np.array([0.1, 0.2]), 1.0, 1.5), Boxes.of([(-3, 3), (-3, 3)])
    separator = Separator(inner=Inverted(ring), outer=ring)
    whole = pave(separator, box, 0.03)
    assert pave(separator, box, 0.03, max_seconds=1e9).boxes.lower.tobytes() == whole.boxes.lower.tobytes()
    monkeypatch.setattr(Deadline, "portion", lambda self, rows: min(rows, 7))
    parts = pave(separator, box, 0.03, max_seconds=1e9)
    assert parts.boxes.lower.tobytes() == whole.boxes.lower.tobytes()
    assert parts.nodes == whole.nodes


def test_no_time_at_all_returns_the_boxes() -> None:
    paving = pave(EVERYTHING, Boxes.of([(0, 1), (0, 1)]), 0.1, max_seconds=0.0)
    assert paving.limited == "time"
    assert paving.nodes == 0
    assert as_set(paving.boxes) == {(0.0, 0.0, 1.0, 1.0)}


def test_progress_is_reported_after_every_batch_and_may_end_the_search() -> None:
    reports: list[Progress] = []
    ring = Ring(np.array([0.1, 0.2]), 1.0, 1.5)
    paving = pave(ring, Boxes.of([(-3, 3), (-3, 3)]), 0.1, progress=reports.append)
    assert len(reports) == len(ring.batches)
    assert [report.nodes for report in reports] == np.cumsum(ring.batches).tolist()
    assert (reports[-1].waiting, reports[-1].finished) == (0, len(paving.boxes))
    assert all(a.elapsed_s <= b.elapsed_s for a, b in itertools.pairwise(reports))

    def interrupt(report: Progress) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        pave(ring, Boxes.of([(-3, 3), (-3, 3)]), 0.1, progress=interrupt)


class Broken:
    """Returns what a contractor must not return."""

    dimension = 2

    def __init__(self, returned: Callable[[Boxes], Boxes]) -> None:
        self.contract = returned


@pytest.mark.parametrize(
    ("constraint", "boxes", "options", "message"),
    [
        (EVERYTHING, Boxes.of([(0, 1)]), {}, "1 dimensions"),
        (EVERYTHING, Boxes(np.zeros((1, 2)), np.array([[1.0, np.nan]])), {}, "box 0 of 1 has a bound that is NaN"),
        (EVERYTHING, Boxes.of([(0, 1), (0, 1)]), {"precision": 0.0}, "precision is 0.0"),
        (EVERYTHING, Boxes.of([(0, 1), (0, 1)]), {"precision": -1.0}, "precision is -1.0"),
        (EVERYTHING, Boxes.of([(0, 1), (0, 1)]), {"precision": [0.1, np.nan]}, "precision is"),
        (EVERYTHING, Boxes.of([(0, 1), (0, 1)]), {"precision": [0.1, 0.1, 0.1]}, "the precision has shape"),
        (EVERYTHING, Boxes.of([(0, 1), (0, 1)]), {"order": "widest"}, "the order is 'widest'"),
        (EVERYTHING, Boxes.of([(0, 1), (0, 1)]), {"rule": "smear"}, "the rule is 'smear'"),
        (EVERYTHING, Boxes.of([(0, 1), (0, 1)]), {"max_boxes": 0}, "max_boxes is 0"),
        (EVERYTHING, Boxes.of([(0, 1), (0, 1)]), {"max_bytes": -5}, "max_bytes is -5"),
        (EVERYTHING, Boxes.of([(0, 1), (0, 1)]), {"batch": 0}, "batch is 0"),
        (EVERYTHING, Boxes.of([(0, 1), (0, 1)]), {"max_seconds": np.nan}, "max_seconds is nan"),
        (EVERYTHING, Boxes.of([(0, 1), (0, 1)]), {"rule": lambda boxes: np.ones(2)}, "weights of shape"),
        (EVERYTHING, Boxes.of([(0, 1), (0, 1)]), {"order": lambda boxes: 1.0}, "keys of shape"),
        (EVERYTHING, Boxes.of([(0, 1), (0, 1)]), {"order": lambda boxes: np.full(len(boxes), np.nan)}, "NaN as the key"),
        (Broken(lambda boxes: Boxes(boxes.lower, boxes.upper * np.nan)), Boxes.of([(0, 1), (0, 1)]), {}, "are NaN"),
        (Broken(lambda boxes: boxes[:0]), Boxes.of([(0, 1), (0, 1)]), {}, "returned bounds of shape"),
    ],
)
def test_what_cannot_be_used_is_refused(constraint: ContractorLike, boxes: Boxes, options: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        pave(constraint, boxes, options.pop("precision", 0.1), **options)
