import math
from functools import cache

import mpmath
import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.contractors.expressions.function import Function
from ial.contractors.expressions.functions import cos, exp, log, sin, sqrt
from ial.contractors.expressions.variables import variables
from ial.contractors.intervals.interval import Interval
from ial.contractors.solving.zeros import certify, zeros
from tests.contractors.solving.test_newton import INF


def polynomial(x: object, coefficients: list[float]) -> object:
    value: object = 0.0
    for coefficient in coefficients:
        value = value * x + coefficient  # type: ignore[operator]
    return value


def inside(boxes: Boxes, root: object) -> bool:
    """Return whether a root, known to many digits, lies in a box of the batch."""
    return any(
        all(low <= value <= high for low, high, value in zip(lower, upper, root, strict=True))
        for lower, upper in zip(boxes.lower.tolist(), boxes.upper.tolist(), strict=True)
    )


@cache
def circle_and_exponential() -> Function:
    x, y = variables("x y")
    return Function(x**2 + y**2 - 4, exp(x) + y - 1)


def exact_roots() -> list[list[object]]:
    with mpmath.workdps(40):
        equations = [lambda x, y: x**2 + y**2 - 4, lambda x, y: mpmath.exp(x) + y - 1]
        return [list(mpmath.findroot(equations, start, tol=1e-60)) for start in ((-1.8, 0.8), (1.0, -1.7))]


def test_the_zeros_of_a_system_are_found_certified_and_tight() -> None:
    solutions = zeros(circle_and_exponential(), Boxes.of([(-10, 10), (-10, 10)]), 0.01)
    assert len(solutions.unique) == 2
    assert not len(solutions.undecided)
    assert not solutions.limited
    assert (solutions.unique.width() < 1e-14).all()
    for root in exact_roots():
        assert inside(solutions.unique, root)


def test_what_is_proved_of_boxes() -> None:
    x = variables("x")
    rows = {(1, 2): "unique", (2, 3): "none", (-2, 2): "unknown", (1.4142135, 1.4142136): "unique", (3, INF): "none", (0, INF): "unknown"}
    certificate = certify(Function(x**2 - 2), Boxes.of(*([row] for row in rows)))
    for at, wanted in enumerate(rows.values()):
        assert [name for name in ("unique", "none", "unknown") if getattr(certificate, name)[at]] == [wanted]
    assert certificate.boxes.width()[0, 0] <= 2.0 * math.ulp(1.5)
    assert certificate.boxes.lower[0, 0] ** 2 <= 2.0 <= certificate.boxes.upper[0, 0] ** 2
    empty = certify(Function(x), Boxes.of([(INF, -INF)]))
    assert empty.none.tolist() == [True]
    assert not len(certify(Function(x), Boxes.none(1)).unique)


def test_the_zero_of_a_linear_function_is_proved_on_the_whole_line_and_that_of_another_is_not() -> None:
    x, y = variables("x y")
    plane = Boxes.of([(-INF, INF), (-INF, INF)])
    certified = certify(Function(x + y - 3, x - y - 1), plane)
    assert certified.unique.tolist() == [True]
    assert certified.boxes.contain([2.0, 1.0]).all()
    assert (certified.boxes.width() < 1e-12).all()
    bent = certify(Function(x + y - 3, x - y - 1 + 0.01 * x * y), plane)
    assert bent.unknown.tolist() == [True]


@pytest.mark.parametrize(
    "make", [lambda x: x**2, lambda x: (x - 1) ** 3, lambda x: abs(x), lambda x: x * x * (x - 1) ** 2, lambda x: 1 - cos(x)]
)
def test_multiple_zeros_stay_unknown(make: object) -> None:
    x = variables("x")
    function = Function(make(x))  # type: ignore[operator]
    assert not certify(function, Boxes.of([(-0.5, 0.7)], [(0.5, 1.7)], [(-3.0, 3.0)])).unique.any()
    solutions = zeros(function, Boxes.of([(-2, 3)]), 1e-3)
    assert not len(solutions.unique)
    root = 0.0 if function.image(Boxes.of([(0, 0)])).contain([0.0])[0] else 1.0
    assert inside(solutions.undecided, [root])


def test_two_dimensional_multiple_zeros_stay_unknown() -> None:
    x, y = variables("x y")
    tangent = Function(x**2 + y**2 - 1, x - 1)  # the line touches the circle
    solutions = zeros(tangent, Boxes.of([(-2, 2), (-2, 2)]), 1e-4)
    assert not len(solutions.unique)
    assert inside(solutions.undecided, [1.0, 0.0])
    line = Function(x + y, 2 * x + 2 * y)  # singular everywhere: a whole line of zeros
    certificate = certify(line, Boxes.of([(-1, 1), (-1, 1)]))
    assert certificate.unknown.all()
    assert certificate.boxes.contain([0.5, -0.5]).all()


def test_no_zero_is_proved() -> None:
    x, y = variables("x y")
    assert certify(Function(x**2 + y**2 + 1, x - y), Boxes.of([(-5, 5), (-5, 5)])).none.all()
    solutions = zeros(Function(x * y - 1, x + y - 1), Boxes.of([(-50, 50), (-50, 50)]), 1e-3)
    assert len(solutions.unique) == len(solutions.undecided) == 0


@pytest.mark.many
def test_a_zero_on_the_border_of_the_box_is_undecided_and_one_beyond_is_not_found() -> None:
    x = variables("x")
    on = zeros(Function(x**2 - Interval(2, 3)), Boxes.of([(1.5, 3)]), 1e-3)  # the zero of some numbers in [2, 3] lies in the box
    assert not len(on.unique)
    assert inside(on.undecided, [1.5])
    assert inside(on.undecided, [1.7])
    exactly = zeros(Function(x**2 - 4), Boxes.of([(2, 3)]), 1e-3)
    assert len(exactly.unique) == 1
    assert inside(exactly.unique, [2.0])
    beyond = zeros(Function(x**2 - 4), Boxes.of([(2.0 + 1e-9, 3)]), 1e-3)
    assert len(beyond.unique) == len(beyond.undecided) == 0
    root = zeros(Function(sqrt(x)), Boxes.of([(0, 4)]), 1e-3)
    assert inside(root.undecided, [0.0])


@pytest.mark.many
def test_zeros_on_the_cuts_of_bisection_are_found_once() -> None:
    x, y = variables("x y")
    solutions = zeros(Function(sin(math.pi * x), sin(math.pi * y)), Boxes.of([(-2.5, 2.5), (-2.5, 2.5)]), 0.05)
    assert len(solutions.unique) == 25
    assert not len(solutions.undecided)
    for i in range(-2, 3):
        for j in range(-2, 3):
            assert (np.abs(solutions.unique.midpoint() - [i, j]).max(axis=1) < 1e-12).sum() == 1


@pytest.mark.many
@pytest.mark.parametrize("seed", range(12))
def test_random_polynomials_have_the_zeros_that_numpy_finds(seed: int) -> None:
    random = np.random.default_rng(seed)
    coefficients = np.poly(random.uniform(-3, 3, int(random.integers(1, 6)))) if seed % 2 else random.normal(size=6)
    x = variables("x")
    solutions = zeros(Function(polynomial(x, coefficients.tolist())), Boxes.of([(-4, 4)]), 1e-4)
    with mpmath.workdps(60):
        roots = mpmath.polyroots([mpmath.mpf(c) for c in coefficients[::-1].tolist()], asc=True, maxsteps=500, extraprec=300)
        real = [root.real for root in map(mpmath.mpc, roots) if abs(root.imag) < mpmath.mpf(10) ** -40 and abs(root.real) < 4]
        assert all(inside(solutions.unique, [root]) or inside(solutions.undecided, [root]) for root in real)
        assert len(solutions.unique) <= len(real)
        for low, high in zip(solutions.unique.lower[:, 0].tolist(), solutions.unique.upper[:, 0].tolist(), strict=True):
            assert sum(low <= root <= high for root in real) == 1
    if not len(solutions.undecided):
        assert len(solutions.unique) == len(real)


@pytest.mark.many
def test_a_certified_box_holds_the_zero_that_mpmath_finds() -> None:
    random = np.random.default_rng(5)
    x, y, z = variables("x y z")
    for _ in range(10):
        a, b, c = random.uniform(0.5, 1.5, 3).tolist()
        function = Function(a * x + 0.2 * sin(y) - 1, b * y + 0.1 * x * z - 0.5, c * z + 0.3 * cos(x) - log(2 + y**2))
        certificate = certify(function, Boxes.of([(-5, 5)] * 3))
        assert certificate.unique.all()
        with mpmath.workdps(40):
            root = mpmath.findroot(
                [
                    lambda u, v, w, a=a: mpmath.mpf(a) * u + mpmath.mpf(0.2) * mpmath.sin(v) - 1,
                    lambda u, v, w, b=b: mpmath.mpf(b) * v + mpmath.mpf(0.1) * u * w - mpmath.mpf(0.5),
                    lambda u, v, w, c=c: mpmath.mpf(c) * w + mpmath.mpf(0.3) * mpmath.cos(u) - mpmath.log(2 + v**2),
                ],
                (1.0, 0.5, 0.5),
                tol=1e-60,
            )
            assert inside(certificate.boxes, list(root))
        assert (certificate.boxes.width() < 1e-14).all()


def test_intervals_as_constants_stand_for_each_of_their_numbers() -> None:
    x = variables("x")
    certificate = certify(Function(x**2 - Interval(2, 3)), Boxes.of([(1, 2)], [(1.5, 2)]))
    assert certificate.unique.tolist() == [True, False]
    assert certificate.boxes.lower[0, 0] == pytest.approx(math.sqrt(2))
    assert certificate.boxes.upper[0, 0] == pytest.approx(math.sqrt(3))


@pytest.mark.many
def test_a_large_linear_system() -> None:
    n = 10
    random = np.random.default_rng(0)
    matrix = np.round(random.normal(size=(n, n)) * 8) + 20 * np.eye(n)
    root = random.integers(-5, 6, n).astype(float)
    x = variables(f"x[{n}]")
    function = Function(*(matrix @ x - matrix @ root))
    certificate = certify(function, Boxes(np.full((1, n), -1e6), np.full((1, n), 1e6)))
    assert certificate.unique.all()
    assert certificate.boxes.contain(root.tolist()).all()
    assert (certificate.boxes.width() < 1e-12).all()
