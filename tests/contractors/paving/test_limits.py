import time

import pytest

from ial.contractors.paving.limits import Deadline


class Clock:
    """A clock that stands still until it is told to go on."""

    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Clock:
    stopped = Clock()
    monkeypatch.setattr(time, "monotonic", stopped)
    return stopped


def test_without_a_limit_everything_is_one_portion(clock: Clock) -> None:
    deadline = Deadline(None)
    clock.now += 1e6
    assert deadline.portion(10**6) == 10**6
    assert deadline.elapsed_s == 1e6


@pytest.mark.parametrize("per_row", [1e-7, 1e-5, 1e-3, 0.05])
@pytest.mark.parametrize("rows", [1, 300, 10**6])
def test_the_time_is_used_and_missed_by_about_one_row(per_row: float, rows: int, clock: Clock) -> None:
    deadline = Deadline(1.0)
    left, portions = rows, 0
    while left and (portion := deadline.portion(left)):
        assert 1 <= portion <= left
        clock.now += portion * per_row
        deadline.worked(portion)
        left -= portion
        portions += 1
        if portions == 1 and per_row > 1e-3:
            break  # nothing was known of the first portion
    assert portions < 60
    if per_row <= 1e-3:
        assert deadline.elapsed_s <= 1.0 + 2.0 * per_row
        assert left == 0 or deadline.elapsed_s > 1.0 - 2.0 * per_row


def test_when_the_time_is_up_there_is_no_portion(clock: Clock) -> None:
    deadline = Deadline(2.0)
    clock.now += 1.9
    assert deadline.portion(5) == 5
    clock.now += 0.2
    assert deadline.portion(5) == 0
    assert Deadline(0.0).portion(5) == 0


def test_a_part_ends_after_a_share_of_what_is_left(clock: Clock) -> None:
    deadline = Deadline(2.0)
    clock.now += 1.0
    part = deadline.part(0.25)
    assert (part.left_s, deadline.left_s) == (0.25, 1.0)
    clock.now += 5.0
    assert deadline.part(0.5).left_s == 0.0
    assert Deadline(None).part(0.5).left_s is None
