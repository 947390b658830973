import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.contractors.boxes import Boxes
from ial.contractors.expressions.function import Function
from ial.contractors.expressions.functions import atan2, floor, sin
from ial.contractors.expressions.variables import variables
from ial.contractors.solving.newton import Newton
from ial.contractors.solving.zeros import certify, zeros

INF = math.inf


def test_a_jump_is_no_zero() -> None:
    x, y = variables("x y")
    pole = Function(1 / x, y)
    assert not certify(pole, Boxes.of([(-1, 1), (-1, 1)], [(-1, 2), (-1, 1)])).unique.any()
    assert not len(zeros(pole, Boxes.of([(-1, 1), (-1, 1)]), 1e-3).unique)
    # The angle jumps from -π to π on the line y = 0; continued without the jump, it would reach the wanted value in the box.
    cut = Function(x + 1, atan2(y, x) - (math.pi + 0.01))
    assert not Newton(cut).step(Boxes.of([(-1.001, -0.999), (-0.05, 0.09)]))[1].any()
    assert Newton(Function(x + 1, atan2(y, x) - (math.pi - 0.05))).step(Boxes.of([(-1.01, -0.99), (0.02, 0.09)]))[1].all()


@pytest.mark.slow
@given(st.integers(0, 10**6))
def test_no_zero_is_lost(seed: int) -> None:
    random = np.random.default_rng(seed)
    n = int(random.integers(1, 5))
    x = variables(f"x[{n}]")
    root = random.integers(-4, 5, n) * 0.25  # so that products of two and the sums are exact
    matrix = random.integers(-3, 4, (n, n)).astype(float)
    square = random.integers(-1, 2, (n, n)).astype(float)
    formulas = []
    for i in range(n):
        value = float(matrix[i] @ root + square[i] @ root**2 + root[i] * root[0])
        formulas.append(sum((matrix[i, j] * x[j] + square[i, j] * x[j] * x[j] for j in range(n)), x[i] * x[0] - value))
    if any(not hasattr(each, "space") or each.space is None for each in formulas):
        return
    function = Function(*formulas)
    widths = 10.0 ** random.uniform(-9, 1, (40, n)) * random.integers(0, 4, (40, n)).clip(0, 1)
    share = random.choice([0.0, 0.5, 1.0, 0.3], (40, n))
    boxes = Boxes(root - share * widths, root + (1.0 - share) * widths)
    newton = Newton(function)
    narrowed = newton.contract(newton.contract(boxes))
    assert narrowed.contain(root.tolist()).all()
    assert narrowed.subset(boxes).all()
    certificate = certify(function, boxes)
    assert certificate.boxes.contain(root.tolist()).all()
    whole = Boxes(np.full((3, n), -INF), np.full((3, n), INF))
    whole.lower[1:], whole.upper[2] = root - 1.0, root + 1e300
    assert newton.contract(whole).contain(root.tolist()).all()


def test_what_cannot_be_solved_is_refused() -> None:
    x, y = variables("x y")
    with pytest.raises(ValueError, match="needs as many of both"):
        Newton(Function(x + y))
    with pytest.raises(TypeError, match="without a derivative"):
        Newton(Function(floor(x), y))
    with pytest.raises(ValueError, match="in 2 boxes; give one"):
        zeros(Function(x, y), Boxes.of([(0, 1), (0, 1)], [(0, 1), (0, 1)]), 0.1)
    with pytest.raises(ValueError, match="dimensions"):
        certify(Function(x, y), Boxes.of([(0, 1)]))
    assert zeros(Function(sin(1000 * x), y), Boxes.of([(-9, 9), (-9, 9)]), 1e-6, max_boxes=20).limited == "boxes"
