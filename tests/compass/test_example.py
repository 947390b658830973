import pytest

from ial.compass.example import example_polygon
from ial.compass.planning import localizing_sequence
from ial.compass.verifier import verify


@pytest.mark.slow
def test_it_is_a_small_building_that_takes_both_parts_of_a_plan() -> None:
    sequence = localizing_sequence(example_polygon())
    verify(sequence)
    assert len(example_polygon().outer) <= 50
    pieces = [pieces for pieces, _ in sequence.sizes]
    assert 0 < pieces.index(0) < len(sequence)
