import numpy as np
import pytest

from ial.bouncing.cells.set_graph import SetGraph, rows_of
from ial.errors import FilterError


def test_rows_are_sorted_and_hold_each_arc_once() -> None:
    starts, ends = rows_of(np.array([2, 0, 2, 2]), np.array([1, 2, 1, 0]), 3)
    assert starts.tolist() == [0, 1, 1, 3]
    assert ends.tolist() == [2, 0, 1]
    with pytest.raises(FilterError, match="leads to vertex 2"):
        SetGraph((starts[:3], starts[:3]), (ends, ends), 2)
