from fractions import Fraction

from ial.compass.bounded_state import BoundedState


def test_intervals_that_overlap_or_touch_are_one() -> None:
    state = BoundedState.of([(1, 0.5, 0.75), (0, 0.0, 0.25), (1, 0.25, 0.5), (1, 0.9, 1.0), (1, 0.3, 0.4)])
    assert state.spans == ((0, 0.0, 0.25), (1, 0.25, 0.75), (1, 0.9, 1.0))
    assert len(state) == 3
    assert repr(state) == "<BoundedState of 3 intervals>"


def test_ends_belong_to_an_interval() -> None:
    state = BoundedState.of([(2, 0.25, 0.5)])
    assert state.holds(2, 0.25)
    assert state.holds(2, Fraction(1, 2))
    assert not state.holds(2, Fraction(1, 2) + Fraction(1, 10**30))
    assert not state.holds(1, 0.3)
