"""`BitColumns`: the occupied cells of a map as bits, so that 64 neighbours are read at once."""

import numpy as np
import numpy.typing as npt

from ial.contractors.kernels import kernel

_WORD = 64


class BitColumns:
    """Which cells are occupied, packed along both axes.

    Parameters
    ----------
    mask
        The occupied cells, bool of shape (rows, columns).

    Attributes
    ----------
    upwards
        One line of words for each column; bit i counts rows. uint64, with a word of zeros before and two after.
    rightwards
        The same for each row; bit i counts columns.
    """

    def __init__(self, mask: npt.NDArray[np.bool_]) -> None:
        self.upwards = _packed(mask.T)
        self.rightwards = _packed(mask)


def _packed(lines: npt.NDArray[np.bool_]) -> npt.NDArray[np.uint64]:
    count, length = lines.shape
    words = -(-length // _WORD)
    padded = np.zeros((count, words * _WORD), dtype=np.bool_)
    padded[:, :length] = lines
    packed = np.zeros((count, words + 3), dtype=np.uint64)
    packed[:, 1:-2] = np.packbits(padded, axis=1, bitorder="little").view(np.uint64)
    return packed


@kernel
def read_bits(lines, line, first):  # type: ignore[no-untyped-def]
    """Return 64 bits of a line, from bit `first` on; there are none outside of the map."""
    if line < 0 or line >= len(lines):
        return np.uint64(0)
    at = first + _WORD
    word = at >> 6
    if at < 0 or word >= lines.shape[1] - 1:
        return np.uint64(0)
    shift = np.uint64(at & 63)
    low = lines[line, word] >> shift
    if shift == np.uint64(0):
        return low
    return low | (lines[line, word + 1] << (np.uint64(64) - shift))
