from dataclasses import dataclass, field

from ial.membership import Model, Rejection, SetMembershipFilter

States = frozenset[int]


@dataclass
class Corridor(Model[States, int, set[int]]):
    """Ten places in a row; a motion shifts, a reading allows some places."""

    calls: list[str] = field(default_factory=list)

    def universe(self) -> States:
        return frozenset(range(10))

    def predict(self, states: States, motion: int) -> States:
        self.calls.append("predict")
        return frozenset(place + motion for place in states) & self.universe()

    def contract(self, states: States, reading: set[int]) -> States:
        self.calls.append("contract")
        return states & reading

    def empty(self, states: States) -> bool:
        return not states


def never(states: States, motion: int, reading: set[int]) -> States:
    raise AssertionError("recovery without a rejection")


def test_the_start_is_the_universe_unless_something_is_known() -> None:
    assert SetMembershipFilter(Corridor(), never).states == frozenset(range(10))
    assert SetMembershipFilter(Corridor(), never, frozenset({3})).states == {3}
    assert SetMembershipFilter(Corridor(), never, frozenset()).states == frozenset()


def test_a_step_predicts_and_then_contracts() -> None:
    model = Corridor()
    tracker = SetMembershipFilter(model, never)
    assert tracker.update(2, {0, 3, 5}) is None
    assert tracker.states == {3, 5}
    assert tracker.update(1, {4, 9}) is None
    assert tracker.states == {4}
    assert model.calls == ["predict", "contract"] * 2


def test_an_empty_set_is_one_rejection_and_recovery_gets_the_states_before() -> None:
    asked = []

    def recover(states: States, motion: int, reading: set[int]) -> States:
        asked.append((states, motion, reading))
        return frozenset(reading)

    tracker = SetMembershipFilter(Corridor(), recover, frozenset({1}))
    assert tracker.update(1, {2, 7}) is None
    assert tracker.update(1, {8}) == Rejection(1)
    assert asked == [(frozenset({2}), 1, {8})]
    assert tracker.states == {8}
    assert tracker.update(1, {9}) is None
    assert tracker.update(1, {0}) == Rejection(3)


def test_a_model_may_define_its_own_step() -> None:
    class Jump(Corridor):
        def step(self, states: States, motion: int, reading: set[int]) -> States:
            return frozenset({motion})

    tracker = SetMembershipFilter(Jump(), never)
    tracker.update(4, set())
    assert tracker.states == {4}
