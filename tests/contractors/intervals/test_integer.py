from pathlib import Path
from typing import Any

import numpy as np
import pytest

from ial.contractors.intervals import integer
from tests.cases import cases
from tests.contractors import itf1788
from tests.contractors.oracles import EMPTY, hard_intervals, intervals, kernels_of, wider

COUNT = cases(10_000, 200)
KERNELS = kernels_of(integer)
ITF1788 = {
    "sign": integer.sign,
    "floor": integer.floor,
    "ceil": integer.ceil,
    "trunc": integer.trunc,
    "roundTiesToEven": integer.round_ties_to_even,
    "roundTiesToAway": integer.round_ties_to_away,
}


@pytest.mark.parametrize("kernel", KERNELS)
def test_rounding_is_tight(kernel: Any) -> None:
    halves = np.random.default_rng(1).integers(-9, 9, COUNT) * 0.5
    points = np.concatenate([halves, np.nextafter(halves, np.inf), np.nextafter(halves, -np.inf)])
    for operand in (intervals(COUNT, 2), hard_intervals(COUNT, 3), (points, points)):
        assert not wider(kernel, operand).any()


@pytest.mark.parametrize("operation", ITF1788)
def test_itf1788_vectors_are_met_exactly(operation: str, itf1788_folder: Path) -> None:
    assert len(list(itf1788.cases(itf1788_folder, operation))) >= 5
    assert not itf1788.missed(itf1788_folder, operation, ITF1788[operation], tight=True)


@pytest.mark.parametrize("kernel", KERNELS)
def test_the_empty_interval_stays_empty(kernel: Any) -> None:
    assert kernel(*EMPTY) == EMPTY


def test_halves_go_to_the_even_number_or_away_from_zero() -> None:
    assert integer.round_ties_to_even(-2.5, 3.5) == (-2.0, 4.0)
    assert integer.round_ties_to_away(-2.5, 3.5) == (-3.0, 4.0)
    below_half = 0.49999999999999994
    assert integer.round_ties_to_away(-below_half, below_half) == (0.0, 0.0)
