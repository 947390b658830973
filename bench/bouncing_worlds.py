"""Environments like those of Alam et al. 2017, drawn from a seed, since the paper's own maps are not available."""

import numpy as np
import numpy.typing as npt

from ial.maps.polygons.raster import Raster

MaskArray = npt.NDArray[np.bool_]

ROWS, COLUMNS = 125, 200
KINDS = {
    "E1": "a square",
    "E2": "a square, a rectangle",
    "E3": "a square, a rectangle, an L",
    "E4": "a square of random size",
}


def figure_6(kind: str, seed: int) -> Raster:
    """Return a room of 200 × 125 cells with one obstacle at its wall, and the obstacles of a kind inside, placed at random and apart."""
    chooser = np.random.default_rng(seed)
    free = np.ones((ROWS, COLUMNS), dtype=np.bool_)
    free[: ROWS // 5, COLUMNS // 2 - 10 : COLUMNS // 2 + 10] = False
    for shape in _obstacles(kind, chooser):
        rows, columns = shape.shape
        while True:
            row, column = chooser.integers(1, ROWS - rows), chooser.integers(1, COLUMNS - columns)
            around = free[row - 1 : row + rows + 1, column - 1 : column + columns + 1]
            if around.all():
                break
        free[row : row + rows, column : column + columns] &= ~shape
    return Raster(free)


def _obstacles(kind: str, chooser: np.random.Generator) -> list[MaskArray]:
    bend = np.ones((24, 24), dtype=np.bool_)
    bend[12:, 12:] = False
    fixed = [np.ones((20, 20), dtype=np.bool_), np.ones((15, 35), dtype=np.bool_), bend]
    if kind != "E4":
        return fixed[: int(kind[1])]
    width = int(chooser.integers(5, 51))
    return [np.ones((width, width), dtype=np.bool_)]


def lab(seed: int, cells: int = 19) -> Raster:
    """Return so many free cells in one piece, grown at random in a square of 6 × 6."""
    chooser = np.random.default_rng(seed)
    free = np.zeros((8, 8), dtype=np.bool_)
    inside = np.pad(np.ones((6, 6), dtype=np.bool_), 1)
    free[tuple(chooser.integers(1, 7, size=2))] = True
    for _ in range(cells - 1):
        near = np.zeros_like(free)
        near[1:-1, 1:-1] = free[:-2, 1:-1] | free[2:, 1:-1] | free[1:-1, :-2] | free[1:-1, 2:]
        free[tuple(chooser.choice(np.argwhere(near & inside & ~free)))] = True
    return Raster(free)
