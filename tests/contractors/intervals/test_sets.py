import math
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import ival
import numpy as np
import pytest

from ial.contractors.intervals import sets
from tests.contractors import itf1788
from tests.contractors.oracles import EMPTY, ENTIRE, LARGEST, TINY, Pairs, intervals, kernels_of, wider

COUNT = 10_000

ITF1788 = {
    "intersection": sets.intersect,
    "convexHull": sets.hull,
    "isEmpty": sets.is_empty,
    "isEntire": sets.is_entire,
    "isSingleton": sets.is_singleton,
    "isCommonInterval": sets.is_common,
    "isMember": sets.member,
    "equal": sets.equal,
    "subset": sets.subset,
    "interior": sets.interior,
    "disjoint": sets.disjoint,
    "less": sets.less,
    "strictLess": sets.strict_less,
    "precedes": sets.precedes,
    "strictPrecedes": sets.strict_precedes,
    "overlap": lambda *bounds: sets.OVERLAPS[sets.overlap(*bounds)],
    "inf": sets.inf,
    "sup": sets.sup,
    "mid": sets.midpoint,
    "rad": sets.radius,
    "midRad": sets.mid_rad,
    "wid": sets.width,
    "mag": sets.magnitude,
    "mig": sets.mignitude,
}


@pytest.mark.parametrize("operation", ITF1788)
def test_itf1788_vectors_are_met_exactly(operation: str, itf1788_folder: Path) -> None:
    assert len(list(itf1788.cases(itf1788_folder, operation))) >= 5
    assert not itf1788.missed(itf1788_folder, operation, ITF1788[operation], tight=True)


@pytest.mark.parametrize("kernel", kernels_of(sets))
def test_set_operations_are_tight(kernel: Any) -> None:
    assert not wider(kernel, intervals(COUNT, 1), intervals(COUNT, 2)).any()


def answers(kernel: Callable[..., Any], *operands: Pairs) -> np.ndarray:
    return np.array([kernel(*row) for row in zip(*(bound.tolist() for pair in operands for bound in pair), strict=True)])


def theirs(pair: Pairs) -> Any:
    return ival.Interval(*(np.where(pair[0] > pair[1], np.nan, bound) for bound in pair))


@pytest.mark.parametrize("name", ["subset", "interior", "disjoint", "equal"])
def test_questions_have_the_answers_of_the_oracle(name: str) -> None:
    a, b = intervals(COUNT, 3), intervals(COUNT, 4)
    rng = np.random.default_rng(5)
    b = tuple(np.where(rng.random(COUNT) < 0.4, same, other) for same, other in zip(a, b, strict=True))  # shared bounds
    none = (b[0] > b[1]) | (b[0] == np.inf) | (b[1] == -np.inf)
    b = tuple(np.where(none, end, bound) for end, bound in zip(EMPTY, b, strict=True))
    ours = answers(getattr(sets, name), a, b)
    assert (ours == getattr(theirs(a), name)(theirs(b))).all()
    assert ours.any()
    assert not ours.all()


@pytest.mark.parametrize(
    ("kernel", "name"),
    [(sets.midpoint, "mid"), (sets.radius, "rad"), (sets.width, "wid"), (sets.magnitude, "mag"), (sets.mignitude, "mig")],
    ids=lambda part: getattr(part, "__name__", part),
)
def test_numbers_are_those_of_the_oracle(kernel: Any, name: str) -> None:
    a = intervals(COUNT, 6)
    np.testing.assert_array_equal(answers(kernel, a), getattr(theirs(a), name))


def test_midpoint_and_radius_enclose() -> None:
    for lower, upper in zip(*(bound.tolist() for bound in intervals(COUNT, 7)), strict=True):
        if -math.inf < lower <= upper < math.inf:
            middle, radius = sets.mid_rad(lower, upper)
            assert lower <= middle <= upper
            assert radius == math.inf or Fraction(middle) - Fraction(radius) <= lower
            assert radius == math.inf or upper <= Fraction(middle) + Fraction(radius)


def test_numbers_at_the_edges() -> None:
    assert sets.midpoint(*ENTIRE) == 0.0
    assert sets.midpoint(0.0, math.inf) == LARGEST == -sets.midpoint(-math.inf, 0.0)
    assert sets.midpoint(-LARGEST, LARGEST) == 0.0
    assert sets.midpoint(LARGEST, LARGEST) == LARGEST
    assert sets.width(-LARGEST, LARGEST) == math.inf
    assert sets.width(0.0, TINY) == TINY
    assert (sets.inf(*EMPTY), sets.sup(*EMPTY)) == EMPTY
    for kernel in (sets.midpoint, sets.radius, sets.width, sets.magnitude, sets.mignitude):
        assert math.isnan(kernel(*EMPTY))


@pytest.mark.parametrize("x", [math.nan, math.inf, -math.inf])
def test_what_is_no_real_number_is_no_member(x: float) -> None:
    assert not sets.member(x, *ENTIRE)


def test_every_state_of_overlap_has_its_converse() -> None:
    a, b = intervals(COUNT, 8), intervals(COUNT, 9)
    bounds = np.sort(np.random.default_rng(10).integers(0, 4, (COUNT, 2, 2)).astype(float), axis=2)
    a = tuple(np.concatenate([a[i], bounds[:, 0, i]]) for i in range(2))
    b = tuple(np.concatenate([b[i], bounds[:, 1, i]]) for i in range(2))
    ours = answers(sets.overlap, a, b)
    converse = np.array([0, 2, 1, *range(15, 2, -1)])
    assert (answers(sets.overlap, b, a) == converse[ours]).all()
    assert set(ours) == set(range(16))
