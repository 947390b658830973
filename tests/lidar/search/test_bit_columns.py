import numpy as np

from ial.lidar.search.bit_columns import BitColumns, read_bits


def test_bits_are_read_across_words_and_outside() -> None:
    random = np.random.default_rng(0)
    mask = random.random((3, 200)) < 0.5
    lines = BitColumns(mask).rightwards
    for first in [*range(-200, 320), -(10**9), 10**9]:
        expected = [0 <= first + i < 200 and bool(mask[1, first + i]) for i in range(64)]
        assert int(read_bits(lines, 1, first)) == sum(1 << i for i, each in enumerate(expected) if each)
    assert int(read_bits(lines, -1, 0)) == int(read_bits(lines, 3, 0)) == 0
