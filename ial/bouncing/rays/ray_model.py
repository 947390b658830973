"""`RayModel`: a robot with real geometry among the walls of an environment, and all that its bumps allow.

The robot is not put back to the centre of a cell: it is anywhere, in any heading, and drives along a ray to the next wall. What it observes
is how many steps that took, an odometer that reads intervals.
"""

from fractions import Fraction

import numpy as np
import numpy.typing as npt

from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.rays.legs import Legs, radians
from ial.bouncing.rays.ray_grid import coarsened, least_pieces
from ial.bouncing.rays.ray_set import RaySet
from ial.bouncing.start import Start
from ial.contractors.boxes import Boxes
from ial.contractors.intervals.interval import Interval
from ial.contractors.intervals.trigonometric import TWO_PI_UPPER
from ial.contractors.rounding import check_rounding
from ial.errors import ConfigError, MapError
from ial.maps.polygons.clearance import Clearance
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.ray_shooting import reaches, shoot
from ial.maps.polygons.walls import Walls
from ial.membership.model import Model

MOST_PIECES = 20_000
_FULL_DEG = 360
_ROOM = 4  # how many hits for each piece there is room for at first


class RayModel(Model[RaySet, None, int]):
    """Sets of pieces of walls with headings; a reading is 1 for a bump and 0 for a step without one. A motion is always None.

    The robot is a point or a disk that drives straight on until it touches a wall that its heading leads into, turns by φ, and drives on.
    A step without contact gives 0, contact gives 1: of k steps between two bumps, the way is in [k·h, (k + 1)·h]. Where it only touches a
    wall, at a reflex corner or along the wall, it may bump or not; both are kept. Sets are closed, and every bound is rounded outward.

    Parameters
    ----------
    environment
        The free space; the boundaries of all polygons are walls.
    bounce_deg
        φ, counter-clockwise.
    step_m
        h, in metres.
    bounds
        What the robot may do wrong.
    most_pieces
        How many pieces a set has at most, per number of steps: beyond, it is replaced by a coarser superset.
    headings_deg
        Intervals that hold the heading at the start, in degrees; all headings are possible by default.
    region
        A rectangle that holds the place at the start: least x and y, greatest x and y; everywhere by default.
    radius_m
        The radius of a disk, whose place is its centre, in metres; 0 for a point.

    Raises
    ------
    ConfigError
        If the step is not positive, the angle is a multiple of 360°, the region or an interval is empty, or sets would have too few pieces.
    MapError
        If there are too many walls.

    Examples
    --------
    >>> from fractions import Fraction
    >>> from ial.bouncing import RayModel
    >>> from ial.maps import Environment
    >>> from ial.maps.polygons.polygon import Polygon
    >>> from ial.membership import SetMembershipFilter
    >>> corners = [(0, 0), (4, 0), (4, 3), (0, 3)]
    >>> room = Environment((Polygon(tuple((Fraction(x), Fraction(y)) for x, y in corners)),))
    >>> model = RayModel(room, Fraction(90), Fraction(1))
    >>> robot = SetMembershipFilter(model, "restart")
    >>> [robot.update(None, reading) for reading in (0, 0, 0, 0, 0, 0)]
    [None, None, None, None, None, Rejection(step=5)]
    """

    def __init__(
        self,
        environment: Environment,
        bounce_deg: Fraction,
        step_m: Fraction,
        bounds: ExecutionBounds = ExecutionBounds(),  # noqa: B008 (it is immutable)
        most_pieces: int = MOST_PIECES,
        headings_deg: tuple[tuple[Fraction, Fraction], ...] = (),
        region: tuple[Fraction, Fraction, Fraction, Fraction] | None = None,
        radius_m: Fraction = Fraction(0),
    ) -> None:
        check_rounding()
        self.walls = Walls.of(environment, radius_m)
        self.legs = Legs(self.walls, bounce_deg, step_m, bounds)
        self._clearance = Clearance.of(environment, radius_m)
        self._start = Start(region, headings_deg)
        least = least_pieces(self.walls)
        if most_pieces < least:
            raise ConfigError(f"sets of at most {most_pieces} pieces are too coarse for {len(self.walls)} walls; allow at least {least}")
        self.most_pieces, self.radius_m = most_pieces, radius_m
        self._headings = [radians(low % _FULL_DEG, low % _FULL_DEG + min(high - low, Fraction(_FULL_DEG))) for low, high in headings_deg]

    def __repr__(self) -> str:
        return f"<RayModel among {len(self.walls)} walls, {self.legs.bounds}>"

    def universe(self) -> RaySet:
        """Return every piece of wall that the robot can come to first, from wherever it may be, in a heading it may have.

        Raises
        ------
        MapError
            If there is none: the robot is too large.
        """
        cells = [(low, high) for low, high in self._headings] or [(0.0, TWO_PI_UPPER)]
        stopping = np.flatnonzero(self.walls.stopping).astype(np.int32)
        walls = np.tile(stopping, len(cells))
        lower = np.stack([np.zeros(len(walls)), np.repeat([low for low, _ in cells], len(stopping))], axis=1)
        upper = np.stack([np.ones(len(walls)), np.repeat([high for _, high in cells], len(stopping))], axis=1)
        count = len(walls)
        every = RaySet(walls, lower, upper, np.zeros(count, dtype=np.int32), np.ones(count, dtype=np.bool_), np.full(count, np.inf))
        prepared = self._prepared(every)
        if not len(prepared):
            raise MapError(f"a robot of radius {float(self.radius_m):g} m fits nowhere in the environment; check both")
        return prepared

    def predict(self, states: RaySet, motion: None) -> RaySet:
        """Return where the robot can be after a step of which nothing was observed."""
        return RaySet.joined(self._stepped(states), self._bumped(states))

    def step(self, states: RaySet, motion: None, reading: int) -> RaySet:
        """Return where the robot can be after a step with a bump (1) or without one (0)."""
        return self._bumped(states) if reading else self._stepped(states)

    def leg(self, states: RaySet, steps: int) -> RaySet:
        """Return where the robot can be after a bump that was observed after so many more steps."""
        longer = RaySet(states.walls, states.lower, states.upper, (states.steps + steps).astype(np.int32), states.arriving, states.reach)
        return self._bumped(longer)

    def unite(self, allowed: RaySet, predicted: RaySet) -> RaySet:
        """Return the pieces of either set."""
        return RaySet.joined(allowed, predicted)

    def empty(self, states: RaySet) -> bool:
        """Return whether nothing is left: the robot is in no place of the environment."""
        return len(states) == 0

    def _stepped(self, states: RaySet) -> RaySet:
        more = RaySet(states.walls, states.lower, states.upper, (states.steps + 1).astype(np.int32), states.arriving, states.reach)
        kept = more.reach >= self.legs.ways(more)[0]
        return more if kept.all() else more.only(kept)

    def _bumped(self, states: RaySet) -> RaySet:
        """Return the pieces of walls that the robot leaves from after a bump now."""
        check_rounding()
        arriving, leaving = states.only(states.arriving), states.only(~states.arriving)
        arrived = arriving.only(self.legs.can_have_come(arriving, self._start))
        hit = self.legs.with_corners(RaySet.joined(arrived, self._shot(leaving)[1]))[1]
        count, turned = len(hit), self.legs.turned(hit)
        lower, upper = np.column_stack([hit.lower[:, 0], turned.lower]), np.column_stack([hit.upper[:, 0], turned.upper])
        left = RaySet(hit.walls, lower, upper, np.zeros(count, dtype=np.int32), np.zeros(count, dtype=np.bool_), np.full(count, np.inf))
        return self._prepared(left)

    def _prepared(self, states: RaySet) -> RaySet:
        """Return a set of bounded size, with how far the robot can get from each of its pieces."""
        states = coarsened(states, self.walls, self.most_pieces)
        states = states.only(self.may_stand(states))
        table, links = self.walls.table
        reach = reaches(states.walls, states.lower, states.upper, states.arriving, table, links, self.walls.margin)
        prepared = RaySet(states.walls, states.lower, states.upper, states.steps, states.arriving, reach)
        return prepared.only(reach >= 0.0)

    def may_stand(self, states: RaySet) -> npt.NDArray[np.bool_]:
        """Return whether a robot can be on each piece: False where all of it overlaps one and the same wall of the environment."""
        return self._clearance.of_parts(self.walls, states.walls, states.lower[:, 0], states.upper[:, 0])

    def hits(self, states: RaySet) -> tuple[npt.NDArray[np.int64], RaySet]:
        """Return which piece each robot has left from that bumps now, and the pieces of walls that they touch before they turn."""
        begins, shot = self._shot(states)
        rows, touched = self.legs.with_corners(shot)
        return begins[rows], touched

    def _shot(self, states: RaySet) -> tuple[npt.NDArray[np.int64], RaySet]:
        table, links = self.walls.table
        least, most = self.legs.ways(states)
        begin, parts, begins = 0, [], [np.empty(0, dtype=np.int64)]
        room = _ROOM * len(states) + len(self.walls) + 1
        while begin < len(states):
            rows, walls = np.empty(room, dtype=np.int64), np.empty(room, dtype=np.int32)
            lower, upper = np.empty((room, 2)), np.empty((room, 2))
            begin, count = shoot(
                begin, states.walls, states.lower, states.upper, least, most, table, links, self.walls.margin, rows, walls, lower, upper
            )
            kept = states.only(rows[:count])
            begins.append(rows[:count])
            parts.append(RaySet(walls[:count], lower[:count], upper[:count], kept.steps, kept.arriving, kept.reach))
        return np.concatenate(begins), RaySet.joined(states.only(np.zeros(len(states), dtype=np.bool_)), *parts)

    def places(self, states: RaySet) -> Boxes:
        """Return where the robot can be now: boxes of x, y in the frame of the environment and the heading in radians.

        Raises
        ------
        ConfigError
            If some of the robots have not bumped yet: they can be everywhere.
        """
        if states.arriving.any():
            raise ConfigError("the robot has not bumped yet, so it can be anywhere that its region allows; ask after the first bump")
        moved = self.legs.moved(states, *self.legs.driven(states))
        shift = Boxes.of([Interval(self.walls.origin[0]), Interval(self.walls.origin[1])])
        there = Boxes(moved.lower[:, :2], moved.upper[:, :2]) + Boxes(
            np.repeat(shift.lower, len(states), axis=0), np.repeat(shift.upper, len(states), axis=0)
        )
        return Boxes(np.concatenate([there.lower, states.lower[:, 1:]], axis=1), np.concatenate([there.upper, states.upper[:, 1:]], axis=1))
