"""The hunt for poses that an answer must hold, at one scan in one map.

The oracle is the twin in `ial.study`, which shares no code with the search. A pose must be in an answer if at most as many used beams are
bad there as the answer prints, it certainly lies in the domain, and a motion within its box leads there from a pose of the set before.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ial.contractors.boxes import Boxes
from ial.datasets.motion import Motion
from ial.lidar import Hypothesis, PoseSet
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose
from ial.study import Domain, Obstacles, UsedBeams, consistent
from tests.lidar.box_index import BoxIndex
from tests.lidar.fuzz_drives import Drive, Moment

MARGIN = 1e-9  # what a sample keeps off a bound that it is drawn within, which covers the rounding of the oracle
_HALVINGS = 7  # of the way from a consistent pose to where it is consistent no more
_TRIES = 4  # motions that are tried to find from where a pose was reached
_AT_ONCE = 512

Array = np.ndarray
Random = np.random.Generator


@dataclass(frozen=True, eq=False)
class Part:
    """The set before a scan in one map, the answer after it, and what was printed of it; what of that is wrong by itself."""

    before: BoxIndex
    after: PoseSet
    hypotheses: tuple[Hypothesis, ...]
    status: str
    allowed: int
    circle: tuple[Pose, float] | None = None
    wrong: str = ""


class Oracle:
    """A map, as docs/guarantee.md sees it."""

    def __init__(self, grid: OccupancyGrid, drive: Drive) -> None:
        self.grid = grid
        self.obstacles = Obstacles(grid)
        self.domain = Domain(grid, drive.config, self.obstacles)
        self.rounding = 2.0**-46 * (abs(grid.origin.x) + abs(grid.origin.y) + grid.width_m + grid.height_m + 10.0)  # between two frames
        self.sizes = np.array([3.0, 3.0, 0.0]) * grid.resolution + [0.0, 0.0, 0.2]

    def in_map(self, poses: Array) -> Array:
        return np.stack(self.grid.to_map(*poses.T), axis=1)

    def candidates(self, drive: Drive, moment: Moment, place: str, count: int, random: Random) -> Array:
        """Return poses at the truth, at its images, around these, and anywhere, a little outside of the map too."""
        far = np.array([self.grid.width_m, self.grid.height_m, math.pi])
        anywhere = random.uniform(far * [-0.01, -0.01, -1.0], far * [1.01, 1.01, 1.0], (count, 3))
        truth = moment.pose if moment.place == place else anywhere[0]
        near = np.array([truth, *drive.images(truth)])
        start = near[random.integers(0, len(near), count) * (random.random(count) < 0.3)]
        around = start + random.normal(0.0, 1.0, (count, 3)) * self.sizes * 10.0 ** random.uniform(-4.0, 0.0, (count, 1))
        return np.vstack([near, around, anywhere])


class Hunt:
    """The poses that the answer to one scan must hold in one map.

    Parameters
    ----------
    drive, moment, place
        What was localized, the scan, and in which map.
    part, oracle
        What was answered of that map, and what is true of it.
    """

    def __init__(self, drive: Drive, moment: Moment, place: str, part: Part, oracle: Oracle, random: Random) -> None:
        self.drive, self.moment, self.place = drive, moment, place
        self.part, self.oracle, self.random = part, oracle, random
        self.beams = UsedBeams.of(moment.scan, drive.config)
        self.rejected = part.status in ("lost", "blind")
        self.answer = BoxIndex(part.after.boxes)
        self.hulls = Boxes.of(*([each.x, each.y, each.theta] for each in part.hypotheses)) if part.hypotheses else Boxes.none(3)

    def wanted(self, effort: int) -> Iterator[tuple[Array, str]]:
        """Yield poses that the answer must hold, and why.

        Tried are poses around the truth, anywhere, at the border of the answer, where motions lead; and on from what holds, in all
        directions, by halving the way to where nothing holds any more. What is carried on must be there whatever the scan says.
        """
        reached = self._reached(effort)
        tries = [self.oracle.candidates(self.drive, self.moment, self.place, effort, self.random), self._beside_the_answer(effort)]
        held = np.vstack([reached[self._required(reached, reached=True)], *(each[self._required(each)] for each in tries)])
        yield held, "consistent"
        if len(held):
            starts = held[self.random.integers(0, len(held), effort)]
            stride = 10.0 ** self.random.uniform(-2.0, 0.5, (effort, 1))
            way = self.random.normal(0.0, 1.0, starts.shape) * self.oracle.sizes * stride
            low, high = np.zeros((effort, 1)), np.ones((effort, 1))
            for _ in range(_HALVINGS):
                middle = 0.5 * (low + high)
                at = starts + middle * way
                required = self._required(at)
                yield at[required], "consistent"
                low[required], high[~required] = middle[required], middle[~required]
        if self.part.status == "blind" or (self.part.status == "lost" and self.drive.config.recovery == "union"):
            yield reached[self.oracle.domain.holds(reached)], "carried on"

    def missing(self, poses: Array) -> Iterator[tuple[Array, str]]:
        """Yield those of some poses that are not where the answer says that all are."""
        outside = ~self.answer.contains(poses)
        outside[outside] = [not self.part.after.contains(Pose(*pose)) for pose in poses[outside].tolist()]
        yield poses[outside], "in a box"
        in_map = self.oracle.in_map(poses)
        for start in range(0, len(poses), _AT_ONCE):
            some = slice(start, start + _AT_ONCE)
            yield poses[some][~within(self.hulls, in_map[some], -self.oracle.rounding)], "in a hull"
        if self.part.circle is not None:
            centre, radius = self.part.circle
            far = np.hypot(in_map[:, 0] - centre.x, in_map[:, 1] - centre.y)
            yield poses[far > radius + self.oracle.rounding], "within the radius"

    def _required(self, poses: Array, *, reached: bool = False) -> Array:
        """Return which poses the answer must hold: consistent ones that may have been reached. A rejected scan is searched everywhere."""
        required = self.oracle.domain.holds(poses)
        if not self.rejected and not reached:
            required[required] = self._reachable(poses[required])
        required[required] = consistent(self.beams, poses[required], self.oracle.obstacles, self.part.allowed)
        return required

    def _reachable(self, poses: Array) -> Array:
        """Return which poses certainly lie in the set before, moved."""
        motion = self.moment.motion
        if motion is None:
            return self._in_start(poses)
        inside = np.zeros(len(poses), dtype=np.bool_)
        for _ in range(_TRIES):
            dx, dy, turn = self._motions(motion, len(poses)).T
            theta = poses[:, 2] - turn
            c, s = np.cos(theta), np.sin(theta)
            inside |= self.part.before.contains(
                np.stack([poses[:, 0] - c * dx + s * dy, poses[:, 1] - s * dx - c * dy, theta], axis=1), MARGIN
            )
        return inside

    def _reached(self, count: int) -> Array:
        """Return poses to which a motion leads from the set before, or those in which the robot is said to start."""
        motion, before = self.moment.motion, self.part.before
        if motion is None:
            initial = self.drive.initial
            if initial is None:
                return np.empty((0, 3))
            x, y, theta = self._inside(initial, count).T
            poses = np.stack(self.oracle.grid.to_grid(x, y, theta), axis=1)
            return np.asarray(poses[self._in_start(poses)])
        poses = self._inside(Boxes(before.lower, before.upper), count)
        dx, dy, turn = self._motions(motion, len(poses)).T
        c, s = np.cos(poses[:, 2]), np.sin(poses[:, 2])
        return np.asarray(poses + np.stack([c * dx - s * dy, s * dx + c * dy, turn], axis=1))

    def _in_start(self, poses: Array) -> Array:
        initial = self.drive.initial
        if initial is None:
            return np.ones(len(poses), dtype=np.bool_)
        return within(initial, self.oracle.in_map(poses), MARGIN + self.oracle.rounding)

    def _inside(self, boxes: Boxes, count: int) -> Array:
        """Return poses in boxes, often in their corners."""
        if not len(boxes):
            return np.empty((0, 3))
        rows = self.random.integers(0, len(boxes), count)
        low, high = boxes.lower[rows] + 2.0 * MARGIN, boxes.upper[rows] - 2.0 * MARGIN
        return np.asarray((low + self._shares(count) * (high - low))[(low <= high).all(axis=1)])

    def _motions(self, motion: Motion, count: int) -> Array:
        low, high = (np.where(np.isfinite(each), each, np.sign(each) * 20.0) for each in (motion.lower, motion.upper))
        low, high = low + MARGIN, high - MARGIN
        return np.asarray(low + self._shares(count) * (high - low))

    def _shares(self, count: int) -> Array:
        random = self.random
        return np.where(random.random((count, 3)) < 0.3, random.integers(0, 2, (count, 3)), random.random((count, 3)))

    def _beside_the_answer(self, count: int) -> Array:
        """Return poses just outside of a face of a box of the answer, or farther."""
        poses = self._inside(self.part.after.boxes, count)
        axis = self.random.integers(0, 3, len(poses))
        by = self.random.choice([-1.0, 1.0], len(poses)) * 10.0 ** self.random.uniform(-9.0, 0.0, len(poses))
        poses[np.arange(len(poses)), axis] += by * self.oracle.sizes[axis]
        return poses


def within(boxes: Boxes, poses: Array, margin: float) -> Array:
    """Return which poses keep this far off the faces of some box from inside, whatever turn its headings are given in."""
    low, high, at = boxes.lower[None] + margin, boxes.upper[None] - margin, poses[:, None]
    inside = ((low[..., :2] <= at[..., :2]) & (at[..., :2] <= high[..., :2])).all(axis=2)
    width = high[..., 2] - low[..., 2]
    turned = np.mod(at[..., 2] - low[..., 2], 2.0 * math.pi)
    return np.asarray((inside & (width >= 0.0) & ((turned <= width) | (width >= 2.0 * math.pi))).any(axis=1))
