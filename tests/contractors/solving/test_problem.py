import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.contractors.boxes import Boxes
from ial.contractors.expressions.functions import cos, floor, sin, sqrt
from ial.contractors.expressions.variables import variables
from ial.contractors.geometry.polar import Polar
from ial.contractors.intervals.interval import Interval
from ial.contractors.paving.paver import Progress
from ial.contractors.separator import Separator
from ial.contractors.solving.problem import Problem

INF = math.inf


def test_the_example_of_the_paper_is_exact() -> None:
    x1, x2, x3 = variables("x1 x2 x3")
    problem = Problem((x1, x2, x3), {x1: Interval(7, INF), x2: Interval(-INF, 2), x3: Interval(-INF, 9)}, [x1 == x2 + x3])
    assert problem.propagate() == {"x1": Interval(7, 11), "x2": Interval(-2, 2), "x3": Interval(5, 9)}
    assert problem.domains == {"x1": Interval(7, INF), "x2": Interval(-INF, 2), "x3": Interval(-INF, 9)}


def test_domains_are_given_by_variable_name_order_or_box() -> None:
    x, p = variables("x p[2]")
    wanted = {"x": Interval(1, 2), "p[0]": Interval.entire(), "p[1]": Interval(3)}
    for domains in (
        {x: (1, 2), p[1]: 3},
        {"x": Interval(1, 2), "p[1]": 3},
        [(1, 2), Interval.entire(), 3],
        Boxes.of([(1, 2), (-INF, INF), (3, 3)]),
    ):
        assert Problem((x, p), domains).propagate() == wanted
    assert Problem((x, p)).domains["x"] == Interval.entire()
    alone = variables("x")
    assert Problem(alone, {alone: 1}).domains == {"x": Interval(1)}


def test_what_does_not_fit_is_refused() -> None:
    x, y = variables("x y")
    u, v = variables("u v")
    for given_variables in ((x,), (x, y, y), (x, y, u, v), ()):
        with pytest.raises(ValueError, match="give all variables of one"):
            Problem(given_variables)
    with pytest.raises(TypeError, match="what variables"):
        Problem((x, y + 1))
    with pytest.raises(ValueError, match="'z', which is not a variable"):
        Problem((x, y), {"z": (1, 2)})
    with pytest.raises(ValueError, match="which is not a variable"):
        Problem((x, y), {u: (1, 2)})
    with pytest.raises(ValueError, match="1 domains are given for 2"):
        Problem((x, y), [(1, 2)])
    with pytest.raises(ValueError, match="give one box of 2"):
        Problem((x, y), Boxes.of([(1, 2)]))
    with pytest.raises(ValueError, match="over other variables"):
        Problem((x, y), constraints=[u + v == 1])
    with pytest.raises(ValueError, match="where"):
        Problem((x, y), constraints=[Polar()])
    with pytest.raises(TypeError, match="not a contractor"):
        Problem((x, y), constraints=[Separator.of(x == 1)])
    with pytest.raises(ValueError, match="the ratio is 1"):
        Problem((x, y), constraints=[x == y]).propagate(ratio=1.0)
    with pytest.raises(ValueError, match="the number of rounds is 0"):
        Problem((x, y), constraints=[x == y]).propagate(max_rounds=0)


@pytest.mark.slow
@given(st.integers(0, 10**6))
def test_no_solution_is_lost_and_rows_do_not_depend_on_each_other(seed: int) -> None:
    random = np.random.default_rng(seed)
    x, y, z = variables("x y z")
    at = random.uniform(-2, 2, 3)
    points = {x: at[0], y: at[1], z: at[2]}
    constraints = []
    for formula, value in (
        (x * y + z, at[0] * at[1] + at[2]),
        (x**2 - y * x, at[0] ** 2 - at[1] * at[0]),
        (sin(z) + cos(y), math.sin(at[2]) + math.cos(at[1])),
        (sqrt(x**2 + z**2), math.hypot(at[0], at[2])),
        (floor(x) + y, math.floor(at[0]) + at[1]),
    ):
        if random.random() < 0.7:
            constraints.append(formula == Interval(value - 1e-12, value + random.choice([1e-12, 0.3])))
    problem = Problem((x, y, z), {variable: (value - random.random(), value + 1) for variable, value in points.items()}, constraints)
    assert all(value in domain for value, domain in zip(at, problem.propagate().values(), strict=True))
    boxes = Boxes(at - random.random((20, 3)), at + random.random((20, 3)))
    narrowed = problem.contract(boxes)
    assert narrowed.contain(at.tolist()).all()
    assert narrowed.subset(boxes).all()
    order = random.permutation(20)
    again = problem.contract(boxes[order])
    assert again.lower.tobytes() == narrowed.lower[order].tobytes()
    assert again.upper.tobytes() == narrowed.upper[order].tobytes()


def test_solve_covers_the_solutions_tightly_and_passes_options_on() -> None:
    x, y = variables("x y")
    problem = Problem((x, y), {x: (-2, 2), y: (-2, 2)}, [x**2 + y**2 == 1, x * y + x == 0.5 * (x + y)])
    seen: list[Progress] = []
    paving = problem.solve([1e-6, 1e-6], progress=seen.append, batch=64)
    assert seen
    assert not paving.limited
    assert (paving.boxes.width() <= 1e-6).all()
    for low, high in zip(paving.boxes.lower, paving.boxes.upper, strict=True):
        u, v = 0.5 * (low + high)
        assert u**2 + v**2 == pytest.approx(1.0, abs=1e-4)
    assert problem.solve(1e-6, max_boxes=1).limited == "boxes"
    assert problem.solve(1e-6).boxes.lower.tobytes() == problem.solve(1e-6).boxes.lower.tobytes()


def test_the_mean_value_form_saves_bisections() -> None:
    x, y = variables("x y")
    constraint = x**2 - x * y + y**2 - x == Interval(0.0, 0.001)
    alone = Problem((x, y), {x: (-2, 2), y: (-2, 2)}, [(constraint & (floor(x) <= 9)), x - y == 0.1])  # floor has no derivative
    assert Problem((x, y), {x: (-2, 2), y: (-2, 2)}, [constraint, x - y == 0.1]).solve(1e-3).nodes < 0.7 * alone.solve(1e-3).nodes


def test_families_count_as_one_constraint() -> None:
    x, y = variables("x y")
    beacons = np.array([[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]])
    ranges = Boxes.around(np.hypot(*(beacons - [1.0, 2.0]).T), 0.01)
    family = sqrt((x - beacons[:, 0]) ** 2 + (y - beacons[:, 1]) ** 2) == ranges
    paving = Problem((x, y), {x: (-9, 9), y: (-9, 9)}, [family]).solve(0.01)
    assert paving.contains([1.0, 2.0])
    assert (np.abs(paving.boxes.midpoint() - [1.0, 2.0]) < 0.05).all()
    assert Problem((x, y), {x: (-9, 9), y: (5, 9)}, [x <= 9, family]).why_empty(0.01) == (family,)


def test_a_problem_is_a_contractor() -> None:
    x, y = variables("x y")
    problem = Problem((x, y), {x: (0, 2)}, [x == y])
    both = problem & (y >= 1)
    assert (both.contract(Boxes.of([(-5, 5), (-5, 5)])).lower == [0.0, 1.0]).all()
    assert problem.contract(Boxes.of([(3, 5), (-5, 5)])).empty.all()
    with pytest.raises(ValueError, match="dimensions"):
        problem.contract(Boxes.of([(3, 5)]))


def test_all_sets_of_constraints_of_a_small_problem_agree_with_points() -> None:
    x, y = variables("x y")
    constraints = [x + y <= 1, x >= 0.5, y >= 0.25, x * y <= 0.0]
    holds = [lambda u, v: u + v <= 1, lambda u, v: u >= 0.5, lambda u, v: v >= 0.25, lambda u, v: u * v <= 0]
    grid = list(itertools.product(np.linspace(-2, 2, 33), repeat=2))
    for chosen in itertools.product([False, True], repeat=4):
        paving = Problem((x, y), {x: (-2, 2), y: (-2, 2)}, list(itertools.compress(constraints, chosen))).solve(0.5)
        solutions = [at for at in grid if all(each(*at) for each in itertools.compress(holds, chosen))]
        assert all(paving.contains(at) for at in solutions)
        assert bool(len(paving.boxes)) == bool(solutions)
