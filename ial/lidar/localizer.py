"""`Localizer`: the set-membership localizer, scan by scan."""

import dataclasses
import time

from ial.contractors.boxes import Boxes
from ial.datasets.motion import Motion
from ial.datasets.scan import LaserScan
from ial.lidar.configuration.config import Bounds, LocalizerConfig, Outliers
from ial.lidar.estimate import Estimate, judge, radius
from ial.lidar.evidence.beams import Beams, scan_beams
from ial.lidar.global_check import GlobalCheck, check_everywhere
from ial.lidar.hypothesis import find_hypotheses
from ial.lidar.images import are_images
from ial.lidar.model import LidarModel
from ial.lidar.pose_set import PoseSet
from ial.lidar.vanishing import is_vanishing
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.membership.set_membership_filter import SetMembershipFilter
from ial.pose import Pose


class Localizer:
    """Finds all poses of a robot in a map that its scans and its odometry allow.

    If at most q of the used beams are bad at the true pose, every motion is within its interval, and the domain holds the pose, then the
    pose is in the returned set. Several localizers may be used from several threads; one localizer belongs to one thread at a time.

    Parameters
    ----------
    grid
        The map.
    bounds
        How wrong the data may be; overrides that of `config`.
    outliers
        How many beams may be bad, a whole number, a fraction or "auto"; overrides that of `config`.
    config
        Everything else.
    initial
        Boxes (x, y, θ) in the map frame in which the search starts, headings of any turn; the whole map by default.

    Raises
    ------
    MapError
        If the map cannot serve for localization.
    ConfigError
        If the start lies outside the domain.
    ValueError
        If a bound of the start is NaN.

    Examples
    --------
    >>> from ial.datasets.sample import sample_grid, sample_recording
    >>> from ial.datasets.recording import steps
    >>> localizer = Localizer(sample_grid())
    >>> for step in steps(sample_recording(), localizer.config.bounds.motion):
    ...     estimate = localizer.update(step.motion, step.scan)
    >>> estimate.status, len(estimate.hypotheses)
    ('localized', 1)
    """

    def __init__(
        self,
        grid: OccupancyGrid,
        bounds: Bounds | None = None,
        outliers: Outliers | None = None,
        config: LocalizerConfig | None = None,
        initial: Boxes | None = None,
    ) -> None:
        config = config or LocalizerConfig()
        if bounds is not None:
            config = dataclasses.replace(config, bounds=bounds)
        if outliers is not None:
            config = dataclasses.replace(config, outliers=outliers)
        self.config = config
        self.grid = grid
        self.initial = initial
        self.model = LidarModel(grid, config)
        self._start = self.model.universe() if initial is None else self.model.within(initial)
        # A part of the map may tell a pose from its image; only all of it is known not to.
        self._start_symmetries = self.model.symmetries() if initial is None else ()
        self.reset()

    def __repr__(self) -> str:
        return f"<Localizer in {self.grid!r}; now {self.poses!r}>"

    def reset(self) -> None:
        """Forget everything but the start."""
        self._updates = 0
        self._symmetries = self._start_symmetries
        self._filter = SetMembershipFilter(self.model, self.config.recovery, self._start)

    def resume(self, poses: PoseSet, *, same_start: bool = False) -> None:
        """Go on from a set of poses, in the grid's frame.

        Parameters
        ----------
        poses
            The set.
        same_start
            Whether `poses` of a localizer with this map, this configuration and this start has given it. Where it came from is else
            unknown, and no answer is called `symmetric`.

        Raises
        ------
        ValueError
            If a box is empty, or a bound is NaN or infinite; an interval of headings of a turn or more is the full circle.
        """
        self._symmetries = self._start_symmetries if same_start else ()
        self._filter = SetMembershipFilter(self.model, self.config.recovery, poses.checked())

    @property
    def start(self) -> PoseSet:
        """The set of poses that is assumed before the first scan, in the grid's frame."""
        return self._start

    @property
    def poses(self) -> PoseSet:
        """The present set of poses, in the grid's frame: whole cells, of which an estimate tells what `precision.halvings` leaves."""
        return self._filter.states

    def locate(self, scan: LaserScan) -> Estimate:
        """Return the static answer: all poses that one scan alone allows. What was learned from other scans is neither used nor changed."""
        return self._estimate(SetMembershipFilter(self.model, self.config.recovery, self._start), self._start_symmetries, None, scan)

    def update(self, motion: Motion | None, scan: LaserScan) -> Estimate:
        """Take the motion since the last scan and a scan; return all poses that everything so far allows.

        Parameters
        ----------
        motion
            All motions that the odometry allows since the last scan; None before the first one.
        scan
            The scan.
        """
        estimate = self._estimate(self._filter, self._symmetries, motion, scan)
        self._updates += 1
        every = self.config.check_every
        if every and self._updates % every == 0 and estimate.status not in ("lost", "blind"):
            begun = time.perf_counter()
            check = self.check(scan)
            estimate = dataclasses.replace(estimate, check=check, elapsed_s=estimate.elapsed_s + time.perf_counter() - begun)
        return estimate

    def check(self, scan: LaserScan) -> GlobalCheck | None:
        """Search the whole map for a place where the last scan fits better than in the present set; see `check_everywhere`."""
        return check_everywhere(self.model, self.poses, scan_beams(scan, self.config))

    def _estimate(
        self,
        tracker: SetMembershipFilter[PoseSet, Motion | None, Beams],
        symmetries: tuple[Pose, ...],
        motion: Motion | None,
        scan: LaserScan,
    ) -> Estimate:
        beams = scan_beams(scan, self.config)
        rejection = tracker.update(motion, beams)
        poses = tracker.remaining
        hypotheses = find_hypotheses(poses, self.grid, counted=beams.informative, rejected=rejection is not None)
        status = judge(
            hypotheses,
            self.config.localized_size,
            rejected=rejection is not None,
            confirmed=not bool(poses.unconfirmed.all()),
            symmetric=are_images(poses, symmetries, self.grid.width_m + self.grid.height_m),
        )
        pose = hypotheses[0].centre if status == "localized" else None
        return Estimate(
            stamp_ns=scan.stamp_ns,
            status=status,
            hypotheses=hypotheses,
            pose=pose,
            poses=poses,
            beams=len(beams),
            outliers_allowed=poses.outliers if beams.informative else beams.outliers,
            radius_m=None if pose is None else radius(poses, pose, self.grid),
            uninformative=not beams.informative,
            limited=poses.limited,
            vanishing=len(poses) > 0 and is_vanishing([poses], beams),
            elapsed_s=beams.deadline.elapsed_s,
            rejection=rejection,
        )
