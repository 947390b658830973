"""Which turn tells hypotheses apart best: rays from each of them, in plain doubles, for plans only."""

import math
from collections.abc import Callable
from fractions import Fraction
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from ial.active.direction_choice import DirectionChoice, Weights
from ial.contractors.kernels import kernel
from ial.odometer.wall_table import WallTable

FloatArray = npt.NDArray[np.float64]

DIRECTIONS = 72
_NEAR = 1e-9  # of the size: what touches


@kernel
def _cast_all(corners, edges, near, places, turns, result):  # type: ignore[no-untyped-def]
    """Write how far a robot drives from each place after each turn."""
    for i in range(len(places)):
        px, py = places[i, 0], places[i, 1]
        for k in range(len(turns)):
            ux, uy = math.cos(places[i, 2] + turns[k]), math.sin(places[i, 2] + turns[k])
            best = np.inf
            for j in range(len(corners)):
                ex, ey = edges[j, 0], edges[j, 2]
                into = ux * ey - uy * ex
                if into <= 0.0:
                    continue
                cx, cy = corners[j, 0] - px, corners[j, 2] - py
                off = ux * cy - uy * cx
                if off > near or off + into < -near:
                    continue
                far = (cx * ey - cy * ex) / into
                if far >= -near:
                    best = min(best, max(far, 0.0))
            result[i, k] = best


def predicted(walls: WallTable, places: FloatArray, turns: FloatArray) -> FloatArray:
    """Return about how far robots drive to a wall, float64 of shape (places, turns).

    Parameters
    ----------
    walls
        The environment.
    places
        x, y in metres in the frame of the polygon and heading in radians, float64 of shape (m, 3).
    turns
        By how much they turn before, in radians.
    """
    result = np.empty((len(places), len(turns)))
    shifted = places - np.array([*walls.origin, 0.0])
    _cast_all(walls.corners, walls.edges, _NEAR * walls.size, shifted, turns, result)
    return result


def turns_deg() -> list[Fraction]:
    """Return the turns that are tried, in degrees, counter-clockwise."""
    return [Fraction(360 * number, DIRECTIONS) for number in range(1, DIRECTIONS)]


@kernel
def _mean_classes(distances, gaps, result):  # type: ignore[no-untyped-def]
    """Write the mean size of the class that a hypothesis is in, for each column."""
    count = len(distances)
    for turn in range(distances.shape[1]):
        order = np.sort(distances[:, turn])
        begin, total = 0, 0
        for at in range(1, count + 1):
            apart = at == count
            if not apart and order[at] < np.inf:
                apart = order[at] - order[at - 1] > gaps[0] + gaps[1] * order[at]
            elif not apart:
                apart = order[at - 1] < np.inf
            if apart:
                total += (at - begin) ** 2
                begin = at
        result[turn] = total / count


def scores(distances: FloatArray, gap_m: float, gap_part: float) -> FloatArray:
    """Return how many hypotheses are expected to be left after each turn: the mean size of the class a hypothesis is in.

    Parameters
    ----------
    distances
        How far each drives after each turn, float64 of shape (m, turns), at least one.
    gap_m, gap_part
        By how much two must differ to be told apart: a distance in metres, and a part of the larger one.
    """
    result = np.empty(distances.shape[1])
    _mean_classes(distances, np.array([gap_m, gap_part]), result)
    return result


Rule: TypeAlias = Callable[[FloatArray, float, float], int | None]
"""From distances and by how much two must differ, as for `scores`, the turn that tells hypotheses apart best; None if no turn does."""


def by_expectation(distances: FloatArray, gap_m: float, gap_part: float) -> int | None:
    """Return the turn after which the fewest hypotheses are expected to be left; see `scores`."""
    expected = scores(distances, gap_m, gap_part)
    best = int(np.argmin(expected))
    return best if expected[best] < len(distances) - 0.5 else None


def by_direction(distances: FloatArray, gap_m: float, gap_part: float) -> int | None:
    """Return the turn in whose direction hypotheses differ most (Goyal, Krishna, Bhuvanagiri, stage 1); see `DirectionChoice`.

    A drive to the wall is the reading of the paper's virtual sensor. Of several best ones it is the first, where the paper gives up
    stage 1: each of them is as good to a robot that reads one direction at a time.
    """
    seen = distances[np.isfinite(distances)]
    farthest = float(seen.max(initial=0.0))
    if farthest == 0.0:
        return None
    read = np.minimum(distances, 2.0 * farthest)  # that no wall is ahead is one more reading, apart from all others
    choice = DirectionChoice.of((1.0 - 0.5 * gap_part) * read, (1.0 + 0.5 * gap_part) * read, 2.0 * farthest, Weights(same_m=gap_m))
    best = int(choice.best[0])
    return best if choice.differing[best] > 0 else None
