"""`safe_ways`: how far a robot can drive in some directions without coming too near to anything, wherever in a set of poses it is.

On its way it never comes nearer to what is not free than its radius, and where it stops it keeps a larger distance, its clearance. So a
robot that has started with that clearance has it at each scan: a pose without it is impossible, and a set that is a little too large, as
sets are, does not hold it where it is.
"""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.active.clearance_field import ClearanceField, FloatArray
from ial.contractors import threads
from ial.contractors.boxes import Boxes
from ial.contractors.intervals.trigonometric import sincos
from ial.contractors.kernels import kernel
from ial.contractors.margins import ABOVE, ROUNDINGS
from ial.datasets.motion import MotionBounds
from ial.errors import ConfigError
from ial.pose import Pose

_CHUNK = 64  # boxes that one thread looks at together
_WIDEST_M, _WIDEST_RAD = 0.06, 0.05  # wider boxes are looked at in parts


@dataclass(frozen=True)
class Distances:
    """What a robot keeps to everything that is not free.

    Parameters
    ----------
    radius_m
        Its radius: always.
    clearance_m
        What it keeps at each scan, its centre to the nearest thing; larger than the radius by a few errors of position.
    now_m
        What it keeps where it is: its clearance, if it is None. A robot that was stopped by something keeps its radius.

    Raises
    ------
    ConfigError
        If a number cannot be meant.
    """

    radius_m: float
    clearance_m: float
    now_m: float | None = None

    def __post_init__(self) -> None:
        if not 0.0 <= self.radius_m < math.inf:
            raise ConfigError(f"the radius of the robot is {self.radius_m:g} m; give 0 or a positive length")
        if not self.radius_m <= self.clearance_m < math.inf:
            raise ConfigError(f"the clearance is {self.clearance_m:g} m; give at least the radius of the robot, {self.radius_m:g} m")


@kernel
def _march(start, stop, lower, upper, turns, field, place, wanted, errors, step, count, safe):  # type: ignore[no-untyped-def]
    """Clear `safe[chunk, k, n]` where n steps in direction k are not safe from some box of a chunk."""
    radius, clearance, now, rounded = wanted
    turned, grown = errors
    rows, columns = field.shape
    for chunk in range(start, stop):
        for i in range(chunk * _CHUNK, min((chunk + 1) * _CHUNK, len(lower))):
            x, y = 0.5 * (lower[i, 0] + upper[i, 0]), 0.5 * (lower[i, 1] + upper[i, 1])
            half = np.hypot(0.5 * (upper[i, 0] - lower[i, 0]), 0.5 * (upper[i, 1] - lower[i, 1])) + rounded
            heading, aside = 0.5 * (lower[i, 2] + upper[i, 2]), 0.5 * (upper[i, 2] - lower[i, 2])
            row, column = int(np.floor(y / place)), int(np.floor(x / place))
            if 0 <= row < rows and 0 <= column < columns and field[row, column] + 1.5 * place + half < now:
                continue  # it cannot be there
            for k in range(len(turns)):
                sine, cosine = sincos(heading + turns[k])
                free = True
                for n in range(count):
                    way = n * step
                    if free:
                        column, row = int(np.floor((x + way * cosine) / place)), int(np.floor((y + way * sine) / place))
                        clear = field[row, column] if 0 <= row < rows and 0 <= column < columns else 0.0
                        # A pose of the box is off by its half width, its direction by an arc, and it may miss its way.
                        missed = half + way * aside + turned[k] + grown[k] * way
                        # Places between two are half a step from one of them, and what may be missed has grown by then.
                        free = clear >= radius + missed + 0.5 * step * (1.0 + aside + grown[k])
                        # Wherever in the box it is, it has started with its distance, and has lost no more of it than it has come.
                        come = (way + 0.5 * step) * (1.0 + grown[k]) + turned[k] + rounded
                        free = free or now - come >= radius
                        if free and clear < clearance + missed:
                            safe[chunk, k, n] = False
                    if not free:
                        safe[chunk, k, n] = False


def safe_ways(
    poses: Boxes,
    turns_rad: npt.ArrayLike,
    most_m: float,
    field: ClearanceField,
    distances: Distances,
    bounds: MotionBounds,
    longest_s: float,
    limits_m: FloatArray | None = None,
) -> FloatArray:
    """Return how far a robot can drive after some turns on the spot, safe wherever in a set of poses it is.

    Parameters
    ----------
    poses
        The set, in the grid's frame. Poses that do not keep what the robot keeps where it is are impossible, and left out.
    turns_rad
        By how much it turns first, float64 of shape (n,).
    most_m
        Farther is of no interest.
    field
        The map.
    distances
        What it keeps.
    bounds
        How far it may be from where it is told to go, at every moment.
    longest_s
        How long a drive takes at most, in seconds.
    limits_m
        For each turn, how far it may go at most, for whatever reason. A shorter way than the one that is returned may be unsafe, since the
        robot would stop elsewhere: so ways must not be cut afterwards.

    Returns
    -------
    numpy.ndarray
        Distances in metres, float64 of shape (n,): −1 where no way is safe, not even a turn alone.
    """
    turns = np.ascontiguousarray(turns_rad, dtype=np.float64)
    count = max(2, math.ceil(2.0 * most_m / field.place_m) + 1)
    step = most_m / (count - 1)
    turned, driven = (np.array([_missed_m(bounds, turn, way, longest_s) for turn in turns.tolist()]) for way in (0.0, most_m))
    grown = ABOVE * (driven - turned) / most_m if most_m else np.zeros(len(turns))
    small = _parts(poses)
    chunks = -(-len(small) // _CHUNK)
    safe = np.ones((chunks, len(turns), count), dtype=np.bool_)
    lower, upper = np.ascontiguousarray(small.lower), np.ascontiguousarray(small.upper)
    # What is rounded on the way are sums of terms as large as the map.
    now = distances.clearance_m if distances.now_m is None else distances.now_m
    wanted = distances.radius_m, distances.clearance_m, now, ROUNDINGS * (field.size_m + most_m)
    threads.run(_march, chunks, lower, upper, turns, field.distance_m, field.place_m, wanted, (turned, grown), step, count, safe, minimum=1)
    whole = np.logical_and.reduce(safe, axis=0)
    if limits_m is not None:
        whole &= np.arange(count) * step <= limits_m[:, None]
    last = count - 1 - np.argmax(whole[:, ::-1], axis=1)
    return np.where(whole.any(axis=1), last * step, -1.0)


def _parts(poses: Boxes) -> Boxes:
    """Return boxes cut into parts that are not too wide."""
    widest = np.array([_WIDEST_M, _WIDEST_M, _WIDEST_RAD])
    while len(poses) and ((wide := poses.width() / widest).max(axis=1) > 1.0).any():
        large = wide.max(axis=1) > 1.0
        halves = poses[large].bisect(wide[large].argmax(axis=1))
        poses = Boxes.concatenate([poses[~large], halves])
    return poses


def _missed_m(bounds: MotionBounds, turn: float, way_m: float, seconds: float) -> float:
    """Return how far a robot may be from where it was told to go; that is a sum of parts, one of which grows with the way."""
    told = bounds.enclose(Pose(way_m * math.cos(turn), way_m * math.sin(turn), turn), seconds)
    half = 0.5 * (told.upper - told.lower)
    return math.hypot(half[0], half[1]) * ABOVE
