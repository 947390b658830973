import random
from fractions import Fraction

import pytest

from ial.bouncing.bump_event import BumpEvent
from ial.bouncing.bump_timing import BumpTiming
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.errors import ConfigError, StreamError

START, BUMP = BumpEvent(Fraction(3), "start"), BumpEvent(Fraction(3), "bump")


def drawn(chooser: random.Random, low: Fraction, high: Fraction) -> Fraction:
    """Return a number of an interval; its ends are as likely as all the rest."""
    return chooser.choice([low, high, low + (high - low) * Fraction(chooser.randrange(1001), 1000)])


def test_the_true_way_is_what_the_filter_takes_a_count_to_mean() -> None:
    """Ways that the clock and the speed allow, at their ends too, with the least bounds that are not refused."""
    beside = 0
    for seed in range(5000):
        chooser = random.Random(seed)
        speed, step = Fraction(chooser.randint(1, 40), 20), Fraction(1, chooser.randint(1, 8))
        part, clock = Fraction(chooser.randrange(5), 40), Fraction(chooser.randrange(6), 8)
        timing = BumpTiming(speed, Fraction(0), clock, part)
        on_a_step = step * chooser.randint(0, 9) / speed
        time = drawn(chooser, -clock, Fraction(4)) if chooser.random() < 0.5 else on_a_step
        most = speed * (1 + part) * (time + clock)
        least = max(speed * (1 - part) * (time - clock), Fraction(0))
        way = drawn(chooser, least, most)
        bounds = ExecutionBounds(step=part, count=timing.count_error(step))
        timing.check(step, bounds)
        k = timing.steps(time, step)
        assert (k - bounds.count) * step * (1 - part) <= way <= (k + bounds.count + 1) * step * (1 + part)
        beside += bounds.count > 0 and not (k - bounds.count + 1) * step * (1 - part) <= way <= (k + bounds.count) * step * (1 + part)
    assert beside > 100, "a smaller bound of the count loses some"


def test_bounds_of_a_filter_that_cover_too_little_are_refused() -> None:
    timing = BumpTiming(Fraction(3, 10), Fraction(0), Fraction(1), Fraction(1, 50))
    timing.check(Fraction(1, 4), ExecutionBounds(step=Fraction(1, 50), count=2))
    with pytest.raises(
        ConfigError, match=r"counts up to 2 steps of 0\.25 m wrong at 0\.3 m/s, and the filter is for 1; .* --count-error 2"
    ):
        timing.check(Fraction(1, 4), ExecutionBounds(step=Fraction(1, 50), count=1))
    with pytest.raises(ConfigError, match=r"filter is for steps with an error of 0\.01; build one with --step-error 1/50"):
        timing.check(Fraction(1, 4), ExecutionBounds(step=Fraction(1, 100), count=2))


def test_a_robot_turns_after_a_bump_and_not_after_a_start() -> None:
    timing = BumpTiming(Fraction(1), Fraction(2), Fraction(1, 4))
    bump = BumpEvent(Fraction(6), "bump")
    assert (timing.drive_s(START, bump), timing.drive_s(BUMP, bump)) == (3, 1)


def test_a_bump_with_no_time_to_turn_is_refused_and_one_within_the_tolerance_counts_nothing() -> None:
    timing = BumpTiming(Fraction(1), Fraction(2), Fraction(1, 4))
    early = timing.drive_s(BUMP, BumpEvent(Fraction("4.75"), "bump"))
    assert (early, timing.steps(early, Fraction(1, 100))) == (Fraction(-1, 4), 0)
    with pytest.raises(StreamError, match=r"a\.csv, line 7: the bump comes 1\.5 s after the bump before it, too soon for a turn of 2 s"):
        timing.drive_s(BUMP, BumpEvent(Fraction("4.5"), "bump", where="a.csv, line 7"))


@pytest.mark.parametrize(
    ("time", "clock", "part", "count"),
    [("2", "0", "0", 4), ("1.9", "0", "0", 4), ("2.1", "0.1", "0.05", 4), ("-0.1", "0.1", "0", 0), ("0", "0.4", "0", 0)],
)
def test_cells_are_counted_by_the_nearest_whole_number(time: str, clock: str, part: str, count: int) -> None:
    timing = BumpTiming(Fraction(1), Fraction(0), Fraction(clock), Fraction(part))
    assert timing.whole_steps(Fraction(time), Fraction(1, 2), "line 2") == count


@pytest.mark.parametrize(
    ("time", "clock", "part"), [("1.75", "0", "0"), ("2", "0.5", "0"), ("1.9", "0.4", "0"), ("20", "0", "0.03"), ("0.15", "0.4", "0")]
)
def test_cells_that_cannot_be_counted_for_certain_are_refused(time: str, clock: str, part: str) -> None:
    timing = BumpTiming(Fraction(1), Fraction(0), Fraction(clock), Fraction(part))
    with pytest.raises(StreamError, match=r"line 2: a way of .* is no certain number of cells"):
        timing.whole_steps(Fraction(time), Fraction(1, 2), "line 2")


@pytest.mark.parametrize(
    ("numbers", "message"),
    [((0,), "speed is 0 m/s"), ((1, -1), "time of a turn is -1 s"), ((1, 0, -1), "clock is -1 s"), ((1, 0, 0, 1), "speed is 1 of it")],
)
def test_numbers_that_cannot_be_meant_are_refused(numbers: tuple[int, ...], message: str) -> None:
    with pytest.raises(ConfigError, match=message):
        BumpTiming(*map(Fraction, numbers))
