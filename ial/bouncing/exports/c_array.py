"""`CArray`: numbers as a constant table of C, of the narrowest type that holds them, in pieces that every compiler takes."""

import textwrap
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

LARGEST_BYTES = 32_767
"""No array may be larger for avr-gcc, whose `ptrdiff_t` has 16 bits; C99 itself promises 65,535 bytes."""

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
        """How many bytes it takes, without the pointers to its pieces."""
        return self.values.size * self.width // 8

    @property
    def is_split(self) -> bool:
        """Whether it is too large for one array."""
        return self.size > LARGEST_BYTES

    def element(self, *indices: str) -> str:
        """Return the expression for one of its numbers."""
        if not self.is_split:
            return self.name + "".join(f"[{index}]" for index in indices)
        at = f"(uint32_t)({indices[0]})"
        for index, count in zip(indices[1:], self.values.shape[1:], strict=True):
            at = f"{at} * {count}u + (uint32_t)({index})"
        return f"{self.name}_at({at})"

    def declaration(self, qualifier: str) -> str:
        """Return its text; the qualifier follows ``const``."""
        kind = f"const {qualifier} uint{self.width}_t"
        if not self.is_split:
            return f"/* {self.comment} */\nstatic {kind} {self._definition(self.name, self.values)}"
        flat = self.values.reshape(-1)
        bits = (LARGEST_BYTES * 8 // self.width).bit_length() - 1
        pieces = [flat[start : start + 2**bits] for start in range(0, len(flat), 2**bits)]
        names = [f"{self.name}_{number}" for number in range(len(pieces))]
        parts = [f"/* {self.comment}; in pieces, since avr-gcc takes no array above {LARGEST_BYTES:,} bytes */\n"]
        parts += [f"static {kind} {self._definition(name, piece)}" for name, piece in zip(names, pieces, strict=True)]
        listed = _lines(names)
        parts.append(f"static {kind} *const {qualifier} {self.name}_pieces[{len(names)}] = {{\n{listed}\n}};\n")
        parts.append(
            f"static inline uint{self.width}_t {self.name}_at(uint32_t i) {{ "
            f"return {self.name}_pieces[i >> {bits}][i & {2**bits - 1}u]; }}\n"
        )
        return "".join(parts)

    def _definition(self, name: str, values: npt.NDArray[np.integer]) -> str:
        suffix = {32: "u", 64: "ull"}.get(self.width, "")
        if values.ndim == 2:
            items = ["{" + ",".join(f"{each}{suffix}" for each in row) + "}" for row in values.tolist()]
        else:
            items = [f"{each}{suffix}" for each in values.tolist()]
        shape = "".join(f"[{count}]" for count in values.shape)
        return f"{name}{shape} = {{\n{_lines(items)}\n}};\n"


def _lines(items: list[str]) -> str:
    return textwrap.fill(", ".join(items), 100, initial_indent="    ", subsequent_indent="    ", break_long_words=False)
