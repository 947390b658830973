"""`AnswerHash`: a few digits that change if a bit of any answer does."""

import hashlib

from ial.lidar.estimate import Estimate


class AnswerHash:
    """The hash of answers in their order: what two commits that answer alike have in common. A time has no part in it."""

    def __init__(self) -> None:
        self._hash = hashlib.sha256()

    def add(self, estimate: Estimate) -> None:
        """Take an answer in: its words, its numbers and all its boxes."""
        pose = None if estimate.pose is None else (estimate.pose.x, estimate.pose.y, estimate.pose.theta)
        words = estimate.status, len(estimate.hypotheses), estimate.outliers_allowed, estimate.limited, estimate.vanishing
        self._hash.update(repr((*words, pose, estimate.radius_m)).encode())
        for bounds in (estimate.poses.boxes.lower, estimate.poses.boxes.upper, estimate.poses.unconfirmed):
            self._hash.update(bounds.tobytes())

    def __str__(self) -> str:
        return self._hash.hexdigest()[:12]
