"""`SetStore`: sets of vertices as bits, and which of them holds another set with the least to spare."""

import numpy as np
import numpy.typing as npt

from ial.contractors.kernels import kernel

_WORD = 64


@kernel
def _least_superset(wanted, bits, sizes, colours, count, least, most, colour):  # type: ignore[no-untyped-def]
    """Return the number of the smallest of the first sets that has least … most elements and the colour, and holds all of another; −1."""
    best = -1
    for at in range(count):
        if least <= sizes[at] <= most and colours[at] == colour:
            held = True
            for word in range(len(wanted)):
                if wanted[word] & ~bits[at, word]:
                    held = False
                    break
            if held:
                best, most = at, sizes[at] - 1
    return best


class SetStore:
    """Sets of vertices, numbered as they come, each with a colour.

    Parameters
    ----------
    vertices
        How many vertices there are.
    """

    def __init__(self, vertices: int) -> None:
        self._words = -(-vertices // _WORD)
        self._bits = np.empty((256, self._words), dtype=np.uint64)
        self._sizes = np.empty(256, dtype=np.int64)
        self._colours = np.empty(256, dtype=np.int32)
        self._count = 0

    def __len__(self) -> int:
        return self._count

    def __repr__(self) -> str:
        return f"<SetStore of {self._count} sets>"

    @property
    def sizes(self) -> npt.NDArray[np.int64]:
        """How many vertices each set has, int64 of shape (sets,)."""
        return self._sizes[: self._count].copy()

    @property
    def colours(self) -> npt.NDArray[np.int32]:
        """The colour of each set, int32 of shape (sets,)."""
        return self._colours[: self._count].copy()

    def colour(self, number: int) -> int:
        """Return the colour of a set."""
        return int(self._colours[number])

    def find(self, vertices: npt.NDArray[np.int32], colour: int, most: int) -> int:
        """Return the number of the smallest set of a colour that holds these vertices and has at most so many; −1 if there is none."""
        arrays = self._bits, self._sizes, self._colours
        return int(_least_superset(self._packed(vertices), *arrays, self._count, len(vertices), most, colour))

    def add(self, vertices: npt.NDArray[np.int32], colour: int) -> int:
        """Keep a set; return its number."""
        if self._count == len(self._sizes):
            self._bits, self._sizes, self._colours = (
                np.concatenate([each, np.empty_like(each)]) for each in (self._bits, self._sizes, self._colours)
            )
        self._bits[self._count], self._sizes[self._count], self._colours[self._count] = self._packed(vertices), len(vertices), colour
        self._count += 1
        return self._count - 1

    def _packed(self, vertices: npt.NDArray[np.int32]) -> npt.NDArray[np.uint64]:
        flags = np.zeros(self._words * _WORD, dtype=np.uint8)
        flags[vertices] = 1
        return np.packbits(flags, bitorder="little").view(np.uint64)
