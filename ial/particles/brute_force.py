"""`BruteForce`: global localization by trying a lattice of poses and refining the best. It returns one answer, and no guarantee."""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import FloatArray
from ial.contractors.kernels import kernel
from ial.contractors.threads import run
from ial.datasets.scan import LaserScan
from ial.errors import ConfigError, RecordingError
from ial.maps.grids.occupancy_grid import FREE, OccupancyGrid, check_usable
from ial.particles.likelihood_field import BeamModel, LikelihoodField, score, score_turned
from ial.pose import Pose, wrap

_ROUNDS = 5  # of refinement; each halves the step
_SHORTLIST = 1000  # lattice poses among which candidates are chosen


@dataclass(frozen=True)
class ScoredPose:
    """A pose and how well a scan fits there.

    Parameters
    ----------
    pose
        ``T_map_base``.
    score
        Mean log-likelihood of the beams; 0 or less for weights that sum to at most 1.
    """

    pose: Pose
    score: float


@dataclass(frozen=True)
class Match:
    """The answer of a search.

    Parameters
    ----------
    best
        The pose with the highest score.
    runner_up
        The best pose that is a place or a heading of its own, at least two steps of the lattice from `best`; None if there is none.
    poses
        How many poses of the lattice were tried.
    """

    best: ScoredPose
    runner_up: ScoredPose | None
    poses: int


@kernel
def _score_lattice(start, stop, table, positions, turned, scores):  # type: ignore[no-untyped-def]
    """Score the positions start … stop with every heading.

    `turned` holds the end points for each heading, float32 of shape (headings, 2, beams); `scores` is of shape (positions, headings).
    """
    cells = np.empty(turned.shape[2], dtype=np.int32)
    for row in range(start, stop):
        x, y = np.float32(positions[row, 0]), np.float32(positions[row, 1])
        for heading in range(len(turned)):
            scores[row, heading] = score(table, x, y, turned[heading], cells)


@kernel
def _refine(start, stop, table, poses, ends, steps, scores):  # type: ignore[no-untyped-def]
    """Move each pose (x, y, θ) to the best of its 26 neighbours until none is better; then halve the steps, and again."""
    cells = np.empty(ends.shape[1], dtype=np.int32)
    for row in range(start, stop):
        scores[row] = -np.inf
        step, turn = steps
        for _ in range(_ROUNDS):
            step *= 0.5
            turn *= 0.5
            better = True
            while better:
                better = False
                x, y, theta = poses[row]
                for k in range(27):
                    at_x, at_y, heading = x + (k % 3 - 1) * step, y + (k // 3 % 3 - 1) * step, theta + (k // 9 - 1) * turn
                    score = score_turned(table, np.float32(at_x), np.float32(at_y), heading, ends, cells)
                    if score > scores[row]:
                        scores[row] = score
                        poses[row, 0], poses[row, 1], poses[row, 2] = at_x, at_y, heading
                        better = True


class BruteForce:
    """Scores every pose of a regular lattice over the free space, and refines the best of them.

    A plain and strong baseline: no prior, no randomness, and the same answer on any number of threads.

    Parameters
    ----------
    grid
        The map.
    model
        The likelihood of a beam.
    position_m
        Distance of the positions tried, along x and y.
    heading_rad
        The circle is divided into equal parts of at most this width.
    candidates
        How many poses of the lattice are refined, at least two steps apart from each other.

    Raises
    ------
    MapError
        If the map has no occupied or no free cell.
    ConfigError
        If a step is not positive, or there is no candidate, or the lattice is so wide that it misses the free space.
    """

    def __init__(
        self,
        grid: OccupancyGrid,
        model: BeamModel | None = None,
        position_m: float = 0.2,
        heading_rad: float = math.radians(10.0),
        candidates: int = 30,
    ) -> None:
        check_usable(grid)
        for name, value in (("position_m", position_m), ("heading_rad", heading_rad)):
            if not (math.isfinite(value) and value > 0.0):
                raise ConfigError(f"{name} of the lattice is {value!r}; give a finite number above 0")
        if candidates < 1:
            raise ConfigError(f"the number of candidates is {candidates}; give at least 1")
        self.grid = grid
        self.field = LikelihoodField(grid, model or BeamModel())
        self.candidates = candidates
        self.headings = max(1, math.ceil(2.0 * math.pi / heading_rad - 1e-9))
        self._step = position_m / grid.resolution
        self._turn = 2.0 * math.pi / self.headings
        self._positions = _free_positions(grid, self._step)
        if not len(self._positions):
            raise ConfigError(f"no position of a lattice of {position_m:g} m lies in a free cell; give a smaller position_m")

    def __repr__(self) -> str:
        return f"<BruteForce in {self.grid!r}: {self.headings} headings, {self.candidates} candidates>"

    def locate(self, scan: LaserScan) -> Match:
        """Return where a scan fits best.

        Parameters
        ----------
        scan
            Its hits are used, at most `max_beams` of them, spread evenly.

        Raises
        ------
        RecordingError
            If the scan has no usable beam.
        """
        ends = self.field.ends(scan)
        if not ends.size:
            raise RecordingError("the scan has no usable beam: all are NaN, too near, or without a return; choose another scan")
        poses = self._candidates(self._scores(ends))
        scores = np.empty(len(poses))
        run(_refine, len(poses), self.field.table, poses, ends, (self._step, self._turn), scores, minimum=1)
        order = np.argsort(-scores, kind="stable")
        best = order[0]
        others = [row for row in order if not self._near(poses[row], poses[best])]
        runner_up = self._scored(poses[others[0]], scores[others[0]]) if others else None
        return Match(self._scored(poses[best], scores[best]), runner_up, len(self._positions) * self.headings)

    def _scores(self, ends: npt.NDArray[np.float32]) -> npt.NDArray[np.float32]:
        """Return the score of every pose of the lattice, shape (positions, headings)."""
        angles = self._turn * np.arange(self.headings)
        c, s = np.cos(angles)[:, None], np.sin(angles)[:, None]
        turned = np.stack([c * ends[0] - s * ends[1], s * ends[0] + c * ends[1]], axis=1).astype(np.float32)
        scores = np.empty((len(self._positions), self.headings), dtype=np.float32)
        run(_score_lattice, len(scores), self.field.table, self._positions, turned, scores, minimum=16)
        return scores

    def _candidates(self, scores: npt.NDArray[np.float32]) -> FloatArray:
        """Return the best poses of the lattice, each at least two steps from all better ones; ties go to the first on the lattice."""
        flat = scores.reshape(-1)
        least = np.partition(flat, -min(_SHORTLIST, len(flat)))[-min(_SHORTLIST, len(flat))]
        shortlist = np.flatnonzero(flat >= least)
        shortlist = shortlist[np.argsort(-flat[shortlist], kind="stable")][:_SHORTLIST]
        rows, headings = np.divmod(shortlist, self.headings)
        poses = np.column_stack([self._positions[rows], self._turn * headings])
        chosen: list[FloatArray] = []
        while len(poses) and len(chosen) < self.candidates:
            chosen.append(poses[0])
            poses = poses[~self._near(poses, poses[0])]
        return np.array(chosen)

    def _near(self, poses: FloatArray, at: FloatArray) -> npt.NDArray[np.bool_]:
        """Return which poses are less than two steps of the lattice from another, in position and in heading."""
        turn = np.abs(np.remainder(poses[..., 2] - at[2] + math.pi, 2.0 * math.pi) - math.pi)
        near = np.hypot(poses[..., 0] - at[0], poses[..., 1] - at[1]) < 1.999 * self._step
        return np.asarray(near & (turn < 1.999 * self._turn))

    def _scored(self, pose: FloatArray, value: float) -> ScoredPose:
        x, y = (pose[:2] * self.grid.resolution).tolist()
        return ScoredPose(self.grid.pose_to_map(Pose(x, y, wrap(float(pose[2])))), float(value))


def _free_positions(grid: OccupancyGrid, step: float) -> FloatArray:
    """Return the positions of a square lattice that lie in free cells, in cells, row by row."""
    y, x = (np.arange(0.5 * step, side, step) for side in (grid.rows, grid.columns))
    rows, columns = np.nonzero(grid.mask(FREE)[np.ix_(y.astype(np.int64), x.astype(np.int64))])
    return np.column_stack([x[columns], y[rows]])
