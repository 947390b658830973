import pytest

from ial.contractors.algebra import relaxed
from ial.contractors.boxes import Boxes
from ial.contractors.combinators.cylinder import where
from ial.contractors.expressions.function import Function
from ial.contractors.expressions.variables import variables
from ial.contractors.intervals.interval import Interval
from ial.contractors.solving.problem import Problem
from ial.contractors.solving.propagation import Propagation, axes_of
from tests.contractors.solving.test_problem import INF


def test_propagation_reaches_through_chains_of_constraints_and_half_bounded_domains() -> None:
    x = variables("x[30]")
    chain = [x[i + 1] == x[i] + 1 for i in range(29)]
    domains = Problem(x, {x[0]: (0, INF), x[29]: (-INF, 30)}, chain[::-1]).propagate()
    assert all(domains[f"x[{i}]"] == Interval(i, i + 1) for i in range(30))


@pytest.mark.slow
def test_slow_and_endless_propagation_ends() -> None:
    x, y = variables("x y")
    slow = Problem((x, y), {x: (-1, 1), y: (-1, 1)}, [x == y, y == 0.9 * x])
    assert slow.propagate()["x"].width < 0.02
    assert slow.propagate(max_rounds=3)["x"].width > 1.0
    assert slow.propagate(ratio=0.0)["x"].width == pytest.approx(0.0, abs=1e-40)
    endless = Problem((x, y), {x: (0, INF)}, [x == y, y == x + 1])
    assert endless.propagate()["x"].upper == INF
    assert Problem((x, y), {x: (0, 100)}, [x == y, y == x + 1]).propagate()["y"].is_empty


def test_only_what_is_affected_is_contracted_again() -> None:
    calls = []

    class Spy:
        dimension = 3

        def __init__(self, name: str, inner: object, axes: tuple[int, ...]) -> None:
            self.name, self.inner, self.axes = name, inner, axes

        def contract(self, boxes: Boxes) -> Boxes:
            calls.append((self.name, len(boxes)))
            return self.inner.contract(boxes)

    x, y, z = variables("x y z")
    members = [Spy("xy", x == y, (0, 1)), Spy("yz", y == z, (1, 2)), Spy("z", z <= 1.0, (2,))]
    boxes = Boxes.of([(0, 2), (0, 2), (0, 2)], [(0, 1), (0, 1), (0, 1)], [(0, 1), (3, 4), (0, 1)])
    narrowed = Propagation(*members).contract(boxes)
    assert narrowed.upper[:2].max() == 1.0
    assert narrowed.empty.tolist() == [False, False, True]
    # z narrows the first box: yz, and then xy, and each once more since a spy may gain from a second time.
    assert calls[:3] == [("xy", 3), ("yz", 2), ("z", 2)]
    assert set(calls[3:]) <= {("xy", 1), ("yz", 1), ("z", 1)}
    assert [name for name, _ in calls[3:]] == ["yz", "z", "xy", "yz", "xy"]


def test_the_axes_of_constraints_are_known() -> None:
    x, y, z = variables("x y z")
    assert axes_of(x == y) == {0, 1}
    assert axes_of((x == 1) | (z == 2)) == {0, 2}
    assert axes_of(relaxed([x == 1, x == 2], 1)) == {0}
    assert axes_of(where(variables("u") == 1, axes=(2,), dimension=3)) == {2}
    assert axes_of(Function(y).preimage(variables("u") == 1)) == {1}
    assert axes_of(Propagation(y == z)) == {0, 1, 2}
    with pytest.raises(ValueError, match="dimensions"):
        Propagation(x == 1, variables("u") == 1)
