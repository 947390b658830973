import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.contractors.paving.difference import difference
from tests.cases import cases


def random_pair(random: np.random.Generator, rows: int, dimension: int) -> tuple[Boxes, Boxes]:
    """Return boxes on a lattice, and parts of them: touching sides, whole, flat, empty."""
    edges = np.sort(random.integers(0, 5, (rows, dimension, 2)), axis=2).astype(np.float64)
    inner = np.sort(random.uniform(edges[..., :1], edges[..., 1:], edges.shape).round(), axis=2).clip(edges[..., :1], edges[..., 1:])
    boxes, parts = Boxes(edges[..., 0], edges[..., 1]), Boxes(inner[..., 0], inner[..., 1])
    return boxes.where(random.random(rows) > 0.1), parts.where(random.random(rows) > 0.2)


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_every_point_is_in_the_part_or_in_one_piece_that_meets_the_part_in_faces_only(dimension: int) -> None:
    random = np.random.default_rng(dimension)
    boxes, parts = random_pair(random, 200, dimension)
    pieces = 0
    for row in range(200):
        box, part = boxes[[row]], parts[[row]]
        cut = difference(box, part)
        pieces += len(cut)
        assert len(cut) <= 2 * dimension
        assert not cut.empty.any()
        grid = np.stack(np.meshgrid(*[np.arange(-0.25, 5.0, 0.25)] * dimension), axis=-1).reshape(-1, dimension)
        within = [((each.lower <= grid[:, None]) & (grid[:, None] <= each.upper)).all(axis=2) for each in (box, part, cut)]
        in_box, in_part, in_cut = within[0][:, 0], within[1][:, 0], within[2].any(axis=1)
        assert (in_box == (in_cut | (in_part & in_box))).all()
        # In the plane of a flat box, the interiors are those along its other axes.
        across = (box.lower < box.upper)[0]
        inner = [((each.lower < grid[:, None]) & (grid[:, None] < each.upper))[..., across].all(axis=2) for each in (part, cut)]
        if across.any():
            assert ((inner[0][:, 0] & within[1][:, 0]).astype(int) + (inner[1] & within[2]).sum(axis=1) <= 1).all()
    assert pieces > 150


def test_the_rows_of_a_large_batch_keep_their_order() -> None:
    rows = cases(40_000, 2000)
    boxes, parts = random_pair(np.random.default_rng(0), rows, 2)
    every = difference(boxes, parts)
    some = Boxes.concatenate([difference(boxes[start : start + 999], parts[start : start + 999]) for start in range(0, rows, 999)])
    assert every.lower.tobytes() == some.lower.tobytes()
    assert every.upper.tobytes() == some.upper.tobytes()


def test_a_part_that_sticks_out_counts_as_far_as_it_is_inside() -> None:
    box = Boxes.of([(0, 4), (0, 4)])
    assert difference(box, Boxes.of([(-1, 5), (2, 9)])).upper.tolist() == [[4.0, 2.0]]
    assert difference(box, Boxes.of([(7, 9), (0, 4)])).upper.tolist() == [[4.0, 4.0]]
    assert len(difference(box, Boxes.of([(-np.inf, np.inf), (-np.inf, np.inf)]))) == 0


def test_an_unbounded_box_is_cut() -> None:
    cut = difference(Boxes.of([(-np.inf, np.inf)]), Boxes.of([(1, 2)]))
    assert cut.lower[:, 0].tolist() == [-np.inf, 2.0]
    assert cut.upper[:, 0].tolist() == [1.0, np.inf]


def test_shapes_that_differ_are_refused() -> None:
    with pytest.raises(ValueError, match="give one part for each box"):
        difference(Boxes.of([(0, 1)]), Boxes.none(1))
