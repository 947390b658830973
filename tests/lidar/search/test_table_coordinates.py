"""Bounds in cells against exact fractions: by how much they are off, and how far from a table they are trusted."""

from fractions import Fraction

import numpy as np
import pytest

from ial.contractors.margins import UNIT
from ial.lidar.margins import MOST_CELLS, NEAR
from ial.lidar.search.table_coordinates import in_cells

PROVED = 2.0 * UNIT * MOST_CELLS + 4.0 * UNIT * NEAR
FAR = MOST_CELLS - 65_536


@pytest.mark.parametrize(("width", "split"), [(0.05, 1), (0.07, 1), (0.05, 3), (1.0 / 3.0, 7), (0.0333, 64)])
@pytest.mark.parametrize("origin", [(0, 0), (0, FAR), (FAR, 17)])
def test_bounds_are_off_by_less_than_is_proved(width: float, split: int, origin: tuple[int, int]) -> None:
    random, exact_width = np.random.default_rng(split), Fraction(width) / split
    largest = Fraction(0)
    for _ in range(300):
        at = np.array([*origin[::-1], *origin[::-1]]) + np.sort(random.uniform(-100.0, NEAR - 1.0, (2, 2)), axis=0).reshape(-1)
        box = [float(each * exact_width) for each in map(Fraction, at.tolist())]
        *bounds, near = in_cells(*box, width / split, origin)
        assert near
        for metres, first, cells in zip(box, (*origin[::-1], *origin[::-1]), bounds, strict=True):
            largest = max(largest, abs(Fraction(metres) / exact_width - first - Fraction(cells)))
    assert 0.0 < largest < PROVED
    assert split == 1 or max(origin) < FAR or largest > 0.1 * PROVED  # which is not far from what happens


@pytest.mark.parametrize("side", range(4))
@pytest.mark.parametrize(("beyond", "near"), [(0.0, True), (0.25, False), (np.inf, False)])
def test_a_box_is_near_up_to_the_largest_distance_on_every_side(side: int, beyond: float, near: bool) -> None:
    origin = (40, 70)
    box = [70.0 + 1.0, 40.0 + 1.0, 70.0 + 2.0, 40.0 + 2.0]
    box[side] = origin[1 - side % 2] + (NEAR + beyond) * (-1.0 if side < 2 else 1.0)
    assert in_cells(*(each * 0.5 for each in box), 0.5, origin)[4] is near
