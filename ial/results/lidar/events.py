"""`EventsFile`: what happened in a run besides localizing, one line per event."""

from pathlib import Path

from ial.datasets.recording import Step
from ial.lidar.estimate import Estimate
from ial.results.lidar.json_lines import JsonLines


class EventsFile(JsonLines):
    """``events.jsonl``: each line holds the scan's ``stamp`` and ``index``, and an ``event``.

    ==============  ========================================================================================================
    event           meaning
    ==============  ========================================================================================================
    localized       the first scan at which the robot is localized
    rejection       a scan fitted nowhere in the prediction, which proves that some assumption is false: the robot was moved by
                    hand, or a bound was violated; ``found`` tells whether it fitted anywhere on the map (status `lost`) or
                    nowhere (`blind`)
    recovered       the first localized scan after a rejection; ``rejected_at`` is the index of the earliest one since the last
                    recovery
    uninformative   a scan could exclude nothing: it has no usable beams, or as many outliers are allowed
    vanishing       hardly anything is left: less than the errors of the beams alone leave open, so often a bound has been broken
    better_place    the scan fits better somewhere else than where the robot is tracked (`check_every`): ``inside`` and
                    ``elsewhere`` are the numbers of bad beams, ``x``, ``y`` and ``theta`` the bounds of that place
    limit           a limit stopped the search early, ``by`` "boxes" or "time": the answer is coarser, and holds all the same
    collision       `ial explore` alone: the robot touched something on its way to the scan, ``decision`` says with which number
    ended           `ial explore` alone, at the last scan: ``by`` "localized", "symmetric", "exhausted" (the planner has nothing left)
                    or "drives" (there were as many as allowed), after so many ``drives``
    ==============  ========================================================================================================

    Parameters
    ----------
    path
        The file.
    """

    def __init__(self, path: Path) -> None:
        super().__init__(path)
        self._localized = False
        self._rejected_at: int | None = None

    def add(self, step: Step, estimate: Estimate) -> None:
        """Write the events of one scan, most often none."""
        if estimate.uninformative:
            self.write(step, event="uninformative", beams=estimate.beams, outliers_allowed=estimate.outliers_allowed)
        if estimate.vanishing:
            self.write(step, event="vanishing", volume=sum(each.volume for each in estimate.hypotheses))
        check = estimate.check
        if check is not None and check.better and check.best is not None:
            at = check.best
            self.write(step, event="better_place", inside=check.inside, elsewhere=check.elsewhere, x=at.x, y=at.y, theta=at.theta)
        if estimate.limited:
            self.write(step, event="limit", by=estimate.limited)
        if estimate.status in ("lost", "blind"):
            self.write(step, event="rejection", found=estimate.status == "lost")
            self._rejected_at = step.index if self._rejected_at is None else self._rejected_at
        elif estimate.status == "localized":
            if self._rejected_at is not None:
                self.write(step, event="recovered", rejected_at=self._rejected_at)
            if not self._localized:
                self.write(step, event="localized")
            self._localized, self._rejected_at = True, None
