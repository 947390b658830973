"""`OutputEnd`: by what a run knows the file again that its answers go to."""

import hashlib
from dataclasses import dataclass

KEPT = 2**16
"""So many bytes before the end of the file are looked at."""


@dataclass(frozen=True)
class OutputEnd:
    """A file of answers, and the line that comes next.

    Nothing that the file holds is ever cut: a run that was killed while it wrote the line has left the beginning of it, and the next one
    writes the rest.

    Parameters
    ----------
    path
        The file, without links in its path.
    length
        How many bytes of answers it holds.
    sha256
        Of the last `KEPT` of them.
    line
        What is written next.
    """

    path: str
    length: int
    sha256: str
    line: str

    @classmethod
    def of(cls, path: str, length: int, end: bytes, line: str) -> "OutputEnd":
        """Return what to know of a file whose last bytes, at least `KEPT` of them if there are so many, are `end`."""
        return cls(path, length, hashlib.sha256(end[-KEPT:]).hexdigest(), line)

    def rest(self, end: bytes) -> bytes | None:
        """Return what of the line is missing, given the bytes of a file from the `KEPT` before `length` on; None if it is another file."""
        known = min(self.length, KEPT)
        head, begun = end[:known], end[known:]
        line = self.line.encode()
        if len(head) < known or hashlib.sha256(head).hexdigest() != self.sha256 or not line.startswith(begun):
            return None
        return line[len(begun) :]
