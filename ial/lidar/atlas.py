"""`Atlas`: several maps at once, to find out in which building, or on which floor, the robot is."""

import time
from collections.abc import Mapping
from dataclasses import dataclass, replace

from ial.contractors.boxes import Boxes
from ial.datasets.motion import Motion
from ial.datasets.scan import LaserScan
from ial.errors import ConfigError
from ial.lidar.configuration.config import LocalizerConfig
from ial.lidar.estimate import Hypothesis, Status, find_hypotheses, judge
from ial.lidar.evidence.beams import Beams, scan_beams
from ial.lidar.model import LidarModel
from ial.lidar.pose_set import PoseSet, unite
from ial.lidar.pose_sets import PoseSets
from ial.lidar.search.outlier_budget import within_budget
from ial.lidar.vanishing import is_vanishing
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.membership import Model, SetMembershipFilter
from ial.pose import Pose


class AtlasModel(Model[PoseSets, Motion | None, Beams]):
    """Sets of poses, one for each map: together they are one set, which is empty only if all of them are.

    Parameters
    ----------
    models
        The maps by their names; at least one.
    """

    def __init__(self, models: Mapping[str, LidarModel]) -> None:
        self.models = dict(models)
        self._universe = PoseSets({name: model.universe() for name, model in self.models.items()})
        self._recovery = next(iter(self.models.values())).config.recovery

    def universe(self) -> PoseSets:
        """Return every pose in every map."""
        return self._universe

    def predict(self, states: PoseSets, motion: Motion | None) -> PoseSets:
        """Return the moved poses; no motion leads from one map into another."""
        return PoseSets({name: model.predict(states.by_map[name], motion) for name, model in self.models.items()})

    def contract(self, states: PoseSets, reading: Beams) -> PoseSets:
        """Return the poses that a scan allows, with as many bad beams in every map as the best of them needs."""
        if not reading.informative:
            return states
        return within_budget(reading, states, lambda most: self._contracted(states, most))

    def _contracted(self, states: PoseSets, reading: Beams) -> PoseSets:
        return PoseSets({name: model.contract(states.by_map[name], reading) for name, model in self.models.items()})

    def refine(self, states: PoseSets, reading: Beams) -> PoseSets:
        """Return what a scan has left in each map, as `LidarModel` refines it."""
        return PoseSets({name: model.refine(states.by_map[name], reading) for name, model in self.models.items()})

    def empty(self, states: PoseSets) -> bool:
        """Return whether no pose is left in any map."""
        return not len(states)

    def recover(self, states: PoseSets, motion: Motion | None, reading: Beams) -> PoseSets:
        """Return what to go on with after a scan that fits nowhere in any prediction: every map is searched, as `LidarModel` does."""
        predicted = self.predict(states, motion)
        searched = motion is None and states is self._universe
        found = PoseSets(dict.fromkeys(self.models, PoseSet(Boxes.none(3), outliers=reading.outliers)))
        if not searched:
            found = self.contract(self._universe, reading)
            found = PoseSets({name: self.models[name].unrefuted(each, reading) for name, each in found.by_map.items()})
        if len(found) and self._recovery == "restart":
            return found
        united = {name: unite(each, predicted.by_map[name]) for name, each in found.by_map.items()}
        accepted = found.accepted if len(found) else predicted.accepted
        return PoseSets({name: replace(each, accepted=accepted) for name, each in united.items()})


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
    """

    stamp_ns: int
    status: Status
    hypotheses: dict[str, tuple[Hypothesis, ...]]
    map: str | None
    pose: Pose | None
    outliers_allowed: int
    elapsed_s: float
    vanishing: bool = False

    @property
    def possible(self) -> tuple[str, ...]:
        """The names of the maps in which the robot may be."""
        return tuple(name for name, found in self.hypotheses.items() if found)


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
        self._filter = SetMembershipFilter(self.model, self.model.recover)

    @property
    def poses(self) -> dict[str, PoseSet]:
        """The present set of poses of each map, in the grid's frame."""
        return self._filter.states.by_map

    def update(self, motion: Motion | None, scan: LaserScan) -> Whereabouts:
        """Take the motion since the last scan and a scan; return all poses that everything so far allows.

        Parameters
        ----------
        motion
            All motions that the odometry allows since the last scan; None before the first one.
        scan
            The scan.
        """
        begun = time.perf_counter()
        for model in self.model.models.values():
            model.start_clock()
        beams = scan_beams(scan, self.config)
        rejection = self._filter.update(motion, beams)
        known = self._filter.remaining
        lost, counted = rejection is not None, beams.informative
        hypotheses = {
            name: find_hypotheses(poses, self.grids[name], counted=counted, rejected=lost) for name, poses in known.by_map.items()
        }
        every = tuple(each for found in hypotheses.values() for each in found)
        status = judge(every, self.config.localized_size, rejected=lost, found=not known.unconfirmed)
        place = next(name for name, each in hypotheses.items() if each) if status == "localized" else None
        return Whereabouts(
            stamp_ns=scan.stamp_ns,
            status=status,
            hypotheses=hypotheses,
            map=place,
            pose=None if place is None else hypotheses[place][0].centre,
            outliers_allowed=known.outliers if beams.informative else beams.outliers,
            elapsed_s=time.perf_counter() - begun,
            vanishing=len(known) > 0 and is_vanishing(known.by_map.values(), beams),
        )
