"""`Paving`: a set that is enclosed by boxes."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ial.contractors.boxes import Boxes
from ial.contractors.intervals.arithmetic import add, mul, sub
from ial.contractors.intervals.interval import Interval
from ial.contractors.kernels import kernel
from ial.contractors.paving.clusters import Clusters, cluster
from ial.contractors.paving.limits import Limit
from ial.contractors.rounding import check_rounding

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from typing_extensions import Self  # in typing since Python 3.11


@dataclass(frozen=True, eq=False)
class Paving:
    """Boxes that cover a set of solutions, and among them boxes that hold nothing else.

    Parameters
    ----------
    boundary
        Boxes that may hold solutions, none of them empty. Neighbours share faces. From a contractor, all boxes are such.
    inner
        Boxes of solutions, as a separator finds them; the faces that they share with the boundary are solutions if the set is closed.
    limited
        What stopped the search early: "" (nothing: every box reached the wanted precision), "boxes", "time" or "memory". A limited
        paving is coarser, and covers every solution all the same.
    nodes
        How many boxes were contracted.
    """

    boundary: Boxes
    inner: Boxes
    limited: Limit = ""
    nodes: int = 0

    def __repr__(self) -> str:
        stopped = f", stopped early by {self.limited}" if self.limited else ""
        hull = f", hull {' × '.join(map(str, next(iter(self.hull()))))}" if len(self.boxes) else ""
        parts = f"{len(self.inner)} inner box{'es' * (len(self.inner) != 1)}, {len(self.boundary)} of the boundary"
        return f"<Paving in {self.dimension} dimension{'s' * (self.dimension != 1)}: {parts}{hull}{stopped}>"

    def _repr_png_(self) -> bytes | None:
        """Return a picture for a notebook, along the first two axes; None, which shows the text, if there is nothing that can be drawn."""
        seen = self.hull()
        if self.dimension < 2 or not np.isfinite([seen.lower[:, :2], seen.upper[:, :2]]).all():
            return None
        from ial.contractors.paving.drawing import png

        return png(lambda ax: self.draw(ax=ax))

    @cached_property
    def boxes(self) -> Boxes:
        """All boxes, the inner ones first: every solution lies in one of them."""
        return Boxes.concatenate([self.inner, self.boundary]) if len(self.inner) else self.boundary

    @property
    def dimension(self) -> int:
        """The number of dimensions d."""
        return self.boundary.dimension

    def volume(self) -> Interval:
        """Return an interval that holds the volume of the set of solutions, rounded outward.

        The lower bound is the volume of the inner boxes, the upper one that of all boxes. Volumes are added up: where the boxes that were
        searched overlap, the upper bound holds still, the lower one counts some volume twice.
        """
        check_rounding()
        low, high = _volume(self.inner.lower, self.inner.upper)
        return Interval(low, add(low, high, *_volume(self.boundary.lower, self.boundary.upper))[1])

    def hull(self) -> Boxes:
        """Return the one smallest box around all boxes; an empty row if there is none."""
        return self.boxes.hull()

    def contains(self, point: Sequence[float]) -> bool:
        """Return whether a point lies in one of the closed boxes. If not, it is no solution.

        Raises
        ------
        ValueError
            If the point does not have d finite coordinates.
        """
        at = np.asarray(point, dtype=np.float64)
        if at.shape != (self.dimension,) or not np.isfinite(at).all():
            raise ValueError(f"the point is {at.tolist()}; give {self.dimension} finite numbers")
        return bool(self.boxes.contain(at.tolist()).any())

    def clusters(self, circular: Sequence[int] = ()) -> Clusters:
        """Return the connected components of all boxes: see `ial.contractors.paving.clusters.cluster`."""
        return cluster(self.boxes, circular)

    def draw(self, axes: tuple[int, int] = (0, 1), ax: "Axes | None" = None) -> "Axes":
        """Draw the boxes with matplotlib, seen along all but two axes: see `ial.contractors.paving.drawing.draw`."""
        from ial.contractors.paving.drawing import draw

        return draw(self.inner, self.boundary, axes, ax)

    def save(self, path: str | Path) -> None:
        """Write the paving to a file: see `ial.contractors.paving.paving_file.write`."""
        from ial.contractors.paving.paving_file import write

        write(path, self.inner, self.boundary, self.limited, self.nodes)

    @classmethod
    def load(cls, path: str | Path) -> "Self":
        """Read a paving from a file: see `ial.contractors.paving.paving_file.read`."""
        from ial.contractors.paving.paving_file import read

        inner, boundary, limited, nodes = read(path)
        return cls(boundary, inner, limited, nodes)


@kernel
def _volume(lower, upper):  # type: ignore[no-untyped-def]
    """Return an interval around the sum of the volumes of some boxes."""
    low, high = 0.0, 0.0
    for i in range(len(lower)):
        part_low, part_high = 1.0, 1.0
        for axis in range(lower.shape[1]):
            width_low, width_high = sub(upper[i, axis], upper[i, axis], lower[i, axis], lower[i, axis])
            part_low, part_high = mul(part_low, part_high, width_low, width_high)
        low, high = add(low, high, part_low, part_high)
    return low, high
