import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.paving.bisection import Cells, Division, Rule


def batch(random: np.random.Generator, rows: int, dimension: int) -> Cells:
    """Return boxes of every kind: flat, unbounded, huge, empty."""
    lower = random.normal(size=(rows, dimension)) * 10.0 ** random.integers(-3, 4, (rows, dimension))
    upper = lower + random.exponential(size=lower.shape) * (random.random(lower.shape) < 0.9)
    kind = random.random(lower.shape)
    lower, upper = np.where(kind < 0.02, -np.inf, lower), np.where(kind > 0.98, np.inf, upper)
    lower, upper = np.where((kind > 0.02) & (kind < 0.04), -1.5e308, lower), np.where((kind > 0.02) & (kind < 0.04), 1.6e308, upper)
    empty = random.random(rows) < 0.1
    lower[empty], upper[empty] = np.inf, -np.inf
    return Cells(Boxes(lower, upper), random.integers(-1, dimension, rows).astype(np.int16))


def axis_of(lower: FloatArray, upper: FloatArray, last: int, precision: FloatArray, rule: Rule, weights: FloatArray) -> int | None:
    """Return the axis across which one box is cut, by looking at one side after the other."""
    with np.errstate(over="ignore"):
        wide = [k for k in range(len(lower)) if (upper[k] - lower[k]) / precision[k] > 1.0]
        excess = (upper - lower) / precision
    sides = [k for k in wide if math.nextafter(lower[k], math.inf) < upper[k]]
    if not sides:
        return None
    if rule == "round_robin":
        return min(sides, key=lambda k: (k - last - 1) % len(lower))
    return max(sides, key=lambda k: excess[k] if rule == "largest" else weights[k])


@pytest.mark.many
@pytest.mark.parametrize("rule", ["largest", "round_robin", "weights"])
@pytest.mark.parametrize("rows", [0, 1, 37, 1024, 5000])
def test_rows_are_divided_as_one_by_one(rule: str, rows: int) -> None:
    for dimension in (1, 2, 3, 6):
        random = np.random.default_rng(rows + dimension)
        cells = batch(random, rows, dimension)
        precision = random.uniform(0.1, 2.0, dimension)
        kept = ~cells.boxes.empty
        weights = np.where(kept[:, None], random.random((rows, dimension)), 0.0)
        division = Division(cells, precision, (lambda boxes, w=weights[kept]: w) if rule == "weights" else rule)  # type: ignore[arg-type, misc]
        finished, halves = division.carry_out()
        axes = [
            axis_of(low, high, last, precision, rule, w)  # type: ignore[arg-type]
            for low, high, last, w in zip(*(a[kept] for a in (cells.boxes.lower, cells.boxes.upper, cells.last, weights)), strict=True)
        ]
        cut = np.array([axis is not None for axis in axes], dtype=bool)
        left = cells.boxes[kept]
        assert (finished.lower == left.lower[~cut]).all()
        assert (finished.upper == left.upper[~cut]).all()
        chosen = np.array([axis for axis in axes if axis is not None], dtype=np.intp)
        expected = left[cut].bisect(chosen)
        assert (halves.boxes.lower == expected.lower).all()
        assert (halves.boxes.upper == expected.upper).all()
        assert (halves.last == np.repeat(chosen, 2)).all()
        assert (division.finished, division.cut) == (len(finished), len(chosen))


def test_a_stopped_division_finishes_everything() -> None:
    cells = batch(np.random.default_rng(0), 3000, 2)
    division = Division(cells, np.ones(2), "largest")
    assert division.cut > 100
    division.stop()
    finished, halves = division.carry_out()
    left = cells.boxes[~cells.boxes.empty]
    assert (finished.lower == left.lower).all()
    assert (finished.upper == left.upper).all()
    assert len(halves.boxes) == len(halves.last) == 0


@given(st.floats(allow_nan=False, max_value=1e308), st.floats(allow_nan=False, min_value=-1e308))
def test_halves_share_the_cut_and_together_are_the_box(low: float, high: float) -> None:
    low, high = min(low, high), max(low, high)
    cells = Cells.uncut(Boxes(np.array([[low]]), np.array([[high]])))
    division = Division(cells, np.array([5e-324]), "largest")
    finished, halves = division.carry_out()
    if division.cut:
        assert (halves.boxes.lower[0, 0], halves.boxes.upper[1, 0]) == (low, high)
        assert halves.boxes.upper[0, 0] == halves.boxes.lower[1, 0]
        assert low < halves.boxes.upper[0, 0] < high
    else:
        assert math.nextafter(low, math.inf) >= high
        assert len(finished) == 1


def test_of_two_wide_sides_the_one_that_can_be_cut_is() -> None:
    # Between 1e16 and the next double, 2 away, there is none; in units of its precision that side is the wider one.
    cells = Cells.uncut(Boxes.of([(1e16, 1e16 + 2.0), (0.0, 2.0)]))
    for rule in ("largest", "round_robin"):
        _, halves = Division(cells, np.array([0.5, 1.0]), rule).carry_out()  # type: ignore[arg-type]
        assert halves.last.tolist() == [1, 1]


def test_a_bound_that_is_nan_is_refused_even_beside_empty_ones() -> None:
    lower = np.array([[0.0, 0.0], [np.inf, np.inf], [0.0, np.nan]])
    for rule in ("largest", lambda boxes: np.ones(boxes.lower.shape)):
        with pytest.raises(ValueError, match="1 bounds of 3 boxes are NaN"):
            Division(Cells.uncut(Boxes(lower, np.where(np.isinf(lower), -np.inf, 1.0))), np.ones(2), rule)  # type: ignore[arg-type]
