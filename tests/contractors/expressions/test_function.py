from typing import Any

import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.contractors.contractor import complement
from ial.contractors.expressions.function import Function, Inverse, Outside
from ial.contractors.expressions.functions import cos, floor, hypot, log, sin, sqrt
from ial.contractors.expressions.variables import variables
from ial.contractors.intervals.interval import Interval
from ial.contractors.separator import Separator
from tests.contractors.formulas import boxes_around, lost

x, y = variables("x y")
u, v = variables("u v")
RING = hypot(u, v) == Interval(1, 2)


def test_image_and_jacobian() -> None:
    function = Function(x + y, x * y, 2.5, Interval(1, 2))
    assert (function.dimension, function.values) == (2, 4)
    box = Boxes.of([(1, 2), (3, 4)], [(np.inf, -np.inf), (np.inf, -np.inf)])
    image = function.image(box)
    assert image.lower[0].tolist() == [4, 3, 2.5, 1]
    assert image.upper[0].tolist() == [6, 8, 2.5, 2]
    assert image.empty.tolist() == [False, True]
    assert (image.lower[1] == np.inf).all()
    lower, upper = function.jacobian(box)
    assert lower.shape == upper.shape == (2, 4, 2)
    assert lower[0].tolist() == [[1, 1], [3, 1], [0, 0], [0, 0]]
    assert upper[0].tolist() == [[1, 1], [4, 2], [0, 0], [0, 0]]
    assert len(function.image(Boxes.none(2))) == 0
    assert function.jacobian(Boxes.none(2))[0].shape == (0, 4, 2)


def test_images_contain_the_values_of_points() -> None:
    rng = np.random.default_rng(1)
    function = Function(sqrt(x) * sin(y), log(x + y) - x)
    points = rng.uniform(0.0, 4.0, (2000, 2))
    boxes = boxes_around(points, rng)
    values = np.stack([np.sqrt(points[:, 0]) * np.sin(points[:, 1]), np.log(points.sum(axis=1)) - points[:, 0]], axis=1)
    image = function.image(boxes)
    margin = 1e-13 * (1.0 + abs(values))
    assert ((image.lower - margin <= values) & (values <= image.upper + margin)).all()
    assert function.image(Boxes.of([(-2, -1), (0, 1)])).empty.all()


def test_where_all_formulas_hold() -> None:
    function = Function(sqrt(x), floor(y))
    boxes = Boxes.of([(0, 1), (0.5, 0.7)], [(-1, 1), (0.5, 0.7)], [(0, 1), (0.5, 1)], [(np.inf, -np.inf)] * 2)
    for _ in range(2):
        assert function.holds("defined", boxes).tolist() == [True, False, True, False]
        assert function.holds("continuous", boxes).tolist() == [True, False, False, False]
    assert Function(x * y).holds("defined", boxes).tolist() == [True, True, True, False]


@pytest.mark.many
@pytest.mark.parametrize("partial", [False, True])
def test_preimages_lose_no_point_of_their_side(partial: bool) -> None:
    rng = np.random.default_rng(2)
    function = Function(sqrt(x) * cos(y), x + 0.5 * y) if partial else Function(x * cos(y), x + 0.5 * y)
    points = rng.uniform(-3.0, 3.0, (4000, 2))
    with np.errstate(invalid="ignore"):
        first = (np.sqrt(points[:, 0]) if partial else points[:, 0]) * np.cos(points[:, 1])
        radius = np.hypot(first, points[:, 0] + 0.5 * points[:, 1])
        inside = (radius > 1.0 + 1e-9) & (radius < 2.0 - 1e-9)
        outside = ~((radius > 1.0 - 1e-9) & (radius < 2.0 + 1e-9))
    boxes = boxes_around(points, rng)
    contractor = function.preimage(RING)
    separator = function.preimage(Separator.of(RING))
    assert isinstance(contractor, Inverse)
    assert isinstance(separator, Separator)
    inner, outer = separator.separate(boxes)
    assert not len(lost(contractor.contract(boxes)[inside], points[inside]))
    assert not len(lost(outer[inside], points[inside]))
    assert not len(lost(inner[outside], points[outside]))
    assert not len(lost(complement(contractor).contract(boxes)[outside], points[outside]))
    assert not len(lost(complement(separator.inner).contract(boxes)[inside], points[inside]))
    assert isinstance(complement(contractor), Outside)
    assert outer.empty.sum() > 100
    assert inner.empty.sum() > 100
    assert inside.sum() > 300
    assert outside.sum() > 300


def test_preimages_with_constant_formulas() -> None:
    box = Boxes.of([(0, 9), (0, 9)])
    a, b = variables("a b")
    assert Function(x, 2.0).preimage((a <= 3) & (b <= 2)).contract(box).upper.tolist() == [[3, 9]]
    assert Function(x, 2.0).preimage((a <= 3) & (b <= 1)).contract(box).empty.all()


@pytest.mark.parametrize(
    ("call", "error", "message"),
    [
        (lambda: Function(1.0, 2.0), ValueError, "no variable in the formulas"),
        (lambda: Function(), ValueError, "no variable in the formulas"),
        (lambda: Function(x, u), ValueError, "declared apart"),
        (lambda: Function(x + np.ones(3)), ValueError, "differ from row to row"),
        (
            lambda: Function(x + floor(y)).jacobian(Boxes.of([(0, 1), (0, 1)])),
            TypeError,
            r"\(x \+ floor\(y\)\) holds an operation without a derivative",
        ),
        (lambda: Function(x).preimage(RING), ValueError, "the function has 1 values; Constraint has 2 dimensions"),
        (lambda: Function(x).image(Boxes.of([(0, 1)])), ValueError, "the boxes have 1 dimensions"),
    ],
)
def test_errors(call: Any, error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message):
        call()
