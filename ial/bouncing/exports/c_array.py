"""`CArray`: numbers as a constant table of C, of the narrowest type that holds them."""

import textwrap
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

_WIDTHS = (8, 16, 32, 64)


def width_of(most: int) -> int:
    """Return the bits of the narrowest unsigned type that holds a number."""
    return next(width for width in _WIDTHS if most < 2**width)


@dataclass(frozen=True, eq=False)
class CArray:
    """A table.

    Parameters
    ----------
    name
        Its name in C.
    values
        Numbers that are not negative, of one dimension or two.
    comment
        What it holds, in words without special letters.
    """

    name: str
    values: npt.NDArray[np.integer]
    comment: str

    @property
    def width(self) -> int:
        """The bits of each number."""
        return width_of(int(self.values.max()))

    @property
    def size(self) -> int:
        """How many bytes it takes."""
        return self.values.size * self.width // 8

    def declaration(self, qualifier: str) -> str:
        """Return its text; the qualifier follows ``const``."""
        suffix = {32: "u", 64: "ull"}.get(self.width, "")
        if self.values.ndim == 2:
            items = ["{" + ",".join(f"{each}{suffix}" for each in row) + "}" for row in self.values.tolist()]
        else:
            items = [f"{each}{suffix}" for each in self.values.tolist()]
        shape = "".join(f"[{count}]" for count in self.values.shape)
        lines = textwrap.fill(", ".join(items), 100, initial_indent="    ", subsequent_indent="    ", break_long_words=False)
        return f"/* {self.comment} */\nstatic const {qualifier} uint{self.width}_t {self.name}{shape} = {{\n{lines}\n}};\n"
