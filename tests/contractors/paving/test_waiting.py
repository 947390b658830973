import heapq
import itertools

import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.contractors.paving.bisection import Cells
from ial.contractors.paving.waiting import Heap, Order, Queue, Stack, waiting


def cells(*numbers: float) -> Cells:
    """Return boxes that are told apart by their lower bound, each last cut across an axis that can be told from it."""
    lower = np.array(numbers, dtype=np.float64).reshape(-1, 1)
    return Cells(Boxes(lower, lower + 1.0), (lower[:, 0] % 7).astype(np.int16))


def numbers(cells: Cells) -> list[float]:
    assert (cells.boxes.upper == cells.boxes.lower + 1.0).all()
    assert (cells.last == cells.boxes.lower[:, 0] % 7).all()
    return [float(number) for number in cells.boxes.lower[:, 0]]


def test_a_stack_finishes_what_came_last() -> None:
    stack = Stack(3)
    stack.push(cells(*range(10)))
    assert len(stack) == 10
    assert numbers(stack.pop()) == [7, 8, 9]
    stack.push(cells(20, 21))
    assert [numbers(stack.pop()) for _ in range(4)] == [[20, 21], [5, 6], [2, 3, 4], [0, 1]]
    assert len(stack) == 0


@pytest.mark.parametrize(("batch", "sizes"), [(3, [2, 3, 2, 3]), (5, [5, 5]), (10, [10]), (99, [10]), (1, [1] * 10)])
def test_a_stack_splits_evenly(batch: int, sizes: list[int]) -> None:
    stack = Stack(batch)
    stack.push(cells(*range(10)))
    parts = [numbers(stack.pop()) for _ in sizes]
    assert [len(part) for part in reversed(parts)] == sizes
    assert list(itertools.chain(*reversed(parts))) == list(range(10))


def test_a_queue_keeps_the_order_and_fills_its_batches() -> None:
    queue = Queue(4)
    queue.push(cells(0, 1, 2))
    queue.push(cells(3, 4, 5, 6, 7, 8))
    queue.push(cells())
    assert len(queue) == 9
    assert numbers(queue.pop()) == [0, 1, 2, 3]
    queue.push(cells(9))
    assert [numbers(queue.pop()) for _ in range(2)] == [[4, 5, 6, 7], [8, 9]]
    assert len(queue) == 0


@pytest.mark.parametrize("batch", [1, 3, 50])
def test_a_heap_gives_the_largest_keys_and_among_equal_ones_the_oldest(batch: int) -> None:
    random = np.random.default_rng(batch)
    heap = Heap(lambda boxes: np.floor(boxes.lower[:, 0]) % 10.0, batch, 1)
    twin: list[tuple[float, int, float]] = []
    age = 0
    for _ in range(300):
        if random.random() < 0.6 or not twin:
            added = random.integers(0, 1000, random.integers(0, 20)).tolist()
            heap.push(cells(*added))
            for number in added:
                heapq.heappush(twin, (-(number % 10.0), age, float(number)))
                age += 1
        else:
            assert numbers(heap.pop()) == [heapq.heappop(twin)[2] for _ in range(min(batch, len(twin)))]
        assert len(heap) == len(twin)
    while twin:
        assert numbers(heap.pop()) == [heapq.heappop(twin)[2] for _ in range(min(batch, len(twin)))]


def test_infinite_keys_have_a_place() -> None:
    heap = Heap(lambda boxes: boxes.lower[:, 0], 9, 1)
    heap.push(Cells.uncut(Boxes(np.array([[0.0], [-np.inf], [5.0]]), np.full((3, 1), np.inf))))
    assert heap.pop().boxes.lower[:, 0].tolist() == [5.0, 0.0, -np.inf]


def test_best_is_the_widest_in_units_of_its_precision() -> None:
    collection = waiting("best", np.array([1.0, 0.1]), 4)
    collection.push(Cells.uncut(Boxes.of([(0, 1), (0, 1)], [(0, 9), (0, 0.1)], [(0, 1), (0, 3)], [(-np.inf, 0), (0, 0)])))
    assert collection.pop().boxes.upper[:, 1].tolist() == [0.0, 3.0, 1.0, 0.1]


@pytest.mark.parametrize(("order", "kind"), [("depth", Stack), ("breadth", Queue), ("best", Heap), (lambda boxes: boxes.lower[:, 0], Heap)])
def test_each_order_has_its_collection(order: Order, kind: type) -> None:
    assert isinstance(waiting(order, np.ones(1), 4), kind)


def test_keys_that_cannot_be_ordered_are_refused() -> None:
    for key, message in ((lambda boxes: np.ones((len(boxes), 2)), "keys of shape"), (lambda boxes: np.full(len(boxes), np.nan), "NaN")):
        with pytest.raises(ValueError, match=message):
            Heap(key, 4, 1).push(cells(1, 2))
