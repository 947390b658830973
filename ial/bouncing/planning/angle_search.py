"""`search_angles`: the bouncing angle, or the sequence of angles, that localizes best (future work of Alam et al. 2017, section VI).

A sequence φ₁ … φₖ means: bounce at φ₁ until the information state is on a knowledge cycle, at once go on at φ₂ from the set of that state
until it is on a knowledge cycle of φ₂, and so on. The robot knows these moments, for they depend on its observations only. A set never
grows, so a longer sequence never localizes worse than its beginning.

The best sequence is the one with the least worst uncertainty over all first configurations; among these, with the least mean uncertainty;
among these the shortest; then the one that takes the fewest observations in the worst case. Every sequence up to the given length is
tried, so this is the optimum over fixed sequences with changes at these moments. Changing earlier, waiting on a cycle for a better moment,
or choosing the next angle by the set that was reached may do better, and is not searched.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

from ial.bouncing.automata.determinization import MOST_STATES, determinize
from ial.bouncing.cells.cell_map import CellMap
from ial.bouncing.cells.corner import Corner
from ial.bouncing.cells.graph import LabelledGraph, disjoint_union
from ial.bouncing.cells.headings import Headings
from ial.bouncing.planning.information_sets import InformationSets
from ial.bouncing.planning.phase import Phase
from ial.errors import ConfigError
from ial.maps.polygons.raster import Raster

MOST_SEQUENCES = 20_000


@dataclass(frozen=True)
class AngleSequence:
    """How well a sequence of bouncing angles localizes.

    Parameters
    ----------
    angles_deg
        The angles in degrees, in their order.
    least, worst
        The uncertainty in the end, in configurations: of the luckiest and of the unluckiest first configuration.
    mean
        The uncertainty in the end if all first configurations are equally likely.
    observations
        After so many observations every robot is done, and some need as many.
    ends
        How many information states the robot can end in.
    states, cycles
        Of the automaton, for a single angle; None for several, where the later automata begin in other sets.
    """

    angles_deg: tuple[Fraction, ...]
    least: int
    worst: int
    mean: Fraction
    observations: int
    ends: int
    states: int | None = None
    cycles: int | None = None

    @property
    def rank(self) -> tuple[int, Fraction, int, int, tuple[Fraction, ...]]:
        """What to sort by, the best first."""
        return self.worst, self.mean, len(self.angles_deg), self.observations, self.angles_deg


def search_angles(
    rasters: Sequence[Raster],
    headings: int,
    step: Fraction = Fraction(1),
    corner: Corner = "segment",
    angles_deg: Iterable[Fraction] | None = None,
    length: int = 1,
    most_states: int = MOST_STATES,
) -> list[AngleSequence]:
    """Return every sequence of angles up to a length, the best first.

    Parameters
    ----------
    rasters
        The free cells of one or several environments.
    headings
        How many headings there are.
    step
        How far a step leads, in widths of a cell.
    corner
        What a step must not touch, see `passed_cells`.
    angles_deg
        The angles to choose from, multiples of 360° / headings; by default all of them.
    length
        How many angles a sequence has at most. Longer ones are left out once no robot is uncertain any more.
    most_states
        The number of states of an automaton at which to give up.

    Raises
    ------
    ConfigError
        If an angle is no multiple, there is no angle to choose, or there are more than `MOST_SEQUENCES` sequences.
    MapError
        If an environment has no free cell.
    FilterError
        If an automaton would have too many states.
    """
    chosen = range(1, headings) if angles_deg is None else sorted({Headings.of_angle(each, headings).turn for each in angles_deg})
    if not chosen:
        raise ConfigError(f"no bouncing angle can be chosen with {headings} heading; give at least 2 headings and an angle")
    if length < 1:
        raise ConfigError(f"sequences of {length} angles cannot be searched; give 1 or more")
    if len(chosen) * max(len(chosen) - 1, 1) ** (length - 1) > MOST_SEQUENCES:
        raise ConfigError(
            f"there are more than {MOST_SEQUENCES} sequences of {length} out of {len(chosen)} angles; give a shorter sequence, fewer "
            "headings, or the angles to choose from"
        )
    choices = {turn: Headings(headings, turn, step) for turn in chosen}
    outcomes = []
    phases: dict[int, Phase] = {}
    level: list[tuple[tuple[int, ...], InformationSets]] = []
    for turn, each in choices.items():
        # Headings that look alike at one angle may differ at another: they are merged only where no change of the angle comes.
        graph = disjoint_union([CellMap(raster, each, corner, merge=length == 1).graph for raster in rasters])
        automaton, phase = determinize(graph, most_states), Phase.of(graph)
        known = phase.after(InformationSets.everything(graph))
        outcomes.append(_outcome([each.bounce_deg], known, graph, len(automaton), len(automaton.cycles)))
        if length > 1:  # else one graph at a time is enough to hold
            phases[turn] = phase
            level.append(((turn,), known))
    for _ in range(length - 1):
        if min(each.mean for each in outcomes) == 1:
            break
        level = list(_longer(level, phases))
        outcomes += [_outcome([choices[turn].bounce_deg for turn in turns], known, phases[turns[-1]].graph) for turns, known in level]
    return sorted(outcomes, key=lambda each: each.rank)


def _longer(
    level: Iterable[tuple[tuple[int, ...], InformationSets]], phases: dict[int, Phase]
) -> Iterator[tuple[tuple[int, ...], InformationSets]]:
    """Yield each sequence followed by each other angle; the same angle again would change nothing."""
    for turns, known in level:
        for turn, phase in phases.items():
            if turn != turns[-1]:
                yield (*turns, turn), phase.after(known)


def _outcome(
    angles_deg: Sequence[Fraction], known: InformationSets, graph: LabelledGraph, states: int | None = None, cycles: int | None = None
) -> AngleSequence:
    sizes = known.uncertainty(graph)
    return AngleSequence(
        tuple(angles_deg),
        int(sizes.min()),
        int(sizes.max()),
        known.mean(graph),
        int(known.elapsed.max()),
        len(known),
        states,
        cycles,
    )
