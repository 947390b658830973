"""The fuzzer: random drives are localized as any user would do it, and poses are looked for that an answer has lost."""

import math
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from fractions import Fraction

import numpy as np

from ial.contractors.boxes import Boxes
from ial.errors import ConfigError, MapError
from ial.lidar import Atlas, Estimate, Localizer, ScanContractor
from ial.lidar.evidence.beams import scan_beams
from ial.maps.grids.cell_index import CellIndex
from ial.maps.grids.occupancy_grid import OCCUPIED
from ial.study import UsedBeams, consistent
from tests.lidar.box_index import BoxIndex
from tests.lidar.fuzz_drives import MODES, Drive, Moment, random_drive
from tests.lidar.pose_hunt import Hunt, Oracle, Part

ALL_MODES = (*MODES, "contractor")


@dataclass(frozen=True)
class Loss:
    """A pose that an answer should hold and does not; mode and seed give the drive again."""

    mode: str
    seed: int
    scan: int
    place: str
    pose: tuple[float, float, float]
    allowed: int
    status: str
    claim: str


@dataclass
class Tally:
    """What was tried, what was lost, and which numbers are wrong; seconds are those of the processor."""

    drives: int = 0
    scans: int = 0
    tried: int = 0
    seconds: float = 0.0
    statuses: Counter[str] = field(default_factory=Counter)
    losses: list[Loss] = field(default_factory=list)
    wrong: list[str] = field(default_factory=list)


def fuzz(mode: str, seed: int, tally: Tally, effort: int = 300) -> None:
    """Let a random drive be localized, and look for lost poses at each of its scans, among some times `effort` candidates."""
    begun = time.process_time()
    effort = effort // 8 if mode == "extreme" else effort  # there the oracle has to try ten thousand ends of a beam
    drive = random_drive("tracked" if mode == "contractor" else mode, seed)
    oracles = {place: Oracle(grid, drive) for place, grid in drive.grids.items()}
    try:
        if mode == "contractor":
            _contract(drive, oracles["map 0"], tally, effort)
        else:
            for number, (moment, parts) in enumerate(_answers(drive)):
                tally.scans += 1
                tally.statuses[next(iter(parts.values())).status] += 1
                for place, part in parts.items():
                    _judge(drive, moment, number, place, part, oracles[place], tally, effort)
        tally.drives += 1
    except (ConfigError, MapError):
        pass  # the robot fits nowhere in this map, or not where it is said to be
    tally.seconds += time.process_time() - begun


def _judge(drive: Drive, moment: Moment, number: int, place: str, part: Part, oracle: Oracle, tally: Tally, effort: int) -> None:
    if part.wrong:
        tally.wrong.append(part.wrong)
    hunt = Hunt(drive, moment, place, part, oracle, np.random.default_rng([drive.seed, number]))
    for poses, reason in hunt.wanted(effort):
        tally.tried += len(poses)
        for lost, where in hunt.missing(poses):
            for x, y, theta in lost.tolist():
                claim = f"{reason}, so it is {where}"
                tally.losses.append(Loss(drive.mode, drive.seed, number, place, (x, y, theta), part.allowed, part.status, claim))


def _answers(drive: Drive) -> Iterator[tuple[Moment, dict[str, Part]]]:
    """Yield each moment with what is said of each map."""
    if len(drive.grids) > 1:
        atlas = Atlas(drive.grids, drive.config)
        for moment in drive.moments:
            before = {name: BoxIndex(poses.boxes) for name, poses in atlas.poses.items()}
            said = atlas.update(moment.motion, moment.scan)
            after, printed = atlas.poses, (said.status, said.outliers_allowed)
            yield moment, {name: Part(before[name], after[name], said.hypotheses[name], *printed) for name in drive.grids}
        return
    ((place, grid),) = drive.grids.items()
    localizer = Localizer(grid, config=drive.config, initial=drive.initial)
    for moment in drive.moments:
        index = BoxIndex(localizer.poses.boxes)
        estimate = localizer.locate(moment.scan) if drive.mode == "static" else localizer.update(moment.motion, moment.scan)
        wrong = _wrong_numbers(drive, moment, estimate)
        circle = None if estimate.pose is None or estimate.radius_m is None else (estimate.pose, estimate.radius_m)
        yield moment, {place: Part(index, estimate.poses, estimate.hypotheses, estimate.status, estimate.outliers_allowed, circle, wrong)}


def _wrong_numbers(drive: Drive, moment: Moment, estimate: Estimate) -> str:
    """Say how the numbers of beams that are used and that may be bad differ from what docs/guarantee.md says of them, "" if they do not."""
    used, share = len(UsedBeams.of(moment.scan, drive.config)), drive.config.outliers
    allowed = estimate.outliers_allowed if share == "auto" else share if isinstance(share, int) else math.floor(Fraction(str(share)) * used)
    if (estimate.beams, estimate.outliers_allowed) == (used, allowed):
        return ""
    return f"{drive.mode} {drive.seed}: {estimate.outliers_allowed} of {estimate.beams} beams may be bad, not {allowed} of {used}"


def _contract(drive: Drive, oracle: Oracle, tally: Tally, effort: int) -> None:
    """Contract boxes around consistent poses: inside, on a face, in a corner; as small as a point or as large as the map."""
    random = np.random.default_rng(drive.seed)
    occupied = CellIndex(oracle.grid.mask(OCCUPIED), oracle.grid.resolution)
    for number, moment in enumerate(drive.moments):
        used = UsedBeams.of(moment.scan, drive.config)
        allowed = int(random.integers(0, len(used) + 2))
        contractor = ScanContractor(scan_beams(moment.scan, drive.config).allowing(allowed), occupied)
        poses = oracle.candidates(drive, moment, "map 0", effort, random)
        poses = poses[consistent(used, poses, oracle.obstacles, allowed)]
        widths = random.choice([0.0, 1e-9, 0.01, 0.3, 3.0], poses.shape)
        share = np.where(random.random(poses.shape) < 0.3, random.integers(0, 2, poses.shape), random.random(poses.shape))
        boxes = contractor.contract(Boxes(poses - share * widths, poses + (1.0 - share) * widths))
        inside = ((boxes.lower <= poses) & (poses <= boxes.upper)).all(axis=1)
        tally.scans += 1
        tally.tried += len(poses)
        for x, y, theta in poses[~inside].tolist():
            tally.losses.append(
                Loss("contractor", drive.seed, number, "map 0", (x, y, theta), allowed, "", "consistent, so it stays in its box")
            )
