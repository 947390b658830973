"""`PoseSet`: what the localizer knows, as boxes of poses in the grid's frame."""

import functools
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import numpy.typing as npt

from ial.contractors.angles import wrapped
from ial.contractors.boxes import Boxes
from ial.contractors.intervals.angle import contains_angle
from ial.contractors.paving.clusters import Clusters, cluster
from ial.contractors.paving.limits import Limit
from ial.pose import Pose


@dataclass(frozen=True, eq=False)
class PoseSet:
    """A set of poses (x, y, θ) of the robot's base, and with how many bad beams the last scan was taken to leave it.

    These numbers stay with the set, since what is done with it next depends on them, in another process, too. Where q is chosen at the
    scan, a search leaves the sets of many q at once, box by box, and `within` takes one of them; its border is cut back with the same q;
    the rest of the map is searched for places where fewer beams are bad than here; and the next scan compares its q with this one.

    Parameters
    ----------
    boxes
        The set, in the grid's frame; n rows of 3.
    unconfirmed
        Which boxes are a prediction that was carried on although a scan rejected it, bool of shape (n,).
    limited
        Which limit stopped the last search early, "" if none.
    bad
        How many beams of the last scan are bad at least, wherever in a box the robot is; int16 of shape (n,), 0 where it is not known.
    outliers
        How many beams of the last scan may be bad. All boxes but the unconfirmed ones were cut at this number, and where none are left, so
        was the search that has found nothing.
    accepted
        The same of the last scan that has left a pose, with which that of the next scan is compared; None before there was one.
    """

    boxes: Boxes
    unconfirmed: npt.NDArray[np.bool_] = field(default_factory=lambda: np.empty(0, dtype=np.bool_))
    limited: Limit = ""
    bad: npt.NDArray[np.int16] = field(default_factory=lambda: np.empty(0, dtype=np.int16))
    outliers: int = 0
    accepted: int | None = None

    def __post_init__(self) -> None:
        if len(self.unconfirmed) != len(self.boxes):
            object.__setattr__(self, "unconfirmed", np.zeros(len(self.boxes), dtype=np.bool_))
        if len(self.bad) != len(self.boxes):
            object.__setattr__(self, "bad", np.zeros(len(self.boxes), dtype=np.int16))

    def __len__(self) -> int:
        return len(self.boxes)

    def __repr__(self) -> str:
        hull = f", hull {' × '.join(map(str, next(iter(self.boxes.hull()))))}" if len(self) else ""
        return f"<PoseSet of {len(self)} box{'es' * (len(self) != 1)} in the grid's frame{hull}>"

    @functools.cached_property
    def clusters(self) -> Clusters:
        """The connected components of the boxes."""
        return cluster(self.boxes, circular=(2,))

    def __getitem__(self, rows: npt.NDArray[np.bool_]) -> "PoseSet":
        """Return the set of the boxes that a mask chooses."""
        return replace(self, boxes=self.boxes[rows], unconfirmed=self.unconfirmed[rows], bad=self.bad[rows])

    def checked(self) -> "PoseSet":
        """Return the set with its headings in the form of `ial.contractors.intervals.angle`.

        Raises
        ------
        ValueError
            If a box is empty, or a bound is NaN or infinite.
        """
        boxes = wrapped(self.boxes, 2)
        fine = np.isfinite(boxes.lower).all(axis=1) & np.isfinite(boxes.upper).all(axis=1)
        if not fine.all():
            raise ValueError(
                f"box {fine.argmin()} of {len(boxes)} is empty or has a bound that is infinite; leave it out, or cut it to the map"
            )
        return replace(self, boxes=boxes)

    def without(self, boxes: Boxes) -> "PoseSet":
        """Return the set without those of its boxes that are among others, bit for bit."""
        rows = ~np.isin(_names(self.boxes), _names(boxes))
        return self[rows]

    @property
    def fewest_bad(self) -> int:
        """How many beams of the last scan are bad at least, wherever in the set the robot is."""
        return int(self.bad.min())

    def within(self, outliers: int) -> "PoseSet":
        """Return the boxes that may hold a pose from which at most so many beams are bad: what a scan that may have so many leaves."""
        return replace(self[self.bad <= outliers], outliers=outliers, accepted=outliers)

    def contains(self, pose: Pose) -> bool:
        """Return whether a pose, in the grid's frame, lies in one of the boxes; headings are taken modulo 2π."""
        lower, upper = self.boxes.lower, self.boxes.upper
        at = np.array([pose.x, pose.y])
        rows = np.flatnonzero(((lower[:, :2] <= at) & (at <= upper[:, :2])).all(axis=1))
        return any(contains_angle(lower[row, 2], upper[row, 2], pose.theta) for row in rows)


def _names(boxes: Boxes) -> npt.NDArray[np.void]:
    """Return the bits of each box as one value, shape (n,)."""
    bounds = np.hstack([boxes.lower, boxes.upper]) + 0.0  # -0.0 is 0.0
    return np.ascontiguousarray(bounds).view(f"V{bounds.itemsize * bounds.shape[1]}").reshape(-1)


def unite(allowed: PoseSet, predicted: PoseSet) -> PoseSet:
    """Return the union of poses that a scan allows, as its search has left them, and poses that are only predicted: unconfirmed ones."""
    return PoseSet(
        Boxes.concatenate([allowed.boxes, predicted.boxes]),
        np.concatenate([allowed.unconfirmed, np.ones(len(predicted), dtype=np.bool_)]),
        allowed.limited or predicted.limited,
        np.concatenate([allowed.bad, predicted.bad]),
        allowed.outliers,
        allowed.accepted if len(allowed) else predicted.accepted,
    )


def join(parts: Sequence[PoseSet], outliers: int) -> PoseSet:
    """Return the union of what one search has left in several places, of confirmed poses only."""
    return PoseSet(
        Boxes.concatenate([Boxes.none(3), *(each.boxes for each in parts)]),
        limited=next((each.limited for each in parts if each.limited), ""),
        bad=np.concatenate([np.empty(0, dtype=np.int16), *(each.bad for each in parts)]),
        outliers=outliers,
    )
