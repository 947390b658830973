import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.contractors.expressions.variables import variables
from ial.contractors.intervals.interval import Interval
from ial.contractors.paving.paver import Progress
from ial.contractors.solving.problem import Problem


def conflicting(seed: int) -> Problem:
    """Return a problem without a solution: some of its constraints would have one."""
    random = np.random.default_rng(seed)
    x, y = variables("x y")
    forms = [x + y, x - y, x * y, x**2 + y**2, x - 2 * y, 2 * x + y, x**2 - y]
    constraints = [forms[i % 7] == Interval(low := random.uniform(-3, 3), low + 0.5) for i in random.permutation(9)]
    return Problem((x, y), {x: (-3, 3), y: (-3, 3)}, constraints)


@pytest.mark.many
@pytest.mark.parametrize("seed", range(8))
def test_a_conflict_is_irreducible(seed: int) -> None:
    problem = conflicting(seed)
    if len(problem.solve(0.05).boxes):
        pytest.fail("choose another seed")
    conflict = problem.why_empty(0.05)
    assert 1 <= len(conflict) < 9
    assert [each for each in problem.constraints if any(each is one for one in conflict)] == list(conflict)

    def boxes(constraints: list[object]) -> Boxes:
        return Problem(variables_of(problem), problem.box, constraints).solve(0.05).boxes

    assert not len(boxes(list(conflict)))
    for left_out in range(len(conflict)):
        assert len(boxes([*conflict[:left_out], *conflict[left_out + 1 :]]))


def variables_of(problem: Problem) -> list[object]:
    from ial.contractors.expressions.expression import Expression

    return [Expression(problem.space, axis=axis) for axis in range(problem.dimension)]


def test_why_empty_names_the_conflict_and_only_it() -> None:
    x, y = variables("x y")
    a, b, c, d = x + y >= 3, x <= 1, y <= 1, x >= 0
    domains = {x: (-9, 9), y: (-9, 9)}
    assert Problem((x, y), domains, [d, a, b, c]).why_empty(0.1) == (a, b, c)
    assert Problem((x, y), domains, [a, b, c, c]).why_empty(0.1) == (a, b, c)
    assert Problem((x, y), domains | {x: (5, 9)}, [a, b, c]).why_empty(0.1) == (b,)
    assert Problem((x, y), {x: Interval.empty()}, [a, b, c]).why_empty(0.1) == ()
    assert Problem((x, y), {x: Interval.empty()}, [a]).propagate() == {"x": Interval.empty(), "y": Interval.empty()}
    calls: list[Progress] = []
    with pytest.raises(ValueError, match="is not proved empty"):
        Problem((x, y), domains, [a, b]).why_empty(0.1, progress=calls.append)
    assert calls
    with pytest.raises(ValueError, match="is not proved empty"):
        Problem((x, y), domains).why_empty(0.1)


@pytest.mark.many
def test_a_finer_precision_proves_more() -> None:
    x, y = variables("x y")
    circle, line = x**2 + y**2 <= 1, x + y >= 1.415
    problem = Problem((x, y), {x: (-2, 2), y: (-2, 2)}, [circle, line])
    with pytest.raises(ValueError, match="precision 1"):
        problem.why_empty(1.0)
    assert problem.why_empty(0.001) == (circle, line)
