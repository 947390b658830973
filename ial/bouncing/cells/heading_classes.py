"""`HeadingClasses`: headings that no robot can tell apart, taken together.

Two headings are alike if they move by the same cells, now and after any number of bumps. From one place, robots with such headings give the
same observations for ever and stay at one place, so one vertex of the graph can stand for all of them. With steps of one cell, 360 headings
fall into 8 classes: what the paper calls a resolution of 1° is one of 45°, of unequal widths.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.bouncing.cells.headings import Headings


@dataclass(frozen=True, eq=False)
class HeadingClasses:
    """A partition of headings that bumps respect.

    Parameters
    ----------
    of
        The class of each heading, int32 of shape (headings,).
    offsets
        The cells that a step moves by, int32 of shape (classes, 2).
    turned
        The class after a bump, int32 of shape (classes,).
    sizes
        How many headings each class has, int32 of shape (classes,).
    """

    of: npt.NDArray[np.int32]
    offsets: npt.NDArray[np.int32]
    turned: npt.NDArray[np.int32]
    sizes: npt.NDArray[np.int32]

    def __len__(self) -> int:
        return len(self.sizes)

    @classmethod
    def single(cls, headings: Headings) -> "HeadingClasses":
        """Return one class for each heading."""
        each = np.arange(headings.count).astype(np.int32)
        turned = np.roll(each, -headings.turn)
        return cls(each, headings.offsets, turned, np.ones(headings.count, dtype=np.int32))

    @classmethod
    def merged(cls, headings: Headings) -> "HeadingClasses":
        """Return the coarsest such partition: the quotient by equal offsets."""
        each = np.arange(headings.count)
        visited = (each[:, None] + headings.turn * np.arange(headings.orbit)) % headings.count
        futures = headings.offsets[visited].reshape(headings.count, -1)
        _, begins, named = np.unique(futures, axis=0, return_index=True, return_inverse=True)
        order = np.argsort(begins)  # classes are numbered by their first heading
        rank = np.argsort(order)
        first, of = begins[order], rank[named.reshape(-1)].astype(np.int32)
        turned = of[(first + headings.turn) % headings.count]
        return cls(of, headings.offsets[first], turned, np.bincount(of).astype(np.int32))

    def members(self, index: int) -> list[int]:
        """Return the headings of a class."""
        return [int(heading) for heading in np.flatnonzero(self.of == index)]
