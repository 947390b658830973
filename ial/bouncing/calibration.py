"""`Calibration`: the smallest bounds of errors that explain runs from known starts, by the sets of the ray mode themselves.

A bound is refuted if the set of some run becomes empty with it. Sets hold every robot that keeps to the bounds, and those of smaller bounds
are smaller, so a bound that is refuted is too small for certain, and so is each below it. One that is not refuted explains the runs as far
as these sets can tell; longer runs may refute it.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from ial.bouncing.bump_timing import BumpTiming
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.known_run import KnownRun
from ial.bouncing.rays.ray_grid import least_pieces
from ial.bouncing.rays.ray_model import RayModel
from ial.errors import ConfigError, StreamError
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.walls import Walls

STEP_PART, TURN_DEG = Fraction(1, 4096), Fraction(1, 64)
"""How finely bounds are told apart: of the speed, and of a turn in degrees."""

_MOST_STEP, _MOST_TURN_DEG = Fraction(1, 2), Fraction(90)
_FINER = 256  # into so many parts a step is divided when ways are computed from times
_PIECES = 4000
_MOST_COUNT = 2**30


@dataclass(frozen=True)
class LeastBound:
    """What runs say about a bound.

    Parameters
    ----------
    refuted
        The largest bound that was tried and is too small for certain; None if even 0 explains the runs.
    explained
        The smallest that was tried and explains them.
    """

    refuted: Fraction | None
    explained: Fraction


@dataclass(frozen=True)
class Calibration:
    """Bounds for a robot.

    Parameters
    ----------
    environment
        Where it drove.
    bounce_deg
        Its bouncing angle.
    step_m
        The step of the filter that is to be built; ways are told from times in a fine part of it.
    timing
        The speed, the time of a turn, and the tolerance of the clock, which is taken as given.
    start_error_m
        By how much x and y of a start may be wrong.
    heading_error_deg
        By how much its heading may be wrong.
    radius_m
        Its radius; 0 for a point.

    Raises
    ------
    ConfigError
        If the step is not positive, or a tolerance is negative.
    """

    environment: Environment
    bounce_deg: Fraction
    step_m: Fraction
    timing: BumpTiming
    start_error_m: Fraction = Fraction(0)
    heading_error_deg: Fraction = Fraction(0)
    radius_m: Fraction = Fraction(0)

    def __post_init__(self) -> None:
        if self.step_m <= 0:
            raise ConfigError(f"the step is {float(self.step_m):g} m; give a length greater than 0")
        if min(self.start_error_m, self.heading_error_deg) < 0:
            raise ConfigError("an error of a start is negative; give 0 or more")

    def explains(self, run: KnownRun, step: Fraction, turn_deg: Fraction) -> bool:
        """Return whether a robot within these bounds may have reported the run.

        Raises
        ------
        StreamError
            If a leg takes far too long to be one.
        """
        fine_m = self.step_m / _FINER
        bounds = ExecutionBounds(turn_deg, step, self.timing.count_error(fine_m))
        x, y, heading = run.place
        off, turned = self.start_error_m, self.heading_error_deg
        pieces = max(_PIECES, least_pieces(Walls.of(self.environment, self.radius_m)))
        headings, region = ((heading - turned, heading + turned),), (x - off, y - off, x + off, y + off)
        model = RayModel(self.environment, self.bounce_deg, fine_m, bounds, pieces, headings, region, self.radius_m)
        states = model.universe()
        for drive_s in run.drives_s:
            count = self.timing.steps(drive_s, fine_m)
            if count > _MOST_COUNT:
                raise StreamError(f"{run.where}: a leg of this run takes {float(drive_s):g} s, far too long; begin anew with a start")
            states = model.leg(states, count)
            if model.empty(states):
                return False
        return True

    def step_bound(self, runs: Sequence[KnownRun]) -> LeastBound:
        """Return what the first leg of each run, before which nothing turned, says about the error of the speed.

        Raises
        ------
        StreamError
            If even an error of a half does not explain one of them.
        """
        first = [KnownRun(run.place, run.drives_s[:1], run.where) for run in runs]
        self._check(first, _MOST_STEP, Fraction(0), f"no error of the speed up to {float(_MOST_STEP):.0%} explains its first leg; check")
        return _least(lambda step: all(self.explains(run, step, Fraction(0)) for run in first), STEP_PART, _MOST_STEP)

    def turn_bound(self, runs: Sequence[KnownRun], step: Fraction) -> LeastBound:
        """Return what whole runs say about the error of a turn, if the speed is wrong by so large a part at most.

        Raises
        ------
        StreamError
            If even an error of 90° does not explain one of them.
        """
        told = (
            f"no error of turns up to {float(_MOST_TURN_DEG):g}° explains it with a speed error of {float(step):g}; give a larger one "
            "(--speed-error), or check"
        )
        self._check(runs, step, _MOST_TURN_DEG, told)
        return _least(lambda turn: all(self.explains(run, step, turn) for run in runs), TURN_DEG, _MOST_TURN_DEG)

    def _check(self, runs: Sequence[KnownRun], step: Fraction, turn_deg: Fraction, fault: str) -> None:
        for run in runs:
            if not self.explains(run, step, turn_deg):
                raise StreamError(f"{run.where}: {fault} the place of the start, the map, the speed, and the time of a turn")


def _least(explains: Callable[[Fraction], bool], unit: Fraction, most: Fraction) -> LeastBound:
    """Return the least multiple of a unit that explains, told from the one below it; the most is known to explain."""
    if explains(Fraction(0)):
        return LeastBound(None, Fraction(0))
    refuted, explained = Fraction(0), unit
    while explained < most and not explains(explained):  # errors are small, so large sets are tried last
        refuted, explained = explained, 2 * explained
    explained = min(explained, most)
    while explained - refuted > unit:
        middle = (refuted + explained) / 2 // unit * unit
        refuted, explained = (refuted, middle) if explains(middle) else (middle, explained)
    return LeastBound(refuted, explained)
