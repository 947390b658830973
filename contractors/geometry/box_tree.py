"""`BoxTree`: which of many boxes meet a box, without looking at each of them."""

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import FloatArray
from ial.contractors.kernels import kernel

_BITS = 62  # of an integer that a place along the curve is written in
_DIGITS = 52  # of a double


@kernel
def following(node):  # type: ignore[no-untyped-def]
    """Return the node that follows a node and all that is below it; the root, 1, after the last. The first child of a node is 2·node."""
    node += 1
    while node & 1 == 0:
        node >>= 1
    return node


def along_curve(points: FloatArray) -> npt.NDArray[np.intp]:
    """Return the order of points of shape (m, d) along Morton's curve, which keeps near points near: the bits of their digits alternate."""
    dimension = points.shape[1]
    bits = min(_BITS // dimension, _DIGITS)
    start = points.min(axis=0)
    extent = float((0.5 * points.max(axis=0) - 0.5 * start).max()) or 1.0
    digits = ((0.5 * points - 0.5 * start) / extent * (2.0**bits - 1.0)).astype(np.int64)
    place = np.zeros(len(points), dtype=np.int64)
    for bit in range(bits):
        for axis in range(dimension):
            place |= (digits[:, axis] >> bit & 1) << (bit * dimension + axis)
    return np.argsort(place, kind="stable")


class BoxTree:
    """Boxes as the leaves of a complete binary tree; each node holds the hull of the boxes below it.

    Nodes are numbered from the root, 1; the children of node i are 2·i and 2·i + 1, and the leaves are the nodes from `leaves` on, in the
    order given by `order` and filled up with empty boxes. A kernel walks the tree without a stack: to 2·i where the children matter, else
    to ``following(i)``, until it is back at 1.

    Parameters
    ----------
    lower, upper
        Bounds of m >= 1 boxes that are finite and not empty, shape (m, d) with d <= 31.

    Attributes
    ----------
    lower, upper
        Bounds of the nodes, shape (2 · leaves, d); row 0 is not used.
    leaves
        The number of leaves, a power of two.
    order
        Which box is at each leaf, shape (m,).
    """

    def __init__(self, lower: FloatArray, upper: FloatArray) -> None:
        count, dimension = lower.shape
        self.leaves = 1 << (count - 1).bit_length()
        self.order = along_curve(0.5 * lower + 0.5 * upper)
        self.lower = np.full((2 * self.leaves, dimension), np.inf)
        self.upper = np.full((2 * self.leaves, dimension), -np.inf)
        self.lower[self.leaves : self.leaves + count] = lower[self.order]
        self.upper[self.leaves : self.leaves + count] = upper[self.order]
        level = self.leaves
        while level > 1:
            parents, children = slice(level // 2, level), slice(level, 2 * level)
            self.lower[parents] = self.lower[children].reshape(-1, 2, dimension).min(axis=1)
            self.upper[parents] = self.upper[children].reshape(-1, 2, dimension).max(axis=1)
            level //= 2
