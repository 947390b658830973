from fractions import Fraction

import pytest

from ial.bouncing.bump_event import BumpEvent
from ial.bouncing.bump_timing import BumpTiming
from ial.bouncing.known_run import KnownRun, known_runs
from ial.errors import StreamError

TIMING = BumpTiming(Fraction(1), Fraction(1))
A, B = (Fraction(1), Fraction(2), Fraction(3)), (Fraction(4), Fraction(5), Fraction(6))


def start(time: int, place: tuple[Fraction, Fraction, Fraction] | None, robot: str = "") -> BumpEvent:
    return BumpEvent(Fraction(time), "start", robot, place, f"line {time}")


def bump(time: int, robot: str = "") -> BumpEvent:
    return BumpEvent(Fraction(time), "bump", robot, None, f"line {time}")


def test_a_start_ends_what_its_robot_did_before_it() -> None:
    events = [start(0, A), bump(3), bump(6), start(7, B), bump(9), start(10, A), start(11, A), bump(12)]
    found = known_runs(events, TIMING)
    assert [(run.place, run.drives_s) for run in found] == [(A, (3, 2)), (B, (2,)), (A, (1,))]
    assert found[1].where == "line 7"


def test_robots_of_one_log_have_runs_of_their_own() -> None:
    events = [start(0, A, "a"), start(5, B, "b"), bump(6, "a"), bump(7, "b"), bump(9, "a")]
    assert known_runs(events, TIMING) == [KnownRun(A, (Fraction(6), Fraction(2)), "line 0"), KnownRun(B, (Fraction(2),), "line 5")]


@pytest.mark.parametrize(
    ("events", "message"),
    [
        ([start(4, None), bump(6)], "line 4: a start at no known place; give x and y"),
        ([bump(6)], "line 6: a bump with no start before it"),
        ([start(4, A, "a"), bump(6, "b")], "line 6: a bump with no start before it"),
        ([start(4, A)], "no start of the log has a bump after it"),
        ([start(4, A), bump(6), bump(6)], "line 6: the bump comes 0 s after the bump before it"),
    ],
)
def test_runs_that_cannot_be_used_are_refused(events: list[BumpEvent], message: str) -> None:
    with pytest.raises(StreamError) as error:
        known_runs(events, TIMING)
    assert message in str(error.value)
