"""Pictures of pavings."""

import io
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import Boxes

if TYPE_CHECKING:
    from collections.abc import Callable

    from matplotlib.axes import Axes

INNER_COLOUR, BOUNDARY_COLOUR = "#7fb8a4", "#f2c14e"
_FEW = 5000  # with more boxes, their edges would hide them


def draw(inner: Boxes, boundary: Boxes, axes: tuple[int, int] = (0, 1), ax: "Axes | None" = None) -> "Axes":
    """Draw inner boxes over those of the boundary, seen along all but two axes.

    Parameters
    ----------
    inner, boundary
        Boxes of one dimension d >= 2.
    axes
        The axes of the boxes that are drawn to the right and upward.
    ax
        Where to draw; the current axes of matplotlib by default.

    Returns
    -------
    matplotlib.axes.Axes
        Where it was drawn.

    Raises
    ------
    ValueError
        If the axes are not two different ones of the boxes, or if a box is unbounded there.
    """
    across, along = axes
    if across == along or not all(0 <= axis < boundary.dimension for axis in axes):
        raise ValueError(
            f"axes {axes} of boxes of {boundary.dimension} dimensions were to be drawn; give two different ones, counted from 0"
        )
    from matplotlib import pyplot
    from matplotlib.collections import PolyCollection

    ax = pyplot.gca() if ax is None else ax
    few = len(inner) + len(boundary) <= _FEW
    for boxes, colour, label in ((boundary, BOUNDARY_COLOUR, "boundary"), (inner, INNER_COLOUR, "inner")):
        if len(boxes):
            corners = list(_corners(boxes, across, along))
            # Lines in their own colour show boxes that are narrower than a pixel; if smoothed, they would leave gaps between neighbours.
            look: dict[str, Any] = (
                {"edgecolors": "#404040", "linewidths": 0.3} if few else {"edgecolors": "face", "linewidths": 0.2, "antialiaseds": False}
            )
            ax.add_collection(PolyCollection(corners, facecolors=colour, label=label, **look))
    ax.autoscale_view()
    ax.set_xlabel(f"axis {across}")
    ax.set_ylabel(f"axis {along}")
    return ax


def png(paint: "Callable[[Axes], object]") -> bytes:
    """Return a PNG of what a function paints, as a notebook shows it; figures that matplotlib has open are left alone."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(5.0, 4.0), dpi=100, layout="constrained")
    paint(figure.add_subplot())
    data = io.BytesIO()
    figure.savefig(data, format="png")
    return data.getvalue()


def _corners(boxes: Boxes, across: int, along: int) -> npt.NDArray[np.float64]:
    left, right, bottom, top = boxes.lower[:, across], boxes.upper[:, across], boxes.lower[:, along], boxes.upper[:, along]
    corners = np.stack([np.stack([left, right, right, left], axis=1), np.stack([bottom, bottom, top, top], axis=1)], axis=2)
    unbounded = ~np.isfinite(corners).all(axis=(1, 2))
    if unbounded.any():
        raise ValueError(f"{unbounded.sum()} of {len(boxes)} boxes are unbounded along the axes to draw; pave a bounded box")
    return corners
