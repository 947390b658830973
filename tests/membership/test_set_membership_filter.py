import pytest

from ial.membership import ContractingModel, Rejection, SetMembershipFilter

States = frozenset[int]


class Corridor(ContractingModel[States, int, set[int]]):
    """Ten places in a row; a motion shifts, a reading allows some places, and the places 5 and 6 turn out to be impossible."""

    def __init__(self) -> None:
        self.calls: list[str] = []

    def universe(self) -> States:
        return frozenset(range(10))

    def predict(self, states: States, motion: int) -> States:
        self.calls.append("predict")
        return frozenset(place + motion for place in states) & self.universe()

    def contract(self, states: States, reading: set[int]) -> States:
        self.calls.append("contract")
        return states & reading

    def unite(self, allowed: States, predicted: States) -> States:
        return allowed | predicted

    def empty(self, states: States) -> bool:
        return not states

    def refine(self, states: States, reading: set[int]) -> States:
        return states - {5, 6}


def test_the_start_is_the_universe_unless_something_is_known() -> None:
    assert SetMembershipFilter(Corridor()).states == frozenset(range(10))
    assert SetMembershipFilter(Corridor(), states=frozenset({3})).states == {3}
    assert SetMembershipFilter(Corridor(), states=frozenset()).states == frozenset()


def test_a_step_predicts_and_then_contracts() -> None:
    model = Corridor()
    tracker = SetMembershipFilter(model)
    assert tracker.update(2, {0, 3, 7}) is None
    assert tracker.states == {3, 7}
    assert tracker.update(1, {4, 9}) is None
    assert tracker.states == {4}
    assert model.calls == ["predict", "contract"] * 2


def test_what_is_refined_away_stays_in_the_set_to_go_on_with() -> None:
    tracker = SetMembershipFilter(Corridor())
    assert tracker.update(1, {3, 5}) is None
    assert (tracker.states, tracker.remaining) == ({3, 5}, {3})


@pytest.mark.parametrize(
    ("recovery", "states"),
    [("union", {8, 3}), ("restart", {8}), ("absorb", set())],
)
def test_an_empty_set_is_one_rejection(recovery: str, states: set[int]) -> None:
    tracker = SetMembershipFilter(Corridor(), recovery, frozenset({1}))  # type: ignore[arg-type]
    assert tracker.update(1, {2, 7}) is None
    assert tracker.update(1, {8}) == Rejection(1)
    assert tracker.states == states
    again = tracker.update(1, {9})
    assert (again is None) == (recovery != "absorb")


@pytest.mark.parametrize(("recovery", "states"), [("union", {9, 5}), ("restart", {9}), ("absorb", set())])
def test_what_is_refined_to_nothing_is_a_rejection(recovery: str, states: set[int]) -> None:
    tracker = SetMembershipFilter(Corridor(), recovery, frozenset({4}))  # type: ignore[arg-type]
    assert tracker.update(1, {5, 9}) == Rejection(0)
    assert tracker.states >= states
    assert 5 in tracker.states or recovery == "absorb"


@pytest.mark.parametrize("recovery", ["union", "restart"])
def test_a_reading_that_fits_nowhere_leaves_the_prediction(recovery: str) -> None:
    for nothing in ({99}, {5}):  # by contraction, and by refinement
        tracker = SetMembershipFilter(Corridor(), recovery, frozenset({1}))  # type: ignore[arg-type]
        assert tracker.update(1, nothing) == Rejection(0)
        assert tracker.states == {2}


def test_what_the_step_has_tried_is_not_tried_again() -> None:
    class Anywhere(Corridor):
        def exhausted(self, states: States, motion: int) -> bool:
            return motion == 0

    model = Anywhere()
    tracker = SetMembershipFilter(model, "restart")
    assert tracker.update(0, {99}) == Rejection(0)
    assert model.calls == ["predict", "contract", "predict"]
    assert tracker.states == frozenset(range(10))
