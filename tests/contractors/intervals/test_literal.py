import math
import re
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.contractors import Interval
from ial.contractors.intervals.literal import bounds_of_literal
from tests.contractors import itf1788

CASE = re.compile(
    r'^\s*b-(?P<kind>textToInterval "(?P<text>[^"]*)"|numsToInterval (?P<numbers>[^=]*)) = (?P<result>\[[^]]*\])(?P<signal>[^;]*);', re.M
)
# The bounds are in the wrong order by less than doubles tell: reading exactly, we need not guess.
MISORDERED = ("[1.0000000000000002,1.0000000000000001]", "[0x1.00000000000002p0,0x1.00000000000001p0]")


def cases(folder: Path, kind: str) -> Iterator[re.Match[str]]:
    for file in sorted(folder.glob("*.itl")):
        yield from (case for case in CASE.finditer(file.read_text()) if case["kind"].startswith(kind))


def expected(case: re.Match[str]) -> itf1788.Pair:
    value = itf1788._value(case["result"].lower())
    assert isinstance(value, tuple)
    return value


def test_itf1788_texts(itf1788_folder: Path) -> None:
    read = refused = 0
    for case in cases(itf1788_folder, "textToInterval"):
        text = case["text"]
        misordered = text in MISORDERED or text.startswith("[10000000000000001/")
        if case["signal"].split() == ["signal", "UndefinedOperation"] or misordered:
            refused += 1
            with pytest.raises(ValueError, match="is no interval"):
                bounds_of_literal(text)
        else:
            read += 1
            assert bounds_of_literal(text) == expected(case), case[0]
    assert read >= 60
    assert refused >= 25


def test_itf1788_numbers(itf1788_folder: Path) -> None:
    vectors = list(cases(itf1788_folder, "numsToInterval"))
    assert len(vectors) >= 8
    for case in vectors:
        bounds = [float(word) for word in case["numbers"].split()]
        if case["signal"].strip():
            with pytest.raises(ValueError, match="an interval has the bounds"):
                Interval(*bounds)
        else:
            assert (Interval(*bounds).lower, Interval(*bounds).upper) == expected(case), case[0]


THIRD = (0.3333333333333333, 0.33333333333333337)


@pytest.mark.parametrize(
    ("text", "bounds"),
    [
        ("[1/3]", THIRD),
        (" [ 1/3 , 1/3 ] ", THIRD),
        ("[,3]", (-math.inf, 3.0)),
        ("[-.5, 1.]", (-0.5, 1.0)),
        ("[0X.8P+1, 0xAp0]", (1.0, 10.0)),
        ("[1e-400]", (0.0, 5e-324)),
        ("[-1e9999, 0]", (-math.inf, 0.0)),
        ("3.56?1E2", (355.0, 357.0)),
        ("10??", (-math.inf, math.inf)),
        ("10??ue3", (10000.0, math.inf)),
        ("-.5?d", (-0.55, -0.5)),
        ("[EMPTY]", (math.inf, -math.inf)),
    ],
)
def test_forms_of_literals(text: str, bounds: itf1788.Pair) -> None:
    low, high = bounds_of_literal(text)
    assert low == pytest.approx(bounds[0], rel=3e-16, abs=0.0)
    assert high == pytest.approx(bounds[1], rel=3e-16, abs=0.0)


@pytest.mark.parametrize(
    "text",
    [
        *("", "1.5", "[1, 2", "1, 2]", "[1, 2, 3]", "[2, 1]", "[2/3, 1/3]", "[inf]", "[-inf, -inf]", "[1/0]", "[1/-3]", "[1e]", "[0x]"),
        *(
            "[.]",
            "[nan]",
            "[1, nan]",
            "[1_000]",
            "[١]",
            "[1, 2]_com",
            "[nai]",
            "?",
            ".?",
            "1.5?3x",
            "1.5?-1",
            "[1.5?]",
            "[1e99999999999]",
            "1?e99999",
        ),
    ],
)
def test_other_texts_are_refused(text: str) -> None:
    with pytest.raises(ValueError, match="is no interval"):
        bounds_of_literal(text)


def test_long_texts_are_refused() -> None:
    with pytest.raises(ValueError, match="at most 4096"):
        bounds_of_literal(f"[{'1' * 5000}]")


@given(st.integers(-(10**20), 10**20), st.integers(0, 10**6), st.integers(0, 8), st.integers(-330, 320), st.sampled_from(["", "u", "d"]))
def test_an_uncertain_number_is_enclosed_tightly(digits: int, radius: int, places: int, exponent: int, direction: str) -> None:
    sign, figures = "-" if digits < 0 else "", f"{abs(digits):0{places + 1}d}"
    text = f"{sign}{figures[: len(figures) - places]}.{figures[len(figures) - places :]}?{radius}{direction}e{exponent}"
    unit = Fraction(10) ** (exponent - places)
    lower = (digits - (radius if direction != "u" else 0)) * unit
    upper = (digits + (radius if direction != "d" else 0)) * unit
    low, high = bounds_of_literal(text)
    assert low <= lower < math.nextafter(low, math.inf)
    assert high >= upper > math.nextafter(high, -math.inf)


@given(st.floats(allow_nan=False), st.floats(allow_nan=False))
def test_printed_intervals_are_read_back(a: float, b: float) -> None:
    if max(a, b) == -math.inf or min(a, b) == math.inf:
        return
    interval = Interval(min(a, b), max(a, b))
    assert Interval.parse(interval.hex()) == interval
    read = Interval.parse(str(interval))
    assert interval in read
    assert read.lower >= math.nextafter(interval.lower, -math.inf)
    assert read.upper <= math.nextafter(interval.upper, math.inf)
