"""`Belief`: where a robot can be, as planners see it: the set of a localizer, its groups, and where no pose of it would collide."""

import dataclasses
import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.active.bumps import Bumps
from ial.active.clearance_field import ClearanceField
from ial.active.explored_area import View
from ial.active.safe_way import Distances, safe_ways
from ial.contractors.boxes import Boxes
from ial.datasets.motion import Motion
from ial.datasets.scan import LaserScan
from ial.errors import ConfigError
from ial.lidar.estimate import Estimate
from ial.lidar.localizer import Localizer
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose

FloatArray = npt.NDArray[np.float64]

_GROUP_RAD = 0.3


@dataclass(frozen=True, eq=False)
class Groups:
    """Poses that are near each other, and connected.

    Parameters
    ----------
    poses
        A possible pose of each: the middle of a box, float64 of shape (m, 3), in the grid's frame.
    hulls
        A box around each.
    component
        To which connected part of the set each belongs, int64 of shape (m,).
    """

    poses: FloatArray
    hulls: Boxes
    component: npt.NDArray[np.int64]

    def __len__(self) -> int:
        return len(self.poses)

    def __repr__(self) -> str:
        return f"<Groups: {len(self)} in {self.parts} connected parts>"

    @property
    def parts(self) -> int:
        """How many connected parts of the set there are."""
        return len(set(self.component.tolist()))


class Belief:
    """What a lidar robot knows.

    It assumes that the robot starts with its clearance, and has it at each scan: `safe_ways` sees to that. Where something has stopped it
    before it came so far, it keeps its radius only, which is assumed instead until its next drive has ended.

    Parameters
    ----------
    localizer
        What localizes it. The bounds of odometry are those of its configuration, and so is the clearance: its `robot_radius_m`, since the
        robot keeps that distance at each scan.
    radius_m
        The radius of the robot.
    longest_s
        How long a drive takes at most, in seconds: some errors of odometry grow with the time.

    Raises
    ------
    MapError
        If the map has no free space for the robot.
    ConfigError
        If the radius is negative, or larger than the clearance, or no drive can take so long.

    Attributes
    ----------
    estimate
        The last answer; None before the first scan.
    moved
        Where it is, by the middle of its odometry, in the frame of its start.
    view
        What the last scan can have seen; None before the first.
    motion, scan
        The last ones; None before them.
    collided
        Whether something has stopped the last drive.
    bumps
        What has stopped it so far.
    """

    def __init__(self, localizer: Localizer, radius_m: float, longest_s: float) -> None:
        if not 0.0 < longest_s < math.inf:
            raise ConfigError(f"a drive takes {longest_s:g} s at most; give how long one may take, in seconds")
        self.longest_s = longest_s
        self._keeping = self.localizer = localizer
        self._stopped: Localizer | None = None
        self.bumps = Bumps(radius_m)
        self.distances = Distances(radius_m, localizer.config.robot_radius_m)
        self.field = ClearanceField.of(localizer.grid, self.distances.clearance_m)
        self.estimate: Estimate | None = None
        self.moved = Pose(0.0, 0.0, 0.0)
        self.view: View | None = None
        self.motion: Motion | None = None
        self.scan: LaserScan | None = None
        self.collided = False

    def __repr__(self) -> str:
        return f"<Belief: {self.status}>"

    @property
    def grid(self) -> OccupancyGrid:
        """The map."""
        return self.localizer.grid

    @property
    def range_m(self) -> float:
        """How far its lidar sees (m)."""
        return 0.0 if self.view is None else self.view.range_m

    @property
    def uses_no_return(self) -> bool:
        """Whether beams without return tell something."""
        return self.localizer.config.free_space.no_return

    @property
    def bad_part(self) -> float:
        """Which part of the beams of the last scan may be bad."""
        return 0.0 if self.estimate is None or not self.estimate.beams else self.estimate.outliers_allowed / self.estimate.beams

    @property
    def status(self) -> str:
        """The status of the last answer; ``blind`` before there is one."""
        return "blind" if self.estimate is None else self.estimate.status

    @property
    def poses(self) -> Boxes:
        """All poses that are possible, in the grid's frame."""
        return self.localizer.poses.boxes if self.estimate is None else self.estimate.poses.boxes

    def update(self, motion: Motion | None, scan: LaserScan, *, collided: bool = False) -> Estimate:
        """Take a motion, and a scan.

        Parameters
        ----------
        motion
            None before the first scan.
        scan
            What the robot sees after it.
        collided
            Whether it touched something on its way, and stopped.

        Raises
        ------
        ConfigError
            If the first scan has no beam that tells anything.
        """
        self._assume(collided)
        self.estimate = self.localizer.update(motion, scan)
        if motion is None and self.estimate.uninformative:
            raise ConfigError("the first scan has no usable beam, so nothing can be learned by driving; check the lidar and its limits")
        self.motion, self.scan = motion, scan
        if motion is not None:
            middle = 0.5 * (motion.lower + motion.upper)
            self.moved = self.moved @ Pose(*middle.tolist())
        self.view = View.of(scan, self.moved)
        if collided:
            self.bumps.add(self.moved)
        return self.estimate

    def _assume(self, collided: bool) -> None:
        """Choose the localizer of what the robot keeps where it is now: its clearance, or its radius."""
        if collided and self._stopped is None:
            config = dataclasses.replace(self._keeping.config, robot_radius_m=self.distances.radius_m)
            self._stopped = Localizer(self.grid, config=config, initial=self._keeping.initial)
        needed = self._stopped if collided and self._stopped is not None else self._keeping
        if needed is not self.localizer:
            needed.resume(self.localizer.poses, same_start=True)
            self.localizer = needed
        self.collided = collided
        self.distances = dataclasses.replace(self.distances, now_m=self.distances.radius_m if collided else None)

    def safe_ways(self, turns_rad: npt.ArrayLike, most_m: float) -> FloatArray:
        """Return how far it can drive after some turns (m), wherever it is, but not into a bump again; −1 where no way is safe."""
        turns, bounds = np.asarray(turns_rad, dtype=np.float64), self.localizer.config.bounds.motion
        limits = self.bumps.limits_m(self.moved, turns)
        return safe_ways(self.poses, turns, most_m, self.field, self.distances, bounds, self.longest_s, limits)

    def groups(self, width_m: float = 1.0, most: int = 64) -> Groups:
        """Return the parts of the set that a planner tells apart.

        Parameters
        ----------
        width_m
            How wide a part is, about.
        most
            Of more, so many are returned, spread evenly over the connected parts of the set. Planners only prefer by them: what is safe is
            decided for all poses.
        """
        boxes = self.poses
        labels = np.zeros(len(boxes), dtype=np.int64) if self.estimate is None else self.estimate.poses.clusters.labels
        middle = boxes.midpoint()
        cells = np.floor(middle / [width_m, width_m, _GROUP_RAD]).astype(np.int64)
        _, number = np.unique(np.column_stack([labels, cells]), axis=0, return_inverse=True)
        number = number.reshape(-1)
        count = int(number.max(initial=-1)) + 1
        if count > most:
            kept = np.unique(np.linspace(0, count - 1, most).round().astype(np.int64))
            new = np.full(count, -1)
            new[kept] = np.arange(len(kept))
            rows = new[number] >= 0
            boxes, labels, middle, number = boxes[rows], labels[rows], middle[rows], new[number[rows]]
        order = np.argsort(number, kind="stable")
        starts = np.flatnonzero(np.diff(number[order], prepend=-1))
        lower, upper = np.minimum.reduceat(boxes.lower[order], starts), np.maximum.reduceat(boxes.upper[order], starts)
        away = np.abs(middle - 0.5 * (lower + upper)[number]).max(axis=1)
        nearest = np.lexsort((away, number))[starts]
        return Groups(middle[nearest], Boxes(lower, upper), labels[nearest])
