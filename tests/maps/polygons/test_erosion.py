from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

from ial.errors import ConfigError
from ial.maps.polygons.erosion import erode
from ial.maps.polygons.raster import Raster

masks = arrays(np.bool_, array_shapes(min_dims=2, max_dims=2, max_side=7))
radii = st.fractions(0, 3, max_denominator=12)


def twin(raster: Raster, radius: Fraction, rule: str) -> list[list[bool]]:
    """Compare every cell with every obstacle around."""
    rows, columns = raster.free.shape
    margin = int(radius / raster.cell) + 2
    obstacles = [
        (row, column)
        for row in range(-margin, rows + margin)
        for column in range(-margin, columns + margin)
        if not (0 <= row < rows and 0 <= column < columns and raster.free[row, column])
    ]
    half = Fraction(1, 2) if rule == "centre" else Fraction(1)

    def clear(row: int, column: int) -> bool:
        gaps = ((max(abs(row - r) - half, Fraction(0)), max(abs(column - c) - half, Fraction(0))) for r, c in obstacles)
        return bool(raster.free[row, column]) and all((a * a + b * b) * raster.cell**2 >= radius**2 for a, b in gaps)

    return [[clear(row, column) for column in range(columns)] for row in range(rows)]


@pytest.mark.slow
@given(masks, radii, st.sampled_from(["inside", "centre"]), st.sampled_from([Fraction(1), Fraction(2, 3)]))
def test_erosion_is_what_the_definition_says(free: np.ndarray, radius: Fraction, rule: str, cell: Fraction) -> None:
    raster = Raster(free, cell)
    assert erode(raster, radius, rule).free.tolist() == twin(raster, radius, rule)  # type: ignore[arg-type]


def test_a_disk_may_touch_and_a_hair_more_is_too_much() -> None:
    free = np.ones((5, 5), dtype=np.bool_)
    assert erode(Raster(free), Fraction(5, 2), "centre").free.sum() == 1
    assert erode(Raster(free), Fraction(5, 2) + Fraction(1, 10**20), "centre").free.sum() == 0
    assert erode(Raster(free), Fraction(2), "inside").free.sum() == 1
    diagonal = np.ones((9, 9), dtype=np.bool_)
    diagonal[0, 0] = False  # 3-4-5: the square's corner (1, 1) is exactly 5 from the corner (4, 5) of the cell in row 5, column 4
    assert erode(Raster(np.pad(diagonal, ((0, 9), (0, 9)), constant_values=True)), Fraction(4), "inside").free[5, 4]
    assert not erode(Raster(np.pad(diagonal, ((0, 9), (0, 9)), constant_values=True)), Fraction(4), "inside").free[3, 4]


def test_a_negative_radius_is_refused() -> None:
    with pytest.raises(ConfigError, match="radius of the robot is -1"):
        erode(Raster(np.ones((2, 2), dtype=np.bool_)), Fraction(-1))
