import math

import numpy as np
import pytest

from ial.contractors import Boxes, from_polar, to_polar, union
from ial.contractors.geometry.coordinates import FromPolar, ToPolar
from tests.contractors.shapes import Inside, Mask, Outside, inside, is_well_formed, random_boxes, same, separator

RING = ((1.0, 3.0), (0.5, 2.0))
SLACK = 1e-9


class Known(Inside):
    def complement(self) -> Outside:
        return Outside(*self.sides)


def plane(count: int, seed: int) -> tuple[Boxes, np.ndarray]:
    """Return boxes near the origin, some of them points, and many points."""
    rng = np.random.default_rng(seed)
    middle, half = rng.uniform(-4, 4, size=(count, 2)), rng.uniform(0, 1.5, size=(count, 2)) * (rng.random((count, 1)) < 0.8)
    return Boxes(middle - half, middle + half), np.concatenate([rng.uniform(-4, 4, size=(1500, 2)), [[0.0, 0.0]], middle])


def within(bounds: tuple[tuple[float, float], ...], pairs: np.ndarray, slack: float) -> Mask:
    return Inside(*((a - slack, b + slack) for a, b in bounds)).holds(pairs)


@pytest.mark.parametrize("start", [-math.pi, 0.0, 100.0, -2 * math.pi])
@pytest.mark.parametrize("turned", [0.0, 2.0, 3.1, -1.0])
def test_a_sector_in_the_plane(start: float, turned: float) -> None:
    lowest = start + (0.5 + turned - start) % (2 * math.pi)
    bounds = (RING[0], (lowest, lowest + 1.5))
    made = from_polar(separator(*bounds), start)
    boxes, points = plane(300, seed=1)
    angle = start + (np.arctan2(points[:, 1], points[:, 0]) - start) % (2 * math.pi)
    pairs = np.stack([np.hypot(*points.T), angle], axis=1)
    inner, outer = made.separate(boxes)
    there = inside(boxes, points)
    assert inside(outer, points)[there & within(bounds, pairs, -SLACK)].all()
    assert inside(inner, points)[there & ~within(bounds, pairs, SLACK)].all()
    assert is_well_formed(inner, boxes)
    assert is_well_formed(outer, boxes)
    inner, outer = made.separate(Boxes(points, points))
    assert inner.empty[within(bounds, pairs, -SLACK)].all()
    assert outer.empty[~within(bounds, pairs, SLACK)].all()
    assert inner.empty.any()


def test_the_contraction_is_strong_also_across_the_cut() -> None:
    everywhere = Boxes.of([(-10, 10), (-10, 10)])
    left = from_polar(union([Inside((1, 2), (3.0, 4.0)), Inside((1, 2), (-4.0, -3.0))])).contract(everywhere)
    np.testing.assert_allclose(left.lower, [[-2.0, -2 * math.sin(math.pi - 3.0)]], atol=1e-12)
    np.testing.assert_allclose(left.upper, [[math.cos(3.0), 2 * math.sin(3.0)]], atol=1e-12)


def test_the_origin_has_every_direction() -> None:
    origin = Boxes.of([(0, 0), (0, 0)])
    assert not from_polar(Inside((0, 1), (0.5, 0.6))).contract(origin).empty[0]
    assert from_polar(Inside((0.1, 1), (0.5, 0.6))).contract(origin).empty[0]
    assert not from_polar(separator((-1, 1), (0.5, 0.6))).inner.contract(origin).empty[0]
    assert from_polar(separator((-1, 1), (-4, 4))).inner.contract(origin).empty[0]


@pytest.mark.parametrize("bounds", [((1.0, 3.0), (-1.0, 2.0)), ((-1.0, 1.0), (-1.0, 1.0))])
def test_a_rectangle_in_polar_coordinates(bounds: tuple[tuple[float, float], ...]) -> None:
    made = to_polar(separator(*bounds))
    rng = np.random.default_rng(2)
    middle, half = rng.uniform((-4, -7), (4, 7), size=(300, 2)), rng.uniform(0, 0.8, size=(300, 2))
    boxes = Boxes(middle - half, middle + half)
    pairs = np.concatenate([rng.uniform((-4, -7), (4, 7), size=(1500, 2)), middle, [[0.0, 1.0]]])
    points = np.stack([pairs[:, 0] * np.cos(pairs[:, 1]), pairs[:, 0] * np.sin(pairs[:, 1])], axis=1)
    inner, outer = made.separate(boxes)
    there = inside(boxes, pairs)
    assert inside(outer, pairs)[there & within(bounds, points, -SLACK)].all()
    assert inside(inner, pairs)[there & ~within(bounds, points, SLACK)].all()
    assert is_well_formed(inner, boxes)
    assert is_well_formed(outer, boxes)
    inner, outer = made.separate(Boxes(pairs, pairs))
    assert inner.empty[within(bounds, points, -SLACK)].all()
    assert outer.empty[~within(bounds, points, SLACK)].all()
    assert inner.empty.any()


def test_unbounded_and_empty_boxes_and_none() -> None:
    boxes = random_boxes(200, 2, seed=3)
    for made in (from_polar(separator(*RING)), to_polar(separator(*RING))):
        for contractor in (made.inner, made.outer):
            narrowed = contractor.contract(boxes)
            assert is_well_formed(narrowed, boxes)
            assert narrowed.empty[boxes.empty].all()
            assert len(contractor.contract(Boxes.none(2))) == 0


def test_complements_follow() -> None:
    boxes, _ = plane(100, seed=4)
    assert same((~FromPolar(Known(*RING), 1.0)).contract(boxes), from_polar(separator(*RING), 1.0).inner.contract(boxes))
    assert same((~ToPolar(Known(*RING))).contract(boxes), to_polar(separator(*RING)).inner.contract(boxes))


def test_bad_input_is_refused() -> None:
    for start in (math.nan, 1001.0, -math.inf):
        with pytest.raises(ValueError, match=r"give a number from -1000\.0 to 1000\.0"):
            from_polar(Inside(*RING), start)
    for change in (from_polar, to_polar):
        with pytest.raises(ValueError, match="Inside has 1 variables; a set of the plane has 2"):
            change(Inside((0, 1)))
        with pytest.raises(ValueError, match="needs 2"):
            change(Inside(*RING)).contract(Boxes.none(1))
