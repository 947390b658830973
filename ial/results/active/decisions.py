"""`DecisionsFile`: what a planner has chosen, one line per decision."""

from ial.results.active.leg import Leg
from ial.results.lidar.json_lines import JsonLines


class DecisionsFile(JsonLines):
    """``decisions.jsonl``: each line holds the ``stamp`` and the ``index`` of the scan that followed a decision, and the decision.

    ``number`` counts decisions from 1; ``stage`` and ``reason`` say what chose and why; ``turn_rad`` and ``distance_m`` are the
    command, null where nothing is left to do; ``target`` is where it leads in the end, x and y in metres in the frame of the robot at
    its start, or null; ``goes_on`` tells whether it goes on with the decision before; ``since`` is the number of the decision that was
    the first to know the frontier that is the target, or null, and ``open`` holds those numbers of all other frontiers that are left;
    ``decided_s`` is how long the choice took; ``hypotheses_before`` and ``hypotheses`` are the numbers of connected parts of the set;
    ``status`` is the one after it, and ``collided`` whether the robot touched something.

    Parameters
    ----------
    path
        The file.
    """

    def add(self, leg: Leg) -> None:
        """Write the line of one decision; the first look is none."""
        decision = leg.taken.decision
        if decision is None:
            return
        drive = decision.drive
        self.write(
            leg.step,
            number=leg.number,
            stage=decision.stage,
            reason=decision.reason,
            turn_rad=None if drive is None else drive.turn_rad,
            distance_m=None if drive is None else drive.distance_m,
            target=None if decision.target is None else list(decision.target),
            goes_on=decision.goes_on,
            since=decision.since,
            open=list(decision.open),
            decided_s=leg.taken.decided_s,
            hypotheses_before=leg.before,
            hypotheses=leg.hypotheses,
            status=leg.estimate.status,
            collided=leg.taken.collided,
        )
