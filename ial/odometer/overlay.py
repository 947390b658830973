"""`way_apart`: a way to a place that only one of two hypotheses has, in the frame of the robot.

Both environments are laid upon each other so that the robots stand upon each other, as O'Kane and LaValle do (2007, section IV-D and figure
5). A robot that drives to a place which lies in one only will be stopped earlier in the other. Planned in doubles: whatever the robot reads
then, the sets are right.
"""

import math
from fractions import Fraction

import numpy as np
import numpy.typing as npt

from ial.maps.polygons.exact.shooter import Shooter
from ial.maps.polygons.exact.shortest_path import ShortestPaths
from ial.maps.polygons.exact.visibility import Visibility
from ial.maps.polygons.polygon import Polygon
from ial.odometer.command import Command
from ial.odometer.hypotheses import Hypothesis

_CLEAR = 1e-3  # of the size: how far from walls such a place lies, and the corners of the way
_FEW = 4  # of the nearest places are tried

Complexes = npt.NDArray[np.complex128]


def way_apart(one: Polygon, here: Hypothesis, other: Polygon, there: Hypothesis) -> list[Command]:
    """Return commands that lead a robot to a place which only one of two hypotheses has; none if no such place is found.

    Parameters
    ----------
    one, here
        An environment and a hypothesis in it.
    other, there
        The other ones.
    """
    ways = [_way(*pair) for pair in ((one, here, other, there), (other, there, one, here))]
    found = [way for way in ways if way]
    return min(found, key=lambda way: sum(command.ahead_m for command in way), default=[])


def _way(one: Polygon, here: Hypothesis, other: Polygon, there: Hypothesis) -> list[Command]:
    """Return the way to a place of one environment that the other does not have."""
    low_x, low_y, high_x, high_y = map(float, one.bounds)
    clear = _CLEAR * max(high_x - low_x, high_y - low_y)
    robot, turn = complex(here.x, here.y), complex(math.cos(here.heading_rad), math.sin(here.heading_rad))
    turn_there = complex(math.cos(there.heading_rad), math.sin(there.heading_rad))
    walls = _walls(one)
    laid = [(each - complex(there.x, there.y)) / turn_there * turn + robot for each in _walls(other)]
    places = _beside(walls, laid, clear)
    places = places[_inside(places, walls, 0.5 * clear) & ~_inside(places, laid, -0.5 * clear)]
    start = robot + clear * np.exp(1j * np.linspace(0.0, 2.0 * math.pi, 33))
    start = start[_inside(start, walls, 0.2 * clear)]
    if not len(places) or not len(start):
        return []
    paths = ShortestPaths(Visibility(Shooter(one)))
    near = places[np.argsort(np.abs(places - robot))[:_FEW]]
    return min((_commands(paths, robot, turn, complex(start[0]), complex(place), clear) for place in near), key=_length)


def _length(way: list[Command]) -> float:
    return sum(command.ahead_m for command in way)


def _commands(paths: ShortestPaths, robot: complex, turn: complex, start: complex, place: complex, clear: float) -> list[Command]:
    """Return the commands along the shortest path, whose corners are moved a little into the free space."""
    shooter = paths.visibility.shooter
    numbers = {corner: number for number, corner in enumerate(shooter.corners)}
    exact = paths.path(_exact(start), _exact(place))
    stops = []
    for corner in exact[1:-1]:
        number = numbers[corner]
        into, out_of = (complex(float(x), float(y)) for x, y in (shooter.edges[shooter.before[number]], shooter.edges[number]))
        away = into / abs(into) - out_of / abs(out_of)
        stops.append(complex(float(corner[0]), float(corner[1])) + clear * away / abs(away))
    commands = []
    for stop in (*stops, place):
        way = stop - robot
        commands.append(Command(Fraction(math.degrees(float(np.angle(way / turn)))), abs(way)))
        robot, turn = stop, way / abs(way)
    return commands


def _exact(place: complex) -> tuple[Fraction, Fraction]:
    return Fraction(place.real), Fraction(place.imag)


def _walls(polygon: Polygon) -> list[Complexes]:
    return [np.array([complex(float(x), float(y)) for x, y in ring]) for ring in polygon.rings]


def _beside(walls: list[Complexes], laid: list[Complexes], clear: float) -> Complexes:
    """Return places on either side of the parts into which the walls of two environments cut each other."""
    starts = np.concatenate([*walls, *laid])
    ways = np.concatenate([np.roll(ring, -1) - ring for ring in (*walls, *laid)])
    offset = starts[None, :] - starts[:, None]
    across = np.imag(np.conj(ways)[:, None] * ways[None, :])
    with np.errstate(divide="ignore", invalid="ignore"):
        part = np.imag(np.conj(offset) * ways[None, :]) / across
        other = np.imag(np.conj(offset) * ways[:, None]) / across
    meets = (part > 0.0) & (part < 1.0) & (other >= 0.0) & (other <= 1.0)
    places = []
    for at in range(len(starts)):
        cuts = np.unique(np.concatenate([[0.0, 1.0], part[at][meets[at]]]))
        middles = starts[at] + 0.5 * (cuts[1:] + cuts[:-1]) * ways[at]
        aside = 1j * clear * ways[at] / abs(ways[at])
        places += [middles + aside, middles - aside]
    return np.concatenate(places)


def _inside(places: Complexes, rings: list[Complexes], clear: float) -> npt.NDArray[np.bool_]:
    """Return which places lie in an area, farther from its border than `clear`; if that is negative, or outside but nearer."""
    starts, ends = np.concatenate(rings), np.concatenate([np.roll(ring, -1) for ring in rings])
    ways, offset = ends - starts, places[:, None] - starts[None, :]
    part = np.clip(np.real(np.conj(ways)[None, :] * offset) / np.abs(ways[None, :]) ** 2, 0.0, 1.0)
    far = np.abs(offset - part * ways[None, :]).min(axis=1)
    above = starts.imag[None, :] > places.imag[:, None]
    crossed = above != (ends.imag[None, :] > places.imag[:, None])
    with np.errstate(divide="ignore", invalid="ignore"):
        x = starts.real[None, :] + (places.imag[:, None] - starts.imag[None, :]) * ways.real[None, :] / ways.imag[None, :]
    inside = (np.count_nonzero(crossed & (x > places.real[:, None]), axis=1) % 2).astype(np.bool_)
    return np.asarray((inside & (far > clear)) | (far < -clear))
