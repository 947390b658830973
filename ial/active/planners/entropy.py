"""`EntropyPlanner` and `TargetPlanner`: where the least entropy is to be expected, over a histogram that is kept within the set.

The former looks at the neighbouring cells alone, the latter at places farther away and at what the way there costs (Fox, Burgard, Thrun:
Active Markov localization for mobile robots, 1998).
"""

import math

import numpy as np
import numpy.typing as npt

from ial.active.belief import Belief
from ial.active.decision import Decision
from ial.active.planners.route import Place, Route
from ial.active.robot import Drive
from ial.contractors.boxes import Boxes
from ial.particles.markov import MarkovLocalization

_NEIGHBOURS = 8
_ALIKE = 1e-9  # nats: entropies this close are the same
MOST_POSES = 200


class Histogram:
    """A histogram that follows a belief.

    Parameters
    ----------
    belief
        What is known, and will be.
    """

    def __init__(self, belief: Belief) -> None:
        self.markov: MarkovLocalization | None = None
        self._belief = belief
        self._scans = 0

    def __repr__(self) -> str:
        return f"<Histogram after {self._scans} scans>"

    def follow(self, belief: Belief) -> MarkovLocalization:
        """Take in the last motion and the last scan, and leave out what the set leaves out."""
        if belief.scan is None:
            raise AssertionError("a planner is asked after the first scan")
        if self.markov is None:
            self.markov = MarkovLocalization(belief.grid, belief.range_m)
        if belief.motion is not None:
            self.markov.predict(belief.motion)
        self.markov.update(belief.scan)
        self.markov.keep(_held(self.markov, belief.poses))
        self._scans += 1
        return self.markov


def _held(markov: MarkovLocalization, poses: Boxes) -> npt.NDArray[np.bool_]:
    """Return the cells of a histogram in or beside which there is a pose of a set."""
    count, width = markov.options.headings, markov.options.cell_m
    held = np.zeros(markov.belief.shape, dtype=np.bool_)
    low = np.floor(poses.lower / [width, width, 2.0 * math.pi / count] - [0.5, 0.5, 0.5]).astype(np.int64)
    high = np.ceil(poses.upper / [width, width, 2.0 * math.pi / count] - [0.5, 0.5, 0.5]).astype(np.int64)
    for (x0, y0, h0), (x1, y1, h1) in zip(low.tolist(), high.tolist(), strict=True):
        rows, columns = slice(max(y0, 0), y1 + 1), slice(max(x0, 0), x1 + 1)
        for heading in range(h0, h1 + 2):
            held[heading % count, rows, columns] = True
    return held


class EntropyPlanner:
    """Looks one step ahead, in eight directions. It belongs to one run.

    Parameters
    ----------
    belief
        What is known, and will be.
    step_m
        How far a step leads.
    seed
        Directions that are as good are chosen from at random; the same seed gives the same choices.
    """

    def __init__(self, belief: Belief, step_m: float = 0.5, seed: int = 0) -> None:
        self._histogram = Histogram(belief)
        self._step_m = step_m
        self._random = np.random.default_rng(seed)

    def __repr__(self) -> str:
        return "<EntropyPlanner>"

    def choose(self, belief: Belief) -> Decision:
        """Return the next decision."""
        return self.by_entropy(belief, self._histogram.follow(belief))

    def by_entropy(self, belief: Belief, markov: MarkovLocalization) -> Decision:
        """Return the decision for a histogram that has followed the belief."""
        poses, weights = markov.likely(MOST_POSES)
        turns = [math.remainder(2.0 * math.pi * number / _NEIGHBOURS, 2.0 * math.pi) for number in range(_NEIGHBOURS)]
        ways = belief.safe_ways(turns, self._step_m)
        entropies = np.array(
            [markov.expected_entropy(poses, weights, turn, way) if way > 0.0 else math.inf for turn, way in zip(turns, ways, strict=True)]
        )
        if np.isinf(entropies).all():
            return Decision(None, "exhausted", "no direction is safe wherever the robot is")
        chosen = int(self._random.choice(np.flatnonzero(entropies <= entropies.min() + _ALIKE)))
        return Decision(Drive(turns[chosen], float(ways[chosen])), "entropy", f"{entropies[chosen]:.3g} nats are expected")


class TargetPlanner:
    """Looks at all places that can be reached: what is to be learned there, and what the way costs. It belongs to one run.

    Parameters
    ----------
    belief
        What is known, and will be.
    nats_per_m
        What a metre costs.
    seed
        Places that are as good are chosen from at random; the same seed gives the same choices.
    route
        How the robot gets there.
    """

    def __init__(self, belief: Belief, nats_per_m: float = 0.05, seed: int = 0, route: Route | None = None) -> None:
        self._histogram = Histogram(belief)
        self._nats_per_m = nats_per_m
        self._random = np.random.default_rng(seed)
        self._route = Route() if route is None else route
        self._target: Place | None = None
        self._done: list[Place] = []

    def __repr__(self) -> str:
        return "<TargetPlanner>"

    def choose(self, belief: Belief) -> Decision:
        """Return the next decision."""
        markov = self._histogram.follow(belief)
        space = self._route.space(belief, belief.groups())
        if self._target is not None:
            drive = self._route.towards(belief, space, self._target)
            if drive is not None:
                return Decision(drive, "target", "further to the same place", self._target, goes_on=True)
            self._done.append(self._target)
            self._target = None
        poses, weights = markov.likely(MOST_POSES)
        utilities = []
        for number in space.views(4):
            x, y = space.point(number)
            place = self._route.in_start(belief, space, x, y)
            if any(math.dist(place, done) < self._route.near_m / 2.0 for done in self._done):
                continue
            turn, way = math.atan2(y - space.here.y, x - space.here.x) - space.here.theta, math.hypot(x - space.here.x, y - space.here.y)
            expected = markov.expected_entropy(poses, weights, turn, way)
            utilities.append((-expected - self._nats_per_m * space.cost_m(number), float(self._random.random()), place))
        for utility, _, place in sorted(utilities, reverse=True):
            drive = self._route.towards(belief, space, place)
            if drive is not None:
                self._target = place
                return Decision(drive, "target", f"utility {utility:.3g} nats, the best of {len(utilities)} places", place)
            self._done.append(place)
        return Decision(None, "exhausted", "no further place can be reached safely wherever the robot is")
