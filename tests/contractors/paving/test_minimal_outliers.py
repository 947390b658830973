import itertools

import numpy as np
import numpy.typing as npt
import pytest

from ial.contractors.algebra import relaxed
from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.paving.limits import Deadline
from ial.contractors.paving.minimal_outliers import minimal_outliers
from ial.contractors.paving.paver import pave
from ial.contractors.separator import Separator
from ial.contractors.threads import set_threads

SEARCHED = Boxes.of([(0, 16), (0, 16)])


class Inside:
    """The points of a box; comparing is exact."""

    def __init__(self, box: Boxes) -> None:
        self.box = box
        self.dimension = box.dimension

    def contract(self, boxes: Boxes) -> Boxes:
        cut = Boxes(np.maximum(boxes.lower, self.box.lower), np.minimum(boxes.upper, self.box.upper))
        return cut.where(~cut.empty)


class Outside:
    """The points that are not inside a box: empties boxes that lie in it."""

    def __init__(self, box: Boxes) -> None:
        self.box = box
        self.dimension = box.dimension

    def contract(self, boxes: Boxes) -> Boxes:
        return boxes.where(~((self.box.lower <= boxes.lower) & (boxes.upper <= self.box.upper)).all(axis=1))


class Rectangles:
    """Several boxes as one family."""

    dimension = 2

    def __init__(self, boxes: Boxes) -> None:
        self.boxes, self.count = boxes, len(boxes)

    def contract_each(self, boxes: Boxes) -> tuple[FloatArray, FloatArray]:
        lower = np.maximum(boxes.lower[:, None], self.boxes.lower)
        upper = np.minimum(boxes.upper[:, None], self.boxes.upper)
        empty = (lower > upper).any(axis=2, keepdims=True)
        return np.where(empty, np.inf, lower), np.where(empty, -np.inf, upper)


def separators(rectangles: Boxes) -> list[Separator]:
    return [Separator(inner=Outside(each), outer=Inside(each)) for each in (rectangles[[row]] for row in range(len(rectangles)))]


def random_rectangles(random: np.random.Generator, count: int) -> Boxes:
    lower = random.integers(-4, 14, (count, 2)).astype(np.float64)
    return Boxes(lower, lower + random.integers(0, 8, lower.shape))


def failures(rectangles: Boxes, points: FloatArray) -> npt.NDArray[np.int64]:
    holds = ((rectangles.lower <= points[:, None]) & (points[:, None] <= rectangles.upper)).all(axis=2)
    return np.count_nonzero(~holds, axis=1)


def fewest(rectangles: Boxes, step: float) -> int:
    """Return the smallest number that fail at any point of a grid; at the corners of cells and between them all that can happen does."""
    along = np.arange(0.0, 16.0 + step, step)
    return int(failures(rectangles, np.stack(np.meshgrid(along, along), axis=-1).reshape(-1, 2)).min())


def test_the_bounds_hold_the_smallest_number_and_meet_where_the_solution_has_an_interior() -> None:
    met = []
    for seed in range(40):
        random = np.random.default_rng(seed)
        rectangles = random_rectangles(random, int(random.integers(1, 12)))
        outcome = minimal_outliers(separators(rectangles), SEARCHED, 0.1)
        truth = fewest(rectangles, 0.5)
        assert outcome.q_low <= truth <= outcome.q_high, seed
        assert failures(rectangles, outcome.witness[None])[0] == outcome.q_high
        assert SEARCHED.contain(outcome.witness.tolist())[0]
        assert outcome.limited == ""
        full = Boxes(rectangles.lower + 0.25, rectangles.upper - 0.25)  # whether a point has as few outliers, and some room
        if fewest(full, 0.25) == truth:
            assert outcome.q_low == outcome.q_high == truth, seed
            met.append(truth)
    assert len(met) > 15
    assert len(set(met)) > 3


def test_a_point_that_only_touches_is_not_found_and_not_denied() -> None:
    # The two boxes share a corner, which no bisection of this box meets.
    outcome = minimal_outliers(separators(Boxes.of([(0, 0.3), (0, 0.3)], [(0.3, 1), (0.3, 1)])), SEARCHED, 1e-3)
    assert (outcome.q_low, outcome.q_high) in {(0, 1), (0, 0)}


@pytest.mark.parametrize("way", ["satisfied", "family", "complement"])
def test_other_kinds_of_constraints_give_the_same_bounds(way: str) -> None:
    class WithComplement(Inside):
        def complement(self) -> Outside:
            return Outside(self.box)

    for seed in range(10):
        rectangles = random_rectangles(np.random.default_rng(seed), 7)
        expected = minimal_outliers(separators(rectangles), SEARCHED, 0.1)

        def satisfied(points: FloatArray, rectangles: Boxes = rectangles) -> npt.NDArray[np.bool_]:
            return np.asarray(((rectangles.lower <= points[:, None]) & (points[:, None] <= rectangles.upper)).all(axis=2))

        rows = [rectangles[[row]] for row in range(7)]
        outcomes = (
            minimal_outliers([WithComplement(row) for row in rows], SEARCHED, 0.1)
            if way == "complement"
            else minimal_outliers(
                Rectangles(rectangles) if way == "family" else [Inside(row) for row in rows], SEARCHED, 0.1, satisfied=satisfied
            )
        )
        assert outcomes[:2] == expected[:2]
        assert (outcomes.witness == expected.witness).all()
        assert outcomes.nodes == expected.nodes


def test_it_needs_fewer_nodes_than_raising_q_until_a_solution_appears() -> None:
    searched = nodes = 0
    for seed in range(5):
        rectangles = random_rectangles(np.random.default_rng(seed), 9)
        constraints = separators(rectangles)
        outcome = minimal_outliers(constraints, SEARCHED, 0.1)
        searched += outcome.nodes
        for q in range(outcome.q_high + 1):
            paving = pave(relaxed(constraints, outliers=q), SEARCHED, 0.1)
            nodes += paving.nodes
            # Below q_low the relaxed problem has no solution that could be proved; at q_high it has one.
            assert q >= outcome.q_low or not len(paving.inner)
            assert q < outcome.q_high or paving.contains(outcome.witness.tolist())
    assert searched < nodes


def test_the_result_does_not_depend_on_the_number_of_threads() -> None:
    rectangles = random_rectangles(np.random.default_rng(3), 40)
    outcomes = []
    try:
        for count in (1, 2, 3):
            set_threads(count)
            outcomes.append(minimal_outliers(separators(rectangles), SEARCHED, 0.01))
    finally:
        set_threads(None)
    for other in outcomes[1:]:
        assert other[:2] == outcomes[0][:2]
        assert (other.witness == outcomes[0].witness).all()
        assert other.nodes == outcomes[0].nodes


def test_limits_widen_the_bounds_and_are_named(monkeypatch: pytest.MonkeyPatch) -> None:
    # A chequered pattern of small boxes keeps the search busy: two constraints that never hold together.
    stripes = [Inside(Boxes.of([(i, i + 0.4), (0, 16)])) for i in range(16)]

    class Some:
        dimension = 2

        def __init__(self, offset: float) -> None:
            self.offset = offset

        def contract(self, boxes: Boxes) -> Boxes:
            moved = Boxes(boxes.lower - [self.offset, 0.0], boxes.upper - [self.offset, 0.0])
            parts = [stripe.contract(moved) for stripe in stripes]
            return boxes.where(~np.all([part.empty for part in parts], axis=0))

    def satisfied(points: FloatArray) -> npt.NDArray[np.bool_]:
        return np.stack([points[:, 0] % 1.0 <= 0.4, (points[:, 0] - 0.5) % 1.0 <= 0.4], axis=1)

    constraints = [Some(0.0), Some(0.5)]
    free = minimal_outliers(constraints, SEARCHED, [0.01, 16.0], satisfied=satisfied)
    assert (free.q_low, free.q_high, free.limited) == (1, 1, "")
    few = minimal_outliers(constraints, SEARCHED, [0.01, 16.0], satisfied=satisfied, max_boxes=8)
    assert (few.q_low, few.q_high, few.limited) == (0, 1, "boxes")
    assert few.nodes < free.nodes
    portions = itertools.chain([1, 2, 4], itertools.repeat(0))
    monkeypatch.setattr(Deadline, "portion", lambda self, rows: min(rows, next(portions)))
    late = minimal_outliers(constraints, SEARCHED, [0.01, 16.0], satisfied=satisfied, max_seconds=1.0)
    assert (late.q_low, late.q_high, late.limited) == (0, 1, "time")
    assert late.nodes == 7


def test_constraints_that_hold_nowhere_all_fail() -> None:
    outcome = minimal_outliers(separators(Boxes.of([(20, 21), (0, 1)], [(-5, -4), (0, 1)])), SEARCHED, 0.1)
    assert outcome[:2] == (2, 2)
    assert outcome.nodes == 1


def test_unbounded_boxes_and_several_boxes_are_searched() -> None:
    rectangles = Boxes.of([(-3, -2), (5, 7)], [(-2.5, -1), (0, 6)], [(100, 101), (0, 1)])
    everywhere = Boxes.of([(-np.inf, np.inf), (-np.inf, np.inf)])
    assert minimal_outliers(separators(rectangles), everywhere, 0.1)[:2] == (1, 1)
    empty = Boxes(np.full((1, 2), np.inf), np.full((1, 2), -np.inf))
    several = Boxes.concatenate([empty, Boxes.of([(50, 200), (0, 1)], [(-2.4, 0), (0, 4)])])
    assert minimal_outliers(separators(rectangles), several, 0.1)[:2] == (2, 2)


class Plain(Inside):
    """A contractor without a known complement."""


class NotANumber(Inside):
    def contract(self, boxes: Boxes) -> Boxes:
        return Boxes(boxes.lower * np.nan, boxes.upper)


def test_what_cannot_be_used_is_refused() -> None:
    rectangle = Boxes.of([(0, 1), (0, 1)])
    good = separators(rectangle)
    with pytest.raises(TypeError, match="no contractor is known for the points outside of Plain"):
        minimal_outliers([Plain(rectangle)], SEARCHED, 0.1)
    with pytest.raises(TypeError):
        minimal_outliers([*good, Plain(rectangle)], SEARCHED, 0.1)  # type: ignore[list-item]
    with pytest.raises(ValueError, match="at least one contractor"):
        minimal_outliers([], SEARCHED, 0.1)
    with pytest.raises(ValueError, match="all boxes to search are empty"):
        minimal_outliers(good, Boxes.none(2), 0.1)
    with pytest.raises(ValueError, match="3 dimensions"):
        minimal_outliers(good, Boxes.none(3), 0.1)
    with pytest.raises(ValueError, match="the precision is nan"):
        minimal_outliers(good, SEARCHED, np.nan)
    with pytest.raises(ValueError, match="max_boxes is 0"):
        minimal_outliers(good, SEARCHED, 0.1, max_boxes=0)
    with pytest.raises(ValueError, match="`satisfied` gave float64 of shape"):
        minimal_outliers([Plain(rectangle)], SEARCHED, 0.1, satisfied=lambda points: np.ones(1))
    with pytest.raises(ValueError, match="bound that is NaN"):
        minimal_outliers([Separator(inner=Outside(rectangle), outer=NotANumber(rectangle))], SEARCHED, 0.1)
