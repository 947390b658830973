import math
import sys
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.contractors import Interval, check_rounding
from ial.contractors.intervals.conversion import from_crival, from_pyinterval, to_crival, to_pyinterval

BOUND = st.floats(allow_nan=False)
INTERVALS = st.just(Interval.empty()) | st.tuples(BOUND, BOUND).map(sorted).filter(lambda b: b[0] < math.inf and b[1] > -math.inf).map(
    lambda b: Interval(*b)
)


@given(INTERVALS)
def test_intervals_go_there_and_back(interval: Interval) -> None:
    pytest.importorskip("interval")
    assert from_crival(to_crival(interval)) == interval
    assert from_pyinterval(to_pyinterval(interval)) == interval
    check_rounding()


def test_a_union_becomes_its_hull() -> None:
    library = pytest.importorskip("interval")
    assert from_pyinterval(library.interval([3, 4], [1, 2])) == Interval(1, 4)
    assert from_pyinterval(library.interval()).is_empty


def test_the_sets_are_those_of_the_other_library() -> None:
    library = pytest.importorskip("ival")
    assert to_crival(Interval.empty()).is_empty()
    assert (to_crival(Interval(1, 2)).lo, to_crival(Interval(1, 2)).hi) == (1.0, 2.0)
    assert from_crival(library.Interval(1.0, 2.0) + library.Interval(1.0)) == Interval(2, 3)
    with pytest.raises(TypeError, match="not one interval of crival"):
        from_crival(library.Interval(np.zeros(2), np.ones(2)))


@pytest.mark.parametrize("other", [3.0, None, "text", [1, 2], SimpleNamespace(lo=None, hi=1.0)])
def test_what_is_no_interval_is_refused(other: Any) -> None:
    with pytest.raises(TypeError, match="not one interval of crival"):
        from_crival(other)
    with pytest.raises(TypeError, match="not an interval of pyinterval"):
        from_pyinterval(other)


@pytest.mark.parametrize(("convert", "module", "package"), [(to_crival, "ival", "crival"), (to_pyinterval, "interval", "pyinterval")])
def test_a_library_that_is_missing_is_named(convert: Any, module: str, package: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(ImportError, match=f"pip install {package}"):
        convert(Interval(1, 2))
