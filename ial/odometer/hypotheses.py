"""`Hypothesis`: a connected part of a set of configurations; and whether several of them are one up to symmetry."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import Boxes
from ial.contractors.margins import ABOVE
from ial.contractors.paving.clusters import cluster
from ial.maps.polygons.exact.congruence import Congruence
from ial.odometer.chords import wrapped
from ial.odometer.configurations import Configurations

FloatArray = npt.NDArray[np.float64]

_MOST_SAMPLES = 16
_NEAR = 1e-5
"""Of the size, and in radians: how far from the image of another a hypothesis may be, to be taken for the same up to symmetry."""


@dataclass(frozen=True, eq=False)
class Hypothesis:
    """Configurations that hang together.

    Parameters
    ----------
    world
        The name of the environment.
    x, y, heading_rad
        The middle: metres in the frame of the environment's polygon, radians from −π to π. Not a bound.
    width_m
        The diagonal of the box around the places, in metres, rounded up.
    width_rad
        The width of the interval of headings, in radians, rounded up.
    samples
        Middles of some of its boxes, float64 of shape (m, 3): x, y, heading.
    """

    world: str
    x: float
    y: float
    heading_rad: float
    width_m: float
    width_rad: float
    samples: FloatArray

    def __repr__(self) -> str:
        return f"<Hypothesis ({self.x:.6g}, {self.y:.6g}), {math.degrees(self.heading_rad):.6g}° in {self.world}>"


def hypotheses(world: str, states: Configurations) -> list[Hypothesis]:
    """Return the connected parts of a set."""
    if not len(states):
        return []
    rows = states.rows
    boxes = Boxes(np.ascontiguousarray(rows[:, 2:8:2]), np.ascontiguousarray(rows[:, 3:8:2]))
    clusters = cluster(boxes, circular=(2,))
    middles = states.middles()
    ox, oy = states.walls.origin
    order = np.argsort(clusters.labels, kind="stable")
    starts = np.searchsorted(clusters.labels[order], np.arange(len(clusters) + 1)).tolist()
    hulls = 0.5 * (clusters.hulls.lower + clusters.hulls.upper)
    wide = np.nextafter(clusters.hulls.upper - clusters.hulls.lower, math.inf)
    found = []
    for number, ((x, y, heading), (width_x, width_y, width)) in enumerate(zip(hulls.tolist(), wide.tolist(), strict=True)):
        first, last = starts[number], starts[number + 1]
        chosen = order[first : last : -(-(last - first) // _MOST_SAMPLES)]
        diagonal = math.hypot(width_x, width_y) * ABOVE
        turned = (heading + math.pi) % (2.0 * math.pi) - math.pi
        found.append(Hypothesis(world, x + ox, y + oy, turned, diagonal, width, middles[chosen]))
    return found


def one_orbit(found: Sequence[Hypothesis], motions: Callable[[str, str], Sequence[Congruence]], size_m: float) -> bool:
    """Return whether all hypotheses are images of the first one under motions that lay its environment upon theirs.

    Parameters
    ----------
    found
        At least one.
    motions
        Gives the motions that lay one environment, by its name, upon another.
    size_m
        Of the environments.
    """
    first = found[0]
    for other in found[1:]:
        near_m, near_rad = _NEAR * size_m + first.width_m + other.width_m, _NEAR + first.width_rad + other.width_rad
        for motion in motions(first.world, other.world):
            x, y = motion.moved(first.x, first.y)
            turned = wrapped(first.heading_rad + motion.turn_rad - other.heading_rad)
            if math.hypot(x - other.x, y - other.y) <= near_m and abs(turned) <= near_rad:
                break
        else:
            return False
    return True
