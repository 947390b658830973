"""`Hypothesis`: one connected set of possible poses, and how a set of poses falls into such."""

import itertools
from dataclasses import dataclass

import numpy as np

from ial.contractors.boxes import Boxes
from ial.lidar.pose_set import PoseSet
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose, wrap


@dataclass(frozen=True)
class Hypothesis:
    """One connected set of possible poses, by its hull in the map frame.

    Parameters
    ----------
    x, y
        Bounds of the position (m), rounded outward.
    theta
        Bounds of the heading (rad); the upper one exceeds π where the arc crosses the cut. The full circle is [-π, π], rounded outward.
    boxes
        Of how many boxes the set consists.
    volume
        Sum of the volumes of the boxes (m² rad); a measure, not a bound.
    prediction
        Whether it comes only from a prediction that a scan has rejected. Of a `lost` or `blind` scan: whether it holds a part of that
        prediction, which is as it was.
    spare_beams
        How many more beams might have been bad: at most so many fewer than allowed are bad anywhere in it. None where it is not known.
    """

    x: tuple[float, float]
    y: tuple[float, float]
    theta: tuple[float, float]
    boxes: int
    volume: float
    prediction: bool = False
    spare_beams: int | None = None

    @property
    def half_widths(self) -> tuple[float, float]:
        """Half the larger width of the position (m), and half the width of the heading (rad)."""
        return 0.5 * max(self.x[1] - self.x[0], self.y[1] - self.y[0]), 0.5 * (self.theta[1] - self.theta[0])

    @property
    def centre(self) -> Pose:
        """The middle of the hull."""
        return Pose(0.5 * (self.x[0] + self.x[1]), 0.5 * (self.y[0] + self.y[1]), wrap(0.5 * (self.theta[0] + self.theta[1])))


def find_hypotheses(poses: PoseSet, grid: OccupancyGrid, *, counted: bool = True, rejected: bool = False) -> tuple[Hypothesis, ...]:
    """Return the connected components of a set of poses, the largest volume first, in the map frame.

    Parameters
    ----------
    poses
        The set.
    grid
        The map.
    counted
        Whether the last scan has told how many of its beams are bad; one that excludes nothing has not.
    rejected
        Whether the last scan has rejected the prediction, which is then carried on as it was.
    """
    counted = counted and not poses.limited
    clusters = poses.clusters
    in_map = grid.boxes_to_map(poses.boxes)
    volumes = np.maximum(poses.boxes.width(), 0.0).prod(axis=1)
    order = np.argsort(clusters.labels, kind="stable")
    edges = np.searchsorted(clusters.labels[order], np.arange(len(clusters) + 1))
    theta = grid.boxes_to_map(clusters.hulls)
    hypotheses = []
    for label, (start, stop) in enumerate(itertools.pairwise(edges)):
        rows = order[start:stop]
        sure = rows[~poses.unconfirmed[rows]]
        hull = Boxes(in_map.lower[rows], in_map.upper[rows]).hull()
        hypotheses.append(
            Hypothesis(
                x=(float(hull.lower[0, 0]), float(hull.upper[0, 0])),
                y=(float(hull.lower[0, 1]), float(hull.upper[0, 1])),
                theta=(float(theta.lower[label, 2]), float(theta.upper[label, 2])),
                boxes=len(rows),
                volume=float(volumes[rows].sum()),
                prediction=len(sure) < len(rows) if rejected else not len(sure),
                spare_beams=poses.outliers - int(poses.bad[sure].min()) if counted and len(sure) else None,
            )
        )
    return tuple(sorted(hypotheses, key=lambda each: -each.volume))
