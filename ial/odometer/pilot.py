"""`Pilot`: what to do next in order to tell hypotheses apart, and whether that is done."""

import math
from collections.abc import Mapping, Sequence
from functools import cache

import numpy as np

from ial.maps.polygons.exact.congruence import Congruence, near_congruences
from ial.odometer.command import Command
from ial.odometer.configurations import FloatArray
from ial.odometer.hypotheses import Hypothesis, hypotheses, one_orbit
from ial.odometer.model import SAME, Chord, OdometerModel, States
from ial.odometer.overlay import way_apart
from ial.odometer.splitting import predicted, scores, turns_deg

_MOST_SAMPLES = 64
_GAP = 1e-7  # of the size: by how much readings differ that tell hypotheses apart
_NARROW = 1e-4  # of the size, and radians: a hypothesis so narrow is a point to a robot with exact odometers
_TRIED = 12  # directions that are tried for how narrow they leave the set
_PAYS = 0.95
_PATIENCE = 6  # commands that make nothing narrower, before it is called as narrow as it gets

_BELIEVED = 3  # plans that have left as many hypotheses, before directions are not believed any more

Planned = list[tuple[Command, str]]


class Pilot:
    """Chooses commands for a robot.

    Parameters
    ----------
    models
        The robot in each environment.
    """

    def __init__(self, models: Mapping[str, OdometerModel]) -> None:
        self._models = models
        self.size = max(model.walls.size for model in models.values())
        self.exact = all(model.bounds.exact for model in models.values())
        self._turns = turns_deg()
        self._radians = np.array([math.radians(each) for each in self._turns])
        part, turn = (max(getattr(each.bounds, name) for each in models.values()) for name in ("distance_part", "turn_deg"))
        self._part = 2.0 * (part + math.radians(turn))  # of a distance: by how much readings differ for certain
        self._best = math.inf
        self._vain = 0
        self._count, self._unsplit = len(self._turns) ** 2, 0
        self._motions = cache(self._found_motions)

    def __repr__(self) -> str:
        return f"<Pilot in {len(self._models)} environments>"

    def found(self, states: Mapping[str, States]) -> list[Hypothesis]:
        """Return the hypotheses in all environments."""
        boxes = {name: each.configurations if isinstance(each, Chord) else each for name, each in states.items()}
        return [each for name, sets in boxes.items() for each in hypotheses(name, sets)]

    def finished(self, found: Sequence[Hypothesis], states: Mapping[str, States]) -> bool:
        """Return whether all hypotheses are one up to symmetry, and as narrow as they get."""
        widest = max(each.width_m / self.size + each.width_rad for each in found)
        if len(found) > sum(len(self._motions(found[0].world, name)) for name in self._models) or not one_orbit(
            found, self._motions, self.size
        ):
            return False
        if self.exact:
            return widest <= _NARROW
        self._vain = 0 if widest < _PAYS * self._best else self._vain + 1
        self._best = min(self._best, widest)
        return self._vain >= _PATIENCE

    def commands(self, found: Sequence[Hypothesis], states: Mapping[str, States]) -> Planned:
        """Return what to do next; nothing if no command helps."""
        distances = self._predictions(found)
        expected = scores(distances, _GAP * self.size, self._part)
        best = int(np.argmin(expected))
        if self._trusts(len(found)) and expected[best] < len(distances) - 0.5:
            return [(Command(self._turns[best]), "by a direction")]
        if len(found) == 1 or not self.exact:
            return self._narrowing(found, states, distances)
        wide = max(each.width_m / self.size + each.width_rad for each in found)
        if wide > _NARROW:
            return [(Command(self._turns[int(np.argmax(distances.min(axis=0)))]), "to make it smaller")]
        first = found[0]
        for other in found[1:]:
            if not one_orbit([first, other], self._motions, self.size):
                way = way_apart(self._polygon(first), first, self._polygon(other), other)
                if way:
                    return [(each, "by a place that only one has") for each in way]
        return []

    def _trusts(self, count: int) -> bool:
        """Return whether predictions are to be believed: in doubles, a robot in a corner may see a way along a wall that is none.

        Directions that have left as many hypotheses as there were, a few times in a row, are not asked for again until there are fewer.
        """
        self._unsplit = self._unsplit + 1 if count >= self._count else 0
        self._count = count
        return self._unsplit <= _BELIEVED or not self.exact

    def _polygon(self, hypothesis: Hypothesis):  # type: ignore[no-untyped-def]
        return self._models[hypothesis.world].walls.polygon

    def _predictions(self, found: Sequence[Hypothesis]) -> FloatArray:
        """Return for samples of the hypotheses how far they would drive."""
        most = max(1, _MOST_SAMPLES // len(found))
        rows = []
        for name, model in self._models.items():
            places = [one.samples[:: -(-len(one.samples) // most)] for one in found if one.world == name]
            if places:
                rows.append(predicted(model.walls, np.concatenate(places), self._radians))
        return np.concatenate(rows)

    def _narrowing(self, found: Sequence[Hypothesis], states: Mapping[str, States], distances: FloatArray) -> Planned:
        """Return the command that leaves the narrowest set if the first hypothesis is right, of some that are tried."""
        best, chosen = math.inf, None
        for number in range(0, len(self._turns), max(1, len(self._turns) // _TRIED)):
            way = float(distances[0, number])
            if not 0.0 < way < math.inf:
                continue
            command = Command(self._turns[number])
            after = {name: model.step(states[name], command, way) for name, model in self._models.items()}
            left = self.found(after)
            if left:
                wide = max(each.width_m / self.size + each.width_rad for each in left) * len(left)
                if wide < best:
                    best, chosen = wide, command
        return [] if chosen is None else [(chosen, "to make it smaller")]

    def _found_motions(self, one: str, other: str) -> list[Congruence]:
        if one == other:
            return self._models[one].symmetries
        return near_congruences(self._models[one].walls.polygon, self._models[other].walls.polygon, SAME * self.size)
