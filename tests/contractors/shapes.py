"""What the tests of combinators share: sets of the simplest kind, with contractors that are exact and membership that is obvious."""

import numpy as np
import numpy.typing as npt

from ial.contractors import Boxes, Contractor, Separator
from ial.contractors.boxes import FloatArray

Mask = npt.NDArray[np.bool_]


class Inside:
    """One closed box; a contractor that does not know the base class."""

    def __init__(self, *sides: tuple[float, float]) -> None:
        self.sides = np.array(sides, dtype=np.float64)
        self.dimension = len(sides)

    def contract(self, boxes: Boxes) -> Boxes:
        lower, upper = np.maximum(boxes.lower, self.sides[:, 0]), np.minimum(boxes.upper, self.sides[:, 1])
        return Boxes(lower, upper).where((lower <= upper).all(axis=1))

    def holds(self, points: FloatArray) -> Mask:
        return np.asarray(((self.sides[:, 0] <= points) & (points <= self.sides[:, 1])).all(axis=-1))


class Outside:
    """The rest of the space, and the boundary."""

    def __init__(self, *sides: tuple[float, float]) -> None:
        self.sides = np.array(sides, dtype=np.float64)
        self.dimension = len(sides)

    def contract(self, boxes: Boxes) -> Boxes:
        """Cut off what lies inside, where it does on all other axes: one row, one axis at a time. The boundary stays."""
        lower, upper = boxes.lower.copy(), boxes.upper.copy()
        for i in range(len(boxes)):
            within = (self.sides[:, 0] < lower[i]) & (upper[i] < self.sides[:, 1])
            for axis, (a, b) in enumerate(self.sides):
                if np.delete(within, axis).all():
                    lower[i, axis] = b if a < lower[i, axis] < b else lower[i, axis]
                    upper[i, axis] = a if a < upper[i, axis] < b else upper[i, axis]
        return Boxes(lower, upper).where((lower <= upper).all(axis=1))

    def holds(self, points: FloatArray) -> Mask:
        return np.asarray(~((self.sides[:, 0] < points) & (points < self.sides[:, 1])).all(axis=-1))


class Points(Contractor):
    """A finite set: a box shrinks to the hull of its points."""

    def __init__(self, points: FloatArray) -> None:
        self.points = np.asarray(points, dtype=np.float64)
        self.dimension = self.points.shape[1]

    def contract(self, boxes: Boxes) -> Boxes:
        here = ((boxes.lower[:, None] <= self.points) & (self.points <= boxes.upper[:, None])).all(axis=2)[:, :, None]
        lower = np.where(here, self.points, np.inf).min(axis=1, initial=np.inf)
        return Boxes(lower, np.where(here, self.points, -np.inf).max(axis=1, initial=-np.inf))


class Several:
    """A family of closed boxes, given by bounds of shape (m, d)."""

    def __init__(self, lower: FloatArray, upper: FloatArray) -> None:
        self.lower, self.upper = lower, upper
        self.count, self.dimension = lower.shape
        self.largest_batch = 0

    def contract_each(self, boxes: Boxes) -> tuple[FloatArray, FloatArray]:
        self.largest_batch = max(self.largest_batch, len(boxes))
        lower, upper = np.maximum(boxes.lower[:, None], self.lower), np.minimum(boxes.upper[:, None], self.upper)
        empty = (lower > upper).any(axis=2, keepdims=True)
        return np.where(empty, np.inf, lower), np.where(empty, -np.inf, upper)

    def one_by_one(self) -> list[Inside]:
        return [Inside(*zip(low, high, strict=True)) for low, high in zip(self.lower, self.upper, strict=True)]


def separator(*sides: tuple[float, float]) -> Separator:
    """One closed box as a separator."""
    return Separator(inner=Outside(*sides), outer=Inside(*sides))


def random_boxes(count: int, dimension: int, seed: int, size: int = 8) -> Boxes:
    """Return boxes with integer bounds, so that these often coincide; some are points, some unbounded, some empty."""
    rng = np.random.default_rng(seed)
    lower, upper = np.sort(rng.integers(0, size, size=(2, count, dimension)), axis=0).astype(np.float64)
    lower[rng.random(lower.shape) < 0.05] = -np.inf
    upper[rng.random(upper.shape) < 0.05] = np.inf
    return Boxes(lower, upper).where(rng.random(count) > 0.1)


def lattice(dimension: int, size: int = 8, step: float = 0.5) -> FloatArray:
    """Return the points of a lattice that has the bounds of `random_boxes` and the points between them."""
    axis = np.arange(-1.0, size + 0.5, step)
    return np.stack(np.meshgrid(*[axis] * dimension, indexing="ij"), axis=-1).reshape(-1, dimension)


def inside(boxes: Boxes, points: FloatArray) -> Mask:
    """Return which points lie in which box, shape (n, number of points)."""
    return np.asarray(((boxes.lower[:, None] <= points) & (points <= boxes.upper[:, None])).all(axis=2))


def sides(boxes: Boxes) -> list[list[tuple[float, float]]]:
    return [list(zip(low, high, strict=True)) for low, high in zip(boxes.lower.tolist(), boxes.upper.tolist(), strict=True)]


def same(a: Boxes, b: Boxes) -> bool:
    return sides(a) == sides(b)


def is_well_formed(boxes: Boxes, before: Boxes) -> bool:
    """Return whether boxes are within those before, and empty rows are empty in every dimension."""
    empty = boxes.empty
    within = ((boxes.lower >= before.lower) & (boxes.upper <= before.upper)).all(axis=1) | empty
    return bool(within.all() and np.isposinf(boxes.lower[empty]).all() and np.isneginf(boxes.upper[empty]).all())
