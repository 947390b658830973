"""`Pilot`: what a robot with odometers does next in order to tell hypotheses apart."""

import math
from collections.abc import Sequence

import numpy as np

from ial.active.decision import Decision
from ial.odometer.belief import NARROW, OdometerBelief
from ial.odometer.command import Command
from ial.odometer.configurations import FloatArray
from ial.odometer.hypotheses import Hypothesis
from ial.odometer.opening_moves import OpeningMoves
from ial.odometer.overlay import way_apart
from ial.odometer.splitting import Rule, by_expectation, predicted, turns_deg

OPENING = "opening"
"""The stage of the commands that lead to hypotheses; that of all others is ``pilot``."""
_MOST_SAMPLES = 64
_GAP = 1e-7  # of the size: by how much readings differ that tell hypotheses apart
_TRIED = 12  # directions that are tried for how narrow they leave the set
_BELIEVED = 3  # plans that have left as many hypotheses, before directions are not believed any more

Planned = list[tuple[Command, str]]


class Pilot:
    """Chooses commands: opening moves, then the turn that tells hypotheses apart, and where none does a way to where only one can be.

    It is a planner as those of `ial.active` are, and belongs to one run.

    Parameters
    ----------
    belief
        What is known, and will be.
    rule
        Which turn is the best. That after which the fewest hypotheses are expected to be left, by default.
    """

    def __init__(self, belief: OdometerBelief, rule: Rule = by_expectation) -> None:
        self._rule = rule
        self._opening = OpeningMoves([model.walls for model in belief.models.values()])
        self._turns = turns_deg()
        self._radians = np.array([math.radians(each) for each in self._turns])
        errors = [model.bounds for model in belief.models.values()]
        part, turn = max(each.distance_part for each in errors), max(each.turn_deg for each in errors)
        self._part = 2.0 * (part + math.radians(turn))  # of a distance: by how much readings differ for certain
        self._count, self._unsplit = len(self._turns) ** 2, 0
        self._plan: Planned = []
        self._planned_for = 0  # hypotheses

    def __repr__(self) -> str:
        return f"<Pilot, {len(self._plan)} commands planned>"

    def choose(self, belief: OdometerBelief) -> Decision:
        """Return the next decision."""
        if belief.status == "rejected":
            return Decision(None, "exhausted", "no place explains the readings")
        command = self._opening.next(belief.measured)
        if command is not None:
            return Decision(command.drive, OPENING, "for candidates")
        last = belief.estimate
        found = belief.found(belief.states) if last is None or last.hypotheses is None else last.hypotheses
        if last is None or not last.moved or len(found) < self._planned_for:
            self._plan = []  # what was planned on is no longer so
        self._plan = self._plan or self._commands(belief, found)
        self._planned_for = len(found)
        if not self._plan:
            return Decision(None, "exhausted", "no command tells the places apart in which it may be")
        command, reason = self._plan.pop(0)
        return Decision(command.drive, "pilot", reason)

    def _commands(self, belief: OdometerBelief, found: Sequence[Hypothesis]) -> Planned:
        """Return what to do next; nothing if no command helps."""
        distances = self._predictions(belief, found)
        best = self._rule(distances, _GAP * belief.size, self._part)
        if self._trusts(belief, len(found)) and best is not None:
            return [(Command(self._turns[best]), "by a direction")]
        if len(found) == 1 or not belief.exact:
            return self._narrowing(belief, distances)
        if belief.width(found) > NARROW:
            return [(Command(self._turns[int(np.argmax(distances.min(axis=0)))]), "to make it smaller")]
        first = found[0]
        for other in found[1:]:
            if not belief.same([first, other]):
                here, there = (belief.models[each.world].walls.polygon for each in (first, other))
                way = way_apart(here, first, there, other)
                if way:
                    return [(each, "by a place that only one has") for each in way]
        return []

    def _trusts(self, belief: OdometerBelief, count: int) -> bool:
        """Return whether predictions are to be believed: in doubles, a robot in a corner may see a way along a wall that is none.

        Directions that have left as many hypotheses as there were, a few times in a row, are not asked for again until there are fewer.
        """
        self._unsplit = self._unsplit + 1 if count >= self._count else 0
        self._count = count
        return self._unsplit <= _BELIEVED or not belief.exact

    def _predictions(self, belief: OdometerBelief, found: Sequence[Hypothesis]) -> FloatArray:
        """Return for samples of the hypotheses how far they would drive."""
        most = max(1, _MOST_SAMPLES // len(found))
        rows = []
        for name, model in belief.models.items():
            places = [one.samples[:: -(-len(one.samples) // most)] for one in found if one.world == name]
            if places:
                rows.append(predicted(model.walls, np.concatenate(places), self._radians))
        return np.concatenate(rows)

    def _narrowing(self, belief: OdometerBelief, distances: FloatArray) -> Planned:
        """Return the command that leaves the narrowest set if the first hypothesis is right, of some that are tried."""
        best, chosen = math.inf, None
        for number in range(0, len(self._turns), max(1, len(self._turns) // _TRIED)):
            way = float(distances[0, number])
            if not 0.0 < way < math.inf:
                continue
            command = Command(self._turns[number])
            left = belief.found({name: model.step(belief.states[name], command, way) for name, model in belief.models.items()})
            if left:
                wide = belief.width(left) * len(left)
                if wide < best:
                    best, chosen = wide, command
        return [] if chosen is None else [(chosen, "to make it smaller")]
