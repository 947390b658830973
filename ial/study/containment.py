"""`Containment`: the guarantee measured against a reference trajectory."""

from collections import Counter
from typing import Any

import numpy as np

from ial.contractors.intervals.angle import contains_angle
from ial.datasets.recording import Step
from ial.lidar.estimate import Estimate
from ial.lidar.localizer import Localizer
from ial.pose import Pose
from ial.study.domain import Domain
from ial.study.good_beams import bad_beams
from ial.study.obstacles import Obstacles
from ial.study.reference import Truth, TruthFrame, base_pose
from ial.study.used_beams import UsedBeams


class Containment:
    """Counts how often the reference pose lies in the answer, and whether the assumptions held when it did not.

    The assumptions hold at a scan if the reference pose is consistent with it (at most q bad beams, inside the domain), and either
    the scan is localized from the start and the start holds the reference, or the motion between the two reference poses lies in its
    interval and the reference was contained at the scan before.

    Parameters
    ----------
    localizer
        The localizer that is measured.
    truth
        The reference trajectory, in the map frame.
    frame
        Whose poses the reference holds: those of the base or of the laser.
    static
        Whether each scan was localized by itself.
    """

    def __init__(self, localizer: Localizer, truth: Truth, frame: TruthFrame = "base", *, static: bool = False) -> None:
        self._localizer = localizer
        self._truth = truth
        self._frame = frame
        self._static = static
        self._obstacles = Obstacles(localizer.grid)
        self._domain = Domain(localizer.grid, localizer.config, self._obstacles)
        self._previous: Pose | None = None
        self._was_contained = True
        self._started = False
        self._counts: Counter[str] = Counter()
        self._errors: list[float] = []
        self.misses: list[dict[str, Any]] = []

    def __repr__(self) -> str:
        return f"<Containment of {self._counts['scans']} scans: the reference is missed in {len(self.misses)}>"

    def reference(self, step: Step) -> Pose | None:
        """Return ``T_map_base`` of the reference at a scan, None where it has none."""
        return base_pose(self._truth, self._frame, step)

    def add(self, step: Step, estimate: Estimate) -> None:
        """Take the estimate of one scan."""
        self._counts["scans"] += 1
        pose = self.reference(step)
        if pose is None:
            # The chain of assumptions is broken: what held before this scan is unknown at the next.
            self._previous, self._was_contained, self._started = None, False, True
            return
        in_grid = self._localizer.grid.pose_to_grid(pose)
        contained = estimate.poses.contains(in_grid)
        broken = self._broken(step, pose, in_grid, estimate.outliers_allowed)
        before = self._starts(pose) if self._fresh else self._previous is not None and self._was_contained
        holds = not broken and before
        self._counts["reference"] += 1
        self._counts["contained"] += contained
        self._counts["contained_hull"] += self._in_hull(estimate, pose)
        self._counts["holds"] += holds
        self._counts["contained_and_holds"] += contained and holds
        blamed = broken or ([] if holds else ["lost_before"])
        for each in blamed:
            self._counts[f"broken_{each}"] += 1
        if estimate.pose is not None:
            self._errors.append(float(np.hypot(estimate.pose.x - pose.x, estimate.pose.y - pose.y)))
        if not contained:
            self.misses.append({"index": step.index, "status": estimate.status, "broken": blamed})
        self._previous, self._was_contained, self._started = pose, contained, True

    @property
    def _fresh(self) -> bool:
        return self._static or not self._started

    def _starts(self, pose: Pose) -> bool:
        """Return whether a pose of the map frame lies in the boxes that the localizer was given; the domain is asked for by itself."""
        start, at = self._localizer.initial, np.array([pose.x, pose.y])
        if start is None:
            return True
        rows = np.flatnonzero(((start.lower[:, :2] <= at) & (at <= start.upper[:, :2])).all(axis=1))
        return any(contains_angle(start.lower[row, 2], start.upper[row, 2], pose.theta) for row in rows)

    def _broken(self, step: Step, pose: Pose, in_grid: Pose, allowed: int) -> list[str]:
        """Return which assumptions the reference pose breaks at a scan, among beams, motion and domain."""
        at = np.array([[in_grid.x, in_grid.y, in_grid.theta]])
        beams = UsedBeams.of(step.scan, self._localizer.config)
        broken = ["beams"] if bad_beams(beams, at, self._obstacles)[0] > allowed else []
        previous = None if self._fresh else self._previous
        if previous is not None and step.motion is not None and not step.motion.contains(previous.inverse() @ pose):
            broken.append("motion")
        if not self._domain.holds(at)[0]:
            broken.append("domain")
        return broken

    def _in_hull(self, estimate: Estimate, pose: Pose) -> bool:
        return any(
            each.x[0] <= pose.x <= each.x[1] and each.y[0] <= pose.y <= each.y[1] and contains_angle(*each.theta, pose.theta)
            for each in estimate.hypotheses
        )

    def summary(self) -> dict[str, Any]:
        """Return the measures as plain values; a share with an empty denominator is None, and does not pass.

        `broken` counts, over the scans at which the assumptions do not hold, which of them the reference breaks; `lost_before` means that
        the scan itself breaks none, but the reference was not contained (or not known) at the scan before, or not in the initial region.
        """
        counts = self._counts
        reference, holds = counts["reference"], counts["holds"]
        return {
            "scans_with_reference": reference,
            "contained": _share(counts["contained"], reference),
            "contained_hull": _share(counts["contained_hull"], reference),
            "assumptions_hold": _share(holds, reference),
            "scans_where_assumptions_hold": holds,
            "contained_when_assumptions_hold": _share(counts["contained_and_holds"], holds),
            "broken": {each: counts[f"broken_{each}"] for each in ("beams", "motion", "domain", "lost_before")},
            "median_position_error_m": float(np.median(self._errors)) if self._errors else None,
            "truth_frame": self._frame,
        }


def _share(part: int, whole: int) -> float | None:
    return part / whole if whole else None
