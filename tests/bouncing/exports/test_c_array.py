import numpy as np
import pytest

from ial.bouncing.exports.c_array import CArray


@pytest.mark.parametrize(("most", "width"), [(0, 8), (255, 8), (256, 16), (65535, 16), (65536, 32), (2**32 - 1, 32), (2**32, 64)])
def test_the_narrowest_type_is_chosen(most: int, width: int) -> None:
    array = CArray("t", np.array([0, most]), "x")
    assert array.width == width
    assert array.size == width // 4
    assert f"static const X uint{width}_t t[2]" in array.declaration("X")
