"""`Atlas`: several maps at once, to find out in which building, or on which floor, the robot is."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from ial.datasets.motion import Motion
from ial.datasets.scan import LaserScan
from ial.errors import ConfigError
from ial.lidar.configuration.config import LocalizerConfig
from ial.lidar.estimate import Status, judge
from ial.lidar.evidence.beams import Beams, scan_beams
from ial.lidar.hypothesis import Hypothesis, find_hypotheses
from ial.lidar.model import LidarModel
from ial.lidar.pose_set import PoseSet
from ial.lidar.pose_sets import PoseSets
from ial.lidar.search.outlier_budget import within_budget
from ial.lidar.vanishing import is_vanishing
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.membership.set_membership_filter import Rejection, SetMembershipFilter
from ial.membership.worlds import Worlds
from ial.pose import Pose


class AtlasModel(Worlds[PoseSet, Motion | None, Beams]):
    """Sets of poses, one for each map, which a scan cuts at one number of bad beams.

    Parameters
    ----------
    models
        The maps by their names; at least one.
    """

    def __init__(self, models: Mapping[str, LidarModel]) -> None:
        super().__init__(models)
        self._maps = dict(models)

    def step(self, states: dict[str, PoseSet], motion: Motion | None, reading: Beams) -> dict[str, PoseSet]:
        """Return what a scan leaves of the moved poses."""
        return self.contract(self.predict(states, motion), reading)

    def anew(self, reading: Beams) -> dict[str, PoseSet]:
        """Return what a scan leaves of all poses in all maps."""
        return self.contract(self.universe(), reading)

    def contract(self, states: dict[str, PoseSet], reading: Beams) -> dict[str, PoseSet]:
        """Return the poses that a scan allows, with as many bad beams in every map as the best of them needs."""
        if not reading.informative:
            return states
        return within_budget(reading, PoseSets(states), lambda most: self._contracted(states, most)).by_map

    def _contracted(self, states: dict[str, PoseSet], reading: Beams) -> PoseSets:
        """Contract map by map, each in an equal part of the time that is left."""
        contracted = {}
        for waiting, (name, model) in zip(range(len(self._maps), 0, -1), self._maps.items(), strict=True):
            contracted[name] = model.contract(states[name], replace(reading, deadline=reading.deadline.part(1.0 / waiting)))
        return PoseSets(contracted)

    def unite(self, allowed: dict[str, PoseSet], predicted: dict[str, PoseSet]) -> dict[str, PoseSet]:
        """Return the union in each map. Where nothing was found in any, q is compared with that of the prediction hereafter."""
        accepted = PoseSets(allowed if len(PoseSets(allowed)) else predicted).accepted
        return {name: replace(each, accepted=accepted) for name, each in super().unite(allowed, predicted).items()}


@dataclass(frozen=True)
class Whereabouts:
    """All poses in all maps that the data up to a scan allow.

    Parameters
    ----------
    stamp_ns
        Time of the scan, nanoseconds.
    status
        As in `Estimate`, over all maps: `localized` means one hypothesis in one map. Symmetries of a map are not looked for.
    hypotheses
        The connected sets of poses of each map, none where the robot cannot be.
    map, pose
        The map and the pose in it while `localized`, else None.
    outliers_allowed
        q: how many beams may be bad. As in `Estimate`: one number for all maps.
    elapsed_s
        How long it took.
    vanishing
        As in `Estimate`: whether hardly anything is left in all maps together.
    rejection
        As in `Estimate`, where the scan fits nowhere in any map.
    """

    stamp_ns: int
    status: Status
    hypotheses: dict[str, tuple[Hypothesis, ...]]
    map: str | None
    pose: Pose | None
    outliers_allowed: int
    elapsed_s: float
    vanishing: bool = False
    rejection: Rejection | None = None

    @property
    def possible(self) -> tuple[str, ...]:
        """The names of the maps in which the robot may be."""
        return tuple(name for name, remaining in self.hypotheses.items() if remaining)


class Atlas:
    """Finds all poses in several maps that scans and odometry allow, and which maps are impossible.

    If the robot is in one of the maps, and the assumptions of `Localizer` hold there, its pose is in the answer for that map. If it is in
    none of them (an unknown floor), the answer is usually empty soon: status `blind`.

    Parameters
    ----------
    grids
        The maps by their names.
    config
        Bounds, precision and limits, for all maps.

    Raises
    ------
    ConfigError
        If there is no map.
    MapError
        If a map cannot serve for localization.

    Examples
    --------
    >>> from ial.datasets.recording import steps
    >>> from ial.datasets.sample import sample_grid, sample_recording
    >>> from ial.lidar import Atlas
    >>> from ial.maps.grids.floor_plan import floor_plan
    >>> atlas = Atlas({"faculty": sample_grid(), "elsewhere": floor_plan(20.0, 15.0, 0.05, 1)})
    >>> for step in steps(sample_recording(), atlas.config.bounds.motion):
    ...     whereabouts = atlas.update(step.motion, step.scan)
    >>> whereabouts.status, whereabouts.possible
    ('localized', ('faculty',))
    """

    def __init__(self, grids: Mapping[str, OccupancyGrid], config: LocalizerConfig | None = None) -> None:
        if not grids:
            raise ConfigError("no map to localize in; give at least one")
        self.config = config or LocalizerConfig()
        self.grids = dict(grids)
        self.model = AtlasModel({name: LidarModel(grid, self.config) for name, grid in self.grids.items()})
        self._filter = SetMembershipFilter(self.model, self.config.recovery)

    def __repr__(self) -> str:
        return f"<Atlas of {len(self.grids)} map{'s' * (len(self.grids) != 1)}: {', '.join(self.grids)}>"

    @property
    def poses(self) -> dict[str, PoseSet]:
        """The present set of poses of each map, in the grid's frame."""
        return self._filter.states

    def update(self, motion: Motion | None, scan: LaserScan) -> Whereabouts:
        """Take the motion since the last scan and a scan; return all poses that everything so far allows.

        Parameters
        ----------
        motion
            All motions that the odometry allows since the last scan; None before the first one.
        scan
            The scan.
        """
        beams = scan_beams(scan, self.config)
        rejection = self._filter.update(motion, beams)
        known = PoseSets(self._filter.remaining)
        lost, counted = rejection is not None, beams.informative
        hypotheses = {
            name: find_hypotheses(poses, self.grids[name], counted=counted, rejected=lost) for name, poses in known.by_map.items()
        }
        every = tuple(each for of_map in hypotheses.values() for each in of_map)
        status = judge(every, self.config.localized_size, rejected=lost, confirmed=not known.unconfirmed)
        place = next(name for name, each in hypotheses.items() if each) if status == "localized" else None
        return Whereabouts(
            stamp_ns=scan.stamp_ns,
            status=status,
            hypotheses=hypotheses,
            map=place,
            pose=None if place is None else hypotheses[place][0].centre,
            outliers_allowed=known.outliers if beams.informative else beams.outliers,
            elapsed_s=beams.deadline.elapsed_s,
            vanishing=len(known) > 0 and is_vanishing(known.by_map.values(), beams),
            rejection=rejection,
        )
