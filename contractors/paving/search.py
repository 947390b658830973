"""What a search by bisection is given, checked before it begins."""

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import Boxes, FloatArray


def check_boxes(boxes: Boxes) -> None:
    """Raise if a bound is NaN.

    Raises
    ------
    ValueError
        If one is.
    """
    broken = np.isnan(boxes.lower).any(axis=1) | np.isnan(boxes.upper).any(axis=1)
    if broken.any():
        raise ValueError(f"box {broken.argmax()} of {len(boxes)} has a bound that is NaN; give numbers, or infinity where it is unbounded")


def checked_precision(precision: npt.ArrayLike, dimension: int) -> FloatArray:
    """Return the wanted width along each axis, float64 of shape (d,), from one number or one for each axis.

    Raises
    ------
    ValueError
        If it has another shape, or if a width is not above 0.
    """
    widths = np.asarray(precision, dtype=np.float64)
    if widths.shape not in ((), (dimension,)):
        raise ValueError(f"the precision has shape {widths.shape}; give one number, or one for each of the {dimension} axes")
    if not (widths > 0.0).all():
        raise ValueError(f"the precision is {widths.tolist()}; give widths above 0")
    return np.ascontiguousarray(np.broadcast_to(widths, (dimension,)))


def check_limits(*, max_seconds: float | None = None, **counts: int | None) -> None:
    """Raise if a limit cannot be kept; None is no limit.

    Raises
    ------
    ValueError
        If a number of boxes or bytes is below 1, or if a time is negative or NaN.
    """
    for name, count in counts.items():
        if count is not None and not count >= 1:
            raise ValueError(f"{name} is {count!r}; give at least 1")
    if max_seconds is not None and not max_seconds >= 0.0:
        raise ValueError(f"max_seconds is {max_seconds!r}; give a time that is not negative, or None")
