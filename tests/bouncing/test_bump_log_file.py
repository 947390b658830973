from fractions import Fraction
from pathlib import Path

import pytest

from ial.bouncing.bump_event import BumpEvent
from ial.bouncing.bump_log import bump_events
from ial.bouncing.bump_log_file import log_form, write_log
from ial.errors import OutputError, StreamError

PLACE = (Fraction(1, 3), Fraction(-5, 2), Fraction(1, 10**9))
EVENTS = [BumpEvent(Fraction(0), "start", "a b", PLACE), BumpEvent(Fraction(2_000_000_001, 10**9), "bump", "a b")]


@pytest.mark.parametrize("name", ["bumps.csv", "bumps.jsonl"])
def test_a_log_is_read_back(tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    write_log(EVENTS, path)
    assert list(bump_events(path.read_bytes().splitlines(keepends=True), name, log_form(path))) == EVENTS


def test_only_columns_that_hold_something_are_written(tmp_path: Path) -> None:
    write_log([BumpEvent(Fraction(0), "start"), BumpEvent(Fraction(-5, 4), "bump")], tmp_path / "a.csv")
    assert (tmp_path / "a.csv").read_text() == "time,event\n0,start\n-1.25,bump\n"
    write_log(EVENTS, tmp_path / "b.CSV")
    assert (tmp_path / "b.CSV").read_text().splitlines()[1] == "0,start,a b,1/3,-2.5,0.000000001"


def test_other_names_and_places_are_refused(tmp_path: Path) -> None:
    with pytest.raises(StreamError, match=r"a log is named \.csv"):
        write_log(EVENTS, tmp_path / "bumps.txt")
    with pytest.raises(OutputError, match="the log cannot be written"):
        write_log(EVENTS, tmp_path / "nowhere" / "bumps.csv")
