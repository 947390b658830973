"""`RayModel`: a robot with real geometry among the walls of an environment, and all that its bumps allow.

The robot is not put back to the centre of a cell: it is anywhere, in any heading, and drives along a ray to the next wall. What it observes
is how many steps that took, an odometer that reads intervals.
"""

from fractions import Fraction

import numpy as np
import numpy.typing as npt

from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.rays.ray_grid import coarsened, least_pieces
from ial.bouncing.rays.ray_set import RaySet
from ial.contractors import cos, sin
from ial.contractors.boxes import Boxes
from ial.contractors.intervals.interval import Interval
from ial.contractors.intervals.trigonometric import TWO_PI_LOWER, TWO_PI_UPPER
from ial.contractors.margins import ABOVE, BELOW
from ial.contractors.rounding import check_rounding
from ial.errors import ConfigError, MapError
from ial.maps.polygons.clearance import Clearance
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.ray_shooting import reaches, shoot
from ial.maps.polygons.walls import FloatArray, Walls
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
        self._clearance = Clearance.of(environment, radius_m)
        if step_m <= 0:
            raise ConfigError(f"the step is {float(step_m):g} m; give a length greater than 0")
        if bounce_deg % _FULL_DEG == 0:
            raise ConfigError("the bouncing angle is a multiple of 360°, so a robot at a wall would stay there; give another angle")
        if any(low > high for low, high in headings_deg):
            raise ConfigError("an interval of headings ends before it begins; give (from, to) in degrees, counter-clockwise")
        if region is not None and (region[0] > region[2] or region[1] > region[3]):
            raise ConfigError("the region at the start is empty; give the least x and y, then the greatest")
        least = least_pieces(self.walls)
        if most_pieces < least:
            raise ConfigError(f"sets of at most {most_pieces} pieces are too coarse for {len(self.walls)} walls; allow at least {least}")
        self.bounds, self.most_pieces, self.radius_m = bounds, most_pieces, radius_m
        shorter, longer = Interval(step_m * (1 - bounds.step)), Interval(step_m * (1 + bounds.step))
        self._step = shorter.lower, longer.upper
        turn = bounce_deg % _FULL_DEG  # whole turns would only be rounded
        self._turn = radians(turn - bounds.turn_deg, turn + bounds.turn_deg)
        self._headings = [radians(low % _FULL_DEG, low % _FULL_DEG + min(high - low, Fraction(_FULL_DEG))) for low, high in headings_deg]
        origin = self.walls.origin
        self._region = None
        if region is not None:
            self._region = [Interval(region[side] - origin[side], region[side + 2] - origin[side]) for side in (0, 1)]

    def __repr__(self) -> str:
        return f"<RayModel among {len(self.walls)} walls, {self.bounds}>"

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

    def ways(self, states: RaySet) -> tuple[FloatArray, FloatArray]:
        """Return how far the robot has driven at least, when it bumps now, and at most, for each piece, in metres."""
        least = np.maximum(states.steps - self.bounds.count, 0).astype(np.float64) * self._step[0]
        most = (states.steps + (self.bounds.count + 1)).astype(np.float64) * self._step[1]
        return least * BELOW, most * ABOVE

    def _stepped(self, states: RaySet) -> RaySet:
        more = RaySet(states.walls, states.lower, states.upper, (states.steps + 1).astype(np.int32), states.arriving, states.reach)
        kept = more.reach >= self.ways(more)[0]
        return more if kept.all() else more.only(kept)

    def _bumped(self, states: RaySet) -> RaySet:
        """Return the pieces of walls that the robot leaves from after a bump now."""
        check_rounding()
        arrived, leaving = self._arrived(states.only(states.arriving)), states.only(~states.arriving)
        hit = self._with_corners(RaySet.joined(arrived, self._shot(leaving)[1]))[1]
        count = len(hit)
        turn = Boxes.column(np.full(count, self._turn[0]), np.full(count, self._turn[1]))
        turned = Boxes.column(hit.lower[:, 1], hit.upper[:, 1]) + turn
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

    def _arrived(self, states: RaySet) -> RaySet:
        """Return the pieces to which the robot can have come from where it was at the start."""
        least, most = self.ways(states)
        states = states.only(states.reach >= least)
        if self._region is None or not len(states):
            return states
        least, most = self.ways(states)
        places = self._moved(states, -np.minimum(most, states.reach), -least)
        inside = np.ones(len(states), dtype=np.bool_)
        for side, known in enumerate(self._region):
            inside &= (places.upper[:, side] >= known.lower) & (places.lower[:, side] <= known.upper)
        return states.only(inside)

    def hits(self, states: RaySet) -> tuple[npt.NDArray[np.int64], RaySet]:
        """Return which piece each robot has left from that bumps now, and the pieces of walls that they touch before they turn."""
        begins, shot = self._shot(states)
        rows, touched = self._with_corners(shot)
        return begins[rows], touched

    def _shot(self, states: RaySet) -> tuple[npt.NDArray[np.int64], RaySet]:
        table, links = self.walls.table
        least, most = self.ways(states)
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

    def _with_corners(self, states: RaySet) -> tuple[npt.NDArray[np.int64], RaySet]:
        """Return the set with corners that were touched on both their walls: from a reflex corner, either lets the robot go on.

        Before it, which piece each of its pieces was.
        """
        _, links = self.walls.table
        starting = np.flatnonzero((states.lower[:, 0] <= 0.0) & (links[states.walls, 2] < 0))
        ending = np.flatnonzero((states.upper[:, 0] >= 1.0) & (links[links[states.walls, 0], 2] < 0))
        sets = [states]
        for rows, there, link in ((starting, 1.0, 1), (ending, 0.0, 0)):
            part = states.only(rows)
            lower, upper = part.lower.copy(), part.upper.copy()
            lower[:, 0] = upper[:, 0] = there
            sets.append(RaySet(links[part.walls, link], lower, upper, part.steps, part.arriving, part.reach))
        return np.concatenate([np.arange(len(states)), starting, ending]), RaySet.joined(*sets)

    def places(self, states: RaySet) -> Boxes:
        """Return where the robot can be now: boxes of x, y in the frame of the environment and the heading in radians.

        Raises
        ------
        ConfigError
            If some of the robots have not bumped yet: they can be everywhere.
        """
        if states.arriving.any():
            raise ConfigError("the robot has not bumped yet, so it can be anywhere that its region allows; ask after the first bump")
        least = np.maximum(states.steps - self.bounds.count, 0) * self._step[0]
        most = np.minimum((states.steps + self.bounds.count) * self._step[1], states.reach)
        moved = self._moved(states, least * BELOW, np.maximum(most, least) * ABOVE)
        shift = Boxes.of([Interval(self.walls.origin[0]), Interval(self.walls.origin[1])])
        there = Boxes(moved.lower[:, :2], moved.upper[:, :2]) + Boxes(
            np.repeat(shift.lower, len(states), axis=0), np.repeat(shift.upper, len(states), axis=0)
        )
        return Boxes(np.concatenate([there.lower, states.lower[:, 1:]], axis=1), np.concatenate([there.upper, states.upper[:, 1:]], axis=1))

    def _moved(self, states: RaySet, near: npt.ArrayLike, far: npt.ArrayLike) -> Boxes:
        """Return boxes of x and y, counted from the origin, of robots that moved along their headings by so much from their pieces."""
        table, _ = self.walls.table
        wall = table[states.walls]
        part, heading = Boxes.column(states.lower[:, 0], states.upper[:, 0]), Boxes.column(states.lower[:, 1], states.upper[:, 1])
        way = Boxes.column(near, far)
        margin = self.walls.margin + self.walls.bulge[states.walls]
        bounds = []
        for side, wave in ((0, cos), (1, sin)):
            moved = part * wall[:, 2 + side : 3 + side] + wall[:, side : 1 + side] + way * wave(heading)
            bounds.append((moved.lower[:, 0] - margin, moved.upper[:, 0] + margin))
        return Boxes(np.stack([low for low, _ in bounds], axis=1), np.stack([high for _, high in bounds], axis=1))


def radians(low_deg: Fraction, high_deg: Fraction) -> tuple[float, float]:
    """Return bounds in radians of an interval of degrees."""
    turn = Interval(TWO_PI_LOWER, TWO_PI_UPPER) * Interval(low_deg / _FULL_DEG, high_deg / _FULL_DEG)
    return turn.lower, turn.upper
