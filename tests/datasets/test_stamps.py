"""Tests of stamps as integer nanoseconds."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.datasets.stamps import format_stamp, parse_stamp


@given(st.integers(-(2**63), 2**63 - 1))
def test_every_stamp_survives_being_written(stamp: int) -> None:
    assert parse_stamp(format_stamp(stamp)) == stamp


def test_decimals_are_exact() -> None:
    assert parse_stamp("1137772793.094853") == 1137772793094853000
    assert parse_stamp("1663967375.543606542") == 1663967375543606542
    assert parse_stamp("1.6e9") == 1600000000 * 10**9
    assert parse_stamp("1.08499e-42") == 0


@pytest.mark.parametrize("text", ["", "x", "nan", "inf", "1e400000000", "1e11", "-1e11", "9223372036.854775808"])
def test_what_is_no_stamp_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match="time in seconds"):
        parse_stamp(text)
