"""How the base may have moved until each beam of a scan: a slow, obvious twin of `ial.lidar.evidence.sweep`, without any of its code."""

import itertools
import math

import numpy as np
import numpy.typing as npt

from ial.datasets.motion import ErrorBound, MotionBounds
from ial.datasets.odometry_path import OdometryPath

FloatArray = npt.NDArray[np.float64]


def possible_motions(path: OdometryPath, bounds: MotionBounds, shares: FloatArray) -> FloatArray:
    """Return some of the motions that docs/guarantee.md allows until beams of a scan, the recorded one first.

    Parameters
    ----------
    path
        `LaserScan.sweep`.
    bounds
        How far recorded odometry may be from the truth.
    shares
        The time of each beam as a share of the time from the first to the last, shape (n,).

    Returns
    -------
    FloatArray
        (x, y, θ) in the frame of the base at the first beam, shape (n, m, 3); m is 1 if the odometry is exact, else 9: all pieces off by
        their whole bounds, with each choice of signs.
    """
    signs = [(0.0, 0.0, 0.0), *itertools.product((-1.0, 1.0), repeat=3)]
    times = np.abs(path.stamps_ns - path.stamps_ns[0]).astype(np.float64)
    pieces = [_piece(path, row, bounds) for row in range(len(path) - 1)]
    if not any(any(errors) for _, errors in pieces):
        signs = signs[:1]
    moved = np.zeros((len(shares), len(signs), 3))
    for choice, (ahead, aside, around) in enumerate(signs):
        at, theta = 0j, 0.0
        for row, ((step, turn), (off_x, off_y, off_theta)) in enumerate(pieces):
            step, turn = step + complex(ahead * off_x, aside * off_y), turn + around * off_theta
            begun, span = times[row], times[row + 1] - times[row]
            later = shares * times[-1] >= begun if span else np.ones(len(shares), dtype=np.bool_)
            done = np.clip((shares * times[-1] - begun) / span, 0.0, 1.0) if span else shares
            place = at + np.exp(1j * theta) * step * done
            moved[later, choice] = np.stack([place.real, place.imag, theta + turn * done], axis=1)[later]
            at, theta = at + np.exp(1j * theta) * step, theta + turn
    return moved


def _piece(path: OdometryPath, row: int, bounds: MotionBounds) -> tuple[tuple[complex, float], tuple[float, float, float]]:
    """Return the recorded motion from one message to the next, and how far it may be off along x, y and θ at least."""
    (x0, y0, z0, w0, off_0, _), (x1, y1, z1, w1, off_1, off_theta) = path.numbers[row : row + 2].tolist()
    start, stop = 2.0 * math.atan2(z0, w0), 2.0 * math.atan2(z1, w1)
    step = complex(x1 - x0, y1 - y0) * np.exp(-1j * start)
    turn = math.remainder(stop - start, 2.0 * math.pi)
    seconds = 1e-9 * abs(int(path.stamps_ns[row + 1]) - int(path.stamps_ns[row]))

    def off(bound: ErrorBound) -> float:
        return bound.per_message + float(bound.per_metre * abs(step) + bound.per_radian * abs(turn) + bound.per_second * seconds)

    # Where messages were interpolated both ends lie in squares of the odometry frame, and these in every frame hold squares half as large.
    ends = (off_0 + off_1) / math.sqrt(2.0)
    aside = bounds.translation if bounds.sideways is None else bounds.sideways
    return (step, turn), (off(bounds.translation) + ends, off(aside) + ends, off(bounds.rotation) + off_theta)
