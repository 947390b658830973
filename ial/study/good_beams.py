"""How many beams of a scan are bad at poses of the base, by the definition of docs/guarantee.md, in plain NumPy.

This is the slow, obvious twin of the localizer's test. It begins at the recorded numbers and shares no code with the search that it judges.
It never calls a beam good that is bad; near a bound it may call one bad that is good.
"""

import numpy as np
import numpy.typing as npt

from ial.study.blocked_rays import blocked_rays
from ial.study.obstacles import BoolArray, FloatArray, Obstacles, portions
from ial.study.used_beams import UsedBeams, in_grid

_LINE_CELLS = 0.1
"""A tenth of a cell lies between the lines on which the ends of a beam are looked for, so a beam good by less may be called bad."""

_FAR_CELLS = 64.0  # an end that may be anywhere within more than this is looked for without asking first


def bad_beams(beams: UsedBeams, poses: FloatArray, obstacles: Obstacles) -> npt.NDArray[np.intp]:
    """Return how many used beams may be bad at poses: those that end nowhere, and those that are blocked; each counts once.

    Parameters
    ----------
    beams
        The used beams of a scan.
    poses
        (x, y, θ) of the base in the grid's frame, float64 of shape (m, 3).
    obstacles
        The occupied cells of the map.

    Returns
    -------
    bad
        Shape (m,). No fewer than are bad.
    """
    return _count(beams, poses, obstacles, good_beams(beams, poses, obstacles))


def consistent(beams: UsedBeams, poses: FloatArray, obstacles: Obstacles, outliers: int) -> BoolArray:
    """Return at which poses certainly at most so many beams are bad, bool of shape (m,): `bad_beams`, without work that changes nothing."""
    fits = np.zeros(len(poses), dtype=np.bool_)
    rows = np.flatnonzero((~_hopeful(beams, poses, obstacles)).sum(axis=1) <= outliers)
    good = good_beams(beams, poses[rows], obstacles)
    few = (~good).sum(axis=1) <= outliers
    rows, good = rows[few], good[few]
    fits[rows] = _count(beams, poses[rows], obstacles, good) <= outliers
    return fits


def good_beams(beams: UsedBeams, poses: FloatArray, obstacles: Obstacles) -> BoolArray:
    """Return which hits certainly end at an occupied cell, bool of shape (m, hits); parameters as in `bad_beams`.

    A hit is good at a pose if some reading within its error, some bearing within its error and, where the motion during the scan is taken
    out, some motion within its error put its end within the map's error of a closed occupied cell. All readings along a line are tried at
    once, as a segment; bearings are tried a tenth of a cell apart, and of the motions the recorded one and the corners of their box.
    """
    origins, angles = _lines(beams, obstacles)
    farthest = beams.readings + beams.bounds.range_error_m
    nearest = np.maximum(beams.readings - beams.bounds.range_error_m, 0.0)
    hopeful = _hopeful(beams, poses, obstacles)
    good = np.zeros_like(hopeful)
    for some in (slice(0, 1), slice(1, None)):  # most beams are good by the recorded numbers
        lines = angles[:, some].shape[1]
        pose, hit = np.nonzero(hopeful & ~good)
        for part in portions(len(pose), lines):
            p, h = pose[part], hit[part]
            at, heading = in_grid(poses[p], origins[h, some], angles[h, some])
            starts, ends = (_points(at, heading, reading[h]).reshape(-1, 2) for reading in (nearest, farthest))
            good[p, h] = obstacles.near(starts, ends, beams.bounds.map_error_m).reshape(len(p), lines).any(axis=1)
    return good


def _count(beams: UsedBeams, poses: FloatArray, obstacles: Obstacles, good: BoolArray) -> npt.NDArray[np.intp]:
    """Return how many beams may be bad at each pose, given which hits are good."""
    bad = np.zeros((len(poses), len(beams)), dtype=np.bool_)
    bad[:, : len(beams.readings)] = ~good
    bad[:, beams.rays] |= blocked_rays(beams, poses, obstacles)
    return np.asarray(bad.sum(axis=1))


def _lines(beams: UsedBeams, obstacles: Obstacles) -> tuple[FloatArray, FloatArray]:
    """Return from where and which way the hits may have gone, in the base frame: of shape (hits, k, 2) and (hits, k)."""
    origins, angles = beams.seen(beams.turns(_LINE_CELLS * obstacles.resolution))
    return origins[: len(beams.readings)], angles[: len(beams.readings)]


def _points(origins: FloatArray, angles: FloatArray, readings: FloatArray) -> FloatArray:
    """Return the points (n, k, 2) so far from origins (n, k, 2) in directions (n, k); one reading for each row, (n,)."""
    return np.asarray(origins + readings[:, None, None] * np.stack([np.cos(angles), np.sin(angles)], axis=-1))


def _hopeful(beams: UsedBeams, poses: FloatArray, obstacles: Obstacles) -> BoolArray:
    """Return which hits have an occupied cell within reach of all that they may mean, by cells; bool of shape (m, hits)."""
    ends = _points(*_lines(beams, obstacles), beams.readings)
    aside = np.abs(ends - ends[:, :1]).sum(axis=2).max(axis=1, initial=0.0)
    reach = (aside + 2.0 * beams.bounds.range_error_m + beams.bounds.map_error_m) / obstacles.resolution
    tried = reach <= _FAR_CELLS
    ring = int(reach[tried].max(initial=0.0)) + 1
    at, _ = in_grid(poses, np.broadcast_to(ends[:, 0], (len(poses), *ends[:, 0].shape)), np.zeros((len(poses), len(ends))))
    return np.asarray(~tried | obstacles.any_around(at, ring))
