from fractions import Fraction
from itertools import product

import numpy as np
import pytest

from ial.bouncing.cells.graph import LabelledGraph
from ial.bouncing.planning.angle_search import AngleSequence, search_angles
from ial.errors import ConfigError
from ial.maps.polygons.raster import Raster
from tests.bouncing.worlds import HALL, STORE, MaskArray, cell_map, drawn, random_mask

Held = frozenset[int]
SMALL = [random_mask(seed, 4, 5) for seed in range(4)]


def split(graph: LabelledGraph, held: Held) -> dict[bool, Held]:
    """Where a set leads, by what is observed."""
    images: dict[bool, set[int]] = {}
    for vertex in held:
        images.setdefault(bool(graph.labels[vertex]), set()).add(int(graph.successors[vertex]))
    return {label: frozenset(image) for label, image in images.items()}


def comes_back(graph: LabelledGraph, held: Held) -> bool:
    """Whether a set is on a knowledge cycle, by definition: it is reached again, and never divided on the way."""
    seen, now = set(), held
    while now not in seen:
        seen.add(now)
        images = split(graph, now)
        if len(images) > 1:
            return False
        (now,) = images.values()
    return now == held


def twin(graphs: list[LabelledGraph]) -> tuple[list[int], int]:
    """The uncertainty each start ends with, and the most observations: every start is followed by itself."""
    ends, most = [], 0
    for start in range(len(graphs[0])):
        vertex, held, observed = start, frozenset(range(len(graphs[0]))), 0
        for graph in graphs:
            while not comes_back(graph, held):
                held = split(graph, held)[bool(graph.labels[vertex])]
                vertex = int(graph.successors[vertex])
                observed += 1
                assert vertex in held
        ends.append(len(held))
        most = max(most, observed)
    return ends, most


@pytest.mark.slow
@pytest.mark.parametrize("free", SMALL)
def test_every_sequence_equals_brute_force(free: MaskArray) -> None:
    outcomes = {each.angles_deg: each for each in search_angles([Raster(free)], 4, length=3)}
    maps = {Fraction(angle): cell_map(free, angle).graph for angle in (90, 180, 270)}
    tried = [angles for length in (1, 2, 3) for angles in product(maps, repeat=length) if all(map(Fraction.__ne__, angles, angles[1:]))]
    if min(each.mean for each in outcomes.values()) > 1:
        assert set(outcomes) == set(tried)
    for angles, each in outcomes.items():
        ends, most = twin([maps[angle] for angle in angles])
        assert (each.least, each.worst, each.mean) == (min(ends), max(ends), Fraction(sum(ends), len(ends)))
        assert each.observations == most


@pytest.mark.slow
def test_the_best_comes_first_and_is_the_best_of_all_by_brute_force() -> None:
    free, angles = SMALL[1], [Fraction(45), Fraction(90), Fraction(135)]
    best = search_angles([Raster(free)], 8, angles_deg=angles, length=2)[0]
    maps = {angle: cell_map(free, int(angle), 8).graph for angle in angles}
    ranks = []
    for tried in [(one,) for one in angles] + [(one, two) for one in angles for two in angles if one != two]:
        ends, most = twin([maps[angle] for angle in tried])
        ranks.append((max(ends), Fraction(sum(ends), len(ends)), len(tried), most, tried))
    assert best.rank == min(ranks)


def test_merged_headings_change_nothing() -> None:
    raster, angle = Raster(HALL), [Fraction(90)]
    (merged,) = search_angles([raster], 24, angles_deg=angle)
    (alone,) = (each for each in search_angles([raster], 24, angles_deg=[*angle, Fraction(180)], length=2) if each.angles_deg == (90,))
    assert merged.states == alone.states
    assert (merged.least, merged.worst, merged.mean, merged.observations) == (alone.least, alone.worst, alone.mean, alone.observations)


def test_a_change_of_the_angle_tells_more() -> None:
    outcomes = search_angles([Raster(drawn("..... .#... ..... .....")), Raster(STORE)], 8, length=2)
    best, single = outcomes[0], min((each for each in outcomes if len(each.angles_deg) == 1), key=lambda each: each.rank)
    assert len(best.angles_deg) == 2
    assert (best.worst, best.mean) < (single.worst, single.mean)


def test_what_no_angle_tells_apart_stays_uncertain() -> None:
    square = Raster(np.ones((4, 4), dtype=np.bool_))
    for each in search_angles([square], 4, length=3):
        assert each.least >= 4  # a quarter turn of the room moves every robot to one with the same observations


def test_longer_sequences_are_left_out_once_nothing_is_uncertain() -> None:
    known = search_angles([Raster(random_mask(2))], 8, length=9, angles_deg=[Fraction(135), Fraction(225)])
    assert [each.angles_deg for each in known] == [(225,), (135,)]
    assert known[0].mean == known[0].worst == 1 < known[1].mean


def test_the_order() -> None:
    def made(worst: int, mean: int, angles: tuple[int, ...], observations: int) -> AngleSequence:
        return AngleSequence(tuple(map(Fraction, angles)), 1, worst, Fraction(mean), observations, 1)

    wanted = [made(1, 1, (1, 2), 90), made(2, 1, (90,), 9), made(2, 1, (45,), 10), made(2, 1, (1, 2), 5), made(2, 2, (90,), 1)]
    assert sorted([wanted[i] for i in (3, 0, 4, 2, 1)], key=lambda each: each.rank) == wanted


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"headings": 1}, "no bouncing angle can be chosen"),
        ({"headings": 4, "length": 0}, "sequences of 0 angles"),
        ({"headings": 360, "length": 2}, "more than 20000 sequences"),
        ({"headings": 4, "angles_deg": [Fraction(45)]}, "not a multiple of 90°"),
        ({"headings": 4, "angles_deg": [Fraction(360)]}, "multiple of 360°"),
        ({"headings": 4, "angles_deg": []}, "no bouncing angle can be chosen"),
    ],
)
def test_bad_searches_are_refused(options: dict[str, object], message: str) -> None:
    with pytest.raises(ConfigError, match=message):
        search_angles([Raster(HALL)], **options)  # type: ignore[arg-type]
