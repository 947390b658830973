"""How much of an answer is truly consistent: the share of its volume, from random poses that the slow twin judges one by one."""

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import Boxes
from ial.datasets.recording import Step
from ial.lidar.estimate import Estimate
from ial.lidar.localizer import Localizer
from ial.study.domain import Domain
from ial.study.good_beams import bad_beams
from ial.study.obstacles import Obstacles
from ial.study.used_beams import UsedBeams

ANSWERS = 60
"""So many answers of a recording are judged, chosen at random."""

POSES = 50
"""Random poses of each. Answers differ more from each other than so many poses leave uncertain."""

_RESAMPLES = 4000
_OUTSIDE = 2.5  # percent, on either side of an interval


class ConsistentShare:
    """The share of an answer's volume in which poses are consistent: in the domain, and at most q beams bad; q is the one that is printed.

    Answers that are localized and not limited are counted, each for the same, however large. The motion before a scan is not asked about
    again: with it the share could only be smaller. The twin may call a beam bad that is good by less than a tenth of a cell of the map, so
    the share may be a little larger than what is said here.

    Parameters
    ----------
    localizer
        What answers.
    """

    def __init__(self, localizer: Localizer) -> None:
        self._config = localizer.config
        self._obstacles = Obstacles(localizer.grid)
        self._domain = Domain(localizer.grid, localizer.config, self._obstacles)
        self._random = np.random.default_rng(0)
        self._seen = 0
        self._chosen: list[tuple[Step, Estimate]] = []

    def add(self, step: Step, estimate: Estimate) -> None:
        """Take an answer; each of those taken so far is as likely as every other to be among the chosen ones."""
        if estimate.status != "localized" or estimate.limited:
            return
        self._seen += 1
        if len(self._chosen) < ANSWERS:
            self._chosen.append((step, estimate))
            return
        place = int(self._random.integers(self._seen))
        if place < ANSWERS:
            self._chosen[place] = (step, estimate)

    def shares(self) -> npt.NDArray[np.float64]:
        """Return the share of each chosen answer, from some random poses."""
        return np.array([self._share(step, estimate) for step, estimate in self._chosen])

    def _share(self, step: Step, estimate: Estimate) -> float:
        poses = uniform(estimate.poses.boxes, POSES, np.random.default_rng(step.index))
        consistent = self._domain.holds(poses)
        bad = bad_beams(UsedBeams.of(step.scan, self._config), poses[consistent], self._obstacles)
        consistent[consistent] = bad <= estimate.outliers_allowed
        return float(consistent.mean())

    def __str__(self) -> str:
        """Return the mean and an interval that holds it with 95 % confidence, from resampled answers (percentile bootstrap)."""
        shares = self.shares()
        if not len(shares):
            return "–"
        means = self._random.choice(shares, (_RESAMPLES, len(shares))).mean(axis=1)
        low, high = np.percentile(means, [_OUTSIDE, 100.0 - _OUTSIDE])
        return f"{shares.mean():.3f} ({low:.3f} to {high:.3f})"


def uniform(boxes: Boxes, count: int, random: np.random.Generator) -> npt.NDArray[np.float64]:
    """Return random poses in boxes that do not overlap, every volume as likely as every other; float64 of shape (count, 3)."""
    volumes = boxes.width().prod(axis=1)
    rows = random.choice(len(boxes), count, p=volumes / volumes.sum())
    return random.uniform(boxes.lower[rows], boxes.upper[rows])
