import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.bouncing.automata.partition import coarsest_partition


def twin(successors: list[list[int]], initial: list[int]) -> list[int]:
    """Moore's rounds: split by the blocks of successors until nothing changes."""
    blocks, count = list(initial), 0
    while len(set(blocks)) != count:
        count = len(set(blocks))
        signatures = [(block, *(blocks[to] for to in row)) for block, row in zip(blocks, successors, strict=True)]
        names: dict[tuple[int, ...], int] = {}
        blocks = [names.setdefault(each, len(names)) for each in signatures]
    return blocks


@pytest.mark.slow
@given(st.data())
def test_the_partition_is_that_of_moore(data: st.DataObject) -> None:
    count, letters = data.draw(st.integers(1, 14)), data.draw(st.integers(1, 3))
    row = st.lists(st.integers(0, count - 1), min_size=letters, max_size=letters)
    successors = data.draw(st.lists(row, min_size=count, max_size=count))
    initial = data.draw(st.lists(st.integers(0, 2), min_size=count, max_size=count))
    blocks = coarsest_partition(np.array(successors, dtype=np.int32), np.array(initial, dtype=np.int32))
    assert blocks.tolist() == twin(successors, initial)  # both number blocks by their first states
