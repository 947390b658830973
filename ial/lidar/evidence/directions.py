"""Unit vectors, by the toolkit's sine and cosine, whose errors are proved; those of the platform or of NumPy are not relied on."""

import numpy as np

from ial.contractors.boxes import FloatArray
from ial.contractors.intervals.trigonometric import sincos
from ial.contractors.kernels import kernel
from ial.contractors.rounding import check_rounding


@kernel
def _fill(angles, vectors):  # type: ignore[no-untyped-def]
    for i in range(len(angles)):
        s, c = sincos(angles[i])
        vectors[i, 0] = c
        vectors[i, 1] = s


def unit_vectors(angles: FloatArray) -> FloatArray:
    """Return (cos, sin) of angles, each wrong by less than 2^-53; float64 of shape (n, 2), NaN beyond `trigonometric.LARGEST_ANGLE`.

    Parameters
    ----------
    angles
        In radians, float64 of shape (n,).
    """
    check_rounding()
    vectors = np.empty((len(angles), 2))
    _fill(angles, vectors)
    return vectors
