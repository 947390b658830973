import pytest

from ial.bouncing.cells.corner import passed_cells
from ial.errors import ConfigError
from tests.bouncing.worlds import cell_map, drawn


def test_the_corner_policy() -> None:
    gap = drawn("#. .#")
    slips, held = (cell_map(gap, 45, 8, corner=corner) for corner in ("endpoint", "segment"))
    assert not slips.graph.labels[slips.vertex(0, 0, 1)]
    assert held.graph.labels[held.vertex(0, 0, 1)]
    assert set(passed_cells(1, 1, "segment")) == {(1, 0), (0, 1), (1, 1)}
    assert passed_cells(-2, 1, "segment") == [(-1, 0), (-1, 1), (-2, 1)]
    assert passed_cells(3, 0, "segment") == [(1, 0), (2, 0), (3, 0)]
    assert passed_cells(3, 2, "endpoint") == [(3, 2)]
    with pytest.raises(ConfigError, match="corner policy 'slip'"):
        passed_cells(1, 1, "slip")  # type: ignore[arg-type]
