import numpy as np
import pytest

from ial.contractors.algebra import relaxed
from ial.contractors.boxes import Boxes
from ial.contractors.expressions.function import Function
from ial.contractors.expressions.function_family import FunctionFamily
from ial.contractors.expressions.functions import cos, sin, sqrt
from ial.contractors.expressions.variables import variables
from ial.contractors.intervals.interval import Interval


def test_a_family_of_preimages_is_each_of_them() -> None:
    x, y = variables("x y")
    shift, turn = np.array([0.0, 1.0, -2.5]), Boxes.column([0.0, 1.0, -1.0], [0.1, 1.0, -0.5])
    u, v = variables("u v")
    target = (u == Interval(0, 1)) & (v >= 0.25)
    family = FunctionFamily(x + shift[:, None] * cos(turn), sqrt(y) * sin(x + turn)).preimage(target)
    random = np.random.default_rng(0)
    low = random.uniform(-3, 3, (50, 2))
    boxes = Boxes(low, low + random.uniform(0, 3, (50, 2)))
    lower, upper = family.contract_each(boxes)
    assert lower.shape == (50, 3, 2)
    for j in range(3):
        angle = Interval.of_bounds(turn.lower[j, 0], turn.upper[j, 0])
        one = Function(x + float(shift[j]) * cos(angle), sqrt(y) * sin(x + angle)).preimage(target).contract(boxes)
        assert lower[:, j].tobytes() == one.lower.tobytes()
        assert upper[:, j].tobytes() == one.upper.tobytes()
    assert (family.contract(boxes).lower >= lower.max(axis=1)).all()
    assert relaxed(family, 3).contract(boxes).lower.tobytes() == boxes.lower.tobytes()
    assert not relaxed(family, 1).contract(boxes).empty.all()
    assert [bound.shape for bound in family.contract_each(Boxes.none(2))] == [(0, 3, 2)] * 2
    with pytest.raises(ValueError, match="2 values"):
        FunctionFamily(x + shift, y).preimage(variables("w") == 1)
    with pytest.raises(ValueError, match="2 and 3 functions"):
        FunctionFamily(x + shift, y + np.array([1.0, 2.0]))
    with pytest.raises(ValueError, match="use a FunctionFamily"):
        Function(x + shift)
