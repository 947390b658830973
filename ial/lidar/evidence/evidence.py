"""`Evidence`: what a scan says of where its beams end, as kernels take it."""

from typing import NamedTuple

from ial.contractors.boxes import FloatArray


class Evidence(NamedTuple):
    """The used beams of a scan and how many of them may be bad; see `Beams`.

    Parameters
    ----------
    ends, directions, errors
        End point, direction, and half-widths along and across, of each beam in the base frame; float64 of shape (n, 2).
    map_error
        How far the map may be wrong (m).
    outliers
        q: how many beams may be bad.
    """

    ends: FloatArray
    directions: FloatArray
    errors: FloatArray
    map_error: float
    outliers: int
