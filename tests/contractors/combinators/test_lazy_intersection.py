import numpy as np

from ial.contractors import Boxes, Contractor, intersection, lazy
from ial.contractors.combinators.lazy_intersection import LazyIntersection
from tests.contractors.shapes import Inside, inside, lattice, random_boxes, same

RARE, OFTEN, NEVER = Inside((0, 6), (0, 7)), Inside((3, 4), (3, 4)), Inside((-np.inf, np.inf), (-np.inf, np.inf))


class Watched(Contractor):
    """Keeps the batches it is given."""

    def __init__(self, contractor: Inside) -> None:
        self.contractor, self.dimension = contractor, contractor.dimension
        self.batches: list[Boxes] = []

    def contract(self, boxes: Boxes) -> Boxes:
        self.batches.append(boxes)
        return self.contractor.contract(boxes)


def small_boxes(count: int, seed: int) -> Boxes:
    lower = np.random.default_rng(seed).uniform(-1, 8, size=(count, 2))
    return Boxes(lower, lower + 0.5)


def test_the_contractor_that_empties_most_comes_first() -> None:
    contractor = LazyIntersection(NEVER, RARE, OFTEN)
    assert contractor.order() == [0, 1, 2]
    contractor.contract(small_boxes(500, seed=1))
    assert contractor.order() == [2, 1, 0]


def test_rows_that_are_empty_are_not_passed_on() -> None:
    parts = [Watched(OFTEN), Watched(RARE), Watched(NEVER)]
    contractor, boxes = lazy(parts), small_boxes(500, seed=2)
    contractor.contract(boxes)
    left = boxes[~OFTEN.contract(boxes).empty]
    assert 0 < len(left) < 100
    assert len(parts[1].batches[0]) == len(left)
    assert not any(batch.empty.any() for part in parts[1:] for batch in part.batches)


def test_the_solutions_are_those_of_the_intersection() -> None:
    contractor, points = lazy([RARE, OFTEN, NEVER]), lattice(2)
    both = RARE.holds(points) & OFTEN.holds(points)
    for seed in range(5):
        boxes = random_boxes(200, 2, seed)
        narrowed = contractor.contract(boxes)
        assert inside(narrowed, points)[inside(boxes, points) & both].all()
        assert same(narrowed, intersection([RARE, OFTEN]).contract(boxes))  # exact contractors: the order does not matter


def test_the_order_depends_on_the_batches_only() -> None:
    def orders() -> list[list[int]]:
        contractor = LazyIntersection(NEVER, RARE, OFTEN)
        seen = []
        for seed in range(4):
            contractor.contract(small_boxes(100, seed))
            seen.append(contractor.order())
        return seen

    assert orders() == orders()


def test_members_of_an_intersection_are_ordered_one_by_one() -> None:
    assert LazyIntersection(intersection([NEVER, RARE]), OFTEN).contractors == (NEVER, RARE, OFTEN)
    assert len(lazy([intersection([NEVER, RARE])]).contract(Boxes.none(2))) == 0
