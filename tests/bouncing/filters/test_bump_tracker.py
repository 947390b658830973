from fractions import Fraction

import pytest

from ial.bouncing.bump_event import BumpEvent, EventKind
from ial.bouncing.bump_timing import BumpTiming
from ial.bouncing.cells.headings import Headings
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.filters.building import build_filter
from ial.bouncing.filters.bump_tracker import BumpTracker, Legs, legs_of
from ial.bouncing.filters.goal import Goal
from ial.bouncing.filters.piece_filter import PieceFilter
from ial.bouncing.filters.piece_legs import PieceLegs
from ial.bouncing.filters.table_legs import TableLegs
from ial.bouncing.rays.piece_map import PieceMap
from ial.errors import StreamError
from tests.bouncing.judged_runs import WORLDS
from tests.bouncing.rays.test_real_robot import ROOM

ANGLE, STEP, NONE = Fraction(100), Fraction(1, 4), ExecutionBounds()
TIMING, HALF = BumpTiming(Fraction(1), Fraction(1)), Fraction(1, 2)


@pytest.fixture(scope="module")
def legs() -> Legs[object]:
    return legs_of(PieceFilter(PieceMap.of(ROOM, ANGLE, STEP, NONE, HALF, 36), "room", ANGLE, STEP, NONE, Goal(width=Fraction(5))), TIMING)


def event(time: object, kind: EventKind = "bump") -> BumpEvent:
    return BumpEvent(Fraction(str(time)), kind, where="a.csv, line 9")


def test_filters_of_all_kinds_take_legs(legs: Legs[object]) -> None:
    assert isinstance(legs, PieceLegs)
    assert isinstance(legs_of(build_filter({"L": WORLDS["L"]}, Headings.of_angle(Fraction(90)), Fraction(1), HALF), TIMING), TableLegs)


def test_bumps_are_counted_and_a_room_of_4_m_is_known_to_5_m_at_the_first(legs: Legs[object]) -> None:
    tracker = BumpTracker(legs)
    assert not tracker.take(event(10, "start"))
    assert (tracker.bumps, tracker.localized_at, tracker.last_s) == (0, None, 10)
    assert not tracker.take(event("12.5"))
    assert (tracker.bumps, tracker.localized_at, tracker.localized_s, tracker.localized) == (1, 1, Fraction("12.5"), True)
    assert not tracker.take(event(16))
    assert (tracker.bumps, tracker.localized_at, tracker.last_s) == (2, 1, 16)


def test_a_way_that_is_too_long_is_a_rejection_once(legs: Legs[object]) -> None:
    tracker = BumpTracker(legs)
    assert [tracker.take(each) for each in (event(0), event(100), event(103), event(200))] == [False, True, False, False]
    assert tracker.rejected_at == [2]
    assert legs.empty(tracker.states)


def test_after_a_restart_the_robot_leaves_from_any_wall(legs: Legs[object]) -> None:
    tracker = BumpTracker(legs, restart=True)
    assert [tracker.take(each) for each in (event(0), event(100), event(103), event(200))] == [False, True, False, True]
    assert tracker.rejected_at == [2, 4]
    assert not legs.empty(tracker.states)


@pytest.mark.parametrize("first", ["start", "bump"])
def test_a_second_start_is_refused(legs: Legs[object], first: EventKind) -> None:
    tracker = BumpTracker(legs)
    tracker.take(event(0, first))
    with pytest.raises(StreamError, match=r"a\.csv, line 9: the robot starts a second time"):
        tracker.take(event(1, "start"))


def test_times_are_looked_at_after_a_rejection_too(legs: Legs[object]) -> None:
    tracker = BumpTracker(legs)
    tracker.take(event(0))
    tracker.take(event(100))
    with pytest.raises(StreamError, match="too soon for a turn of 1 s"):
        tracker.take(event("100.5"))
