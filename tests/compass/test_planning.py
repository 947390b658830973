"""Whole plans: proved by the verifier, and carried out from corners, critical points and everywhere else by its exact rays."""

import random
import subprocess
import sys
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import pytest

from ial.compass.example import example_polygon
from ial.compass.planning import localizing_sequence
from ial.compass.primitive import MOST_BITS, primitive
from ial.compass.segment_phase import Order
from ial.compass.sequence import Sequence
from ial.compass.verifier import follow, stop, verify, whole_walls
from ial.errors import MapError, SequenceError
from ial.maps.polygons.polygon import ExactPoint, Polygon
from tests.maps.polygons.exact.test_shooter import starts
from tests.maps.polygons.known_polygons import (
    HOLED,
    L_SHAPE,
    SPIKES,
    SQUARE,
    STRAIGHT_CORNERS,
    TOUCHING,
    TWO_TOUCHING,
    Z_SHAPE,
    comb,
    serpentine,
)
from tests.maps.polygons.random_polygons import random_polygon, rectilinear_polygon

KNOWN = {
    "square": SQUARE,
    "L": L_SHAPE,
    "Z": Z_SHAPE,
    "spikes": SPIKES,
    "corners on straight walls": STRAIGHT_CORNERS,
    "comb": comb(4),
    "comb of 8": comb(8),
    "irregular comb": comb(5, irregular=True),
    "serpentine": serpentine(4),
    "rectilinear": rectilinear_polygon(5, 3),
    "random, 10": random_polygon(10, 0),
    "random, 20": random_polygon(20, 1),
}


def critical_points(polygon: Polygon, direction: tuple[int, int]) -> list[ExactPoint]:
    """Where robots start that touch or hit a corner: walls straight behind corners."""
    walls, unit = whole_walls(polygon)
    back = (-direction[0], -direction[1])
    found = [stop(walls, (Fraction(x), Fraction(y)), back) for (x, y), _ in walls]
    return [(x / unit, y / unit) for x, y in found]


def check(polygon: Polygon, sequence: Sequence, inside: int) -> None:
    verify(sequence)
    assert sequence.bits <= MOST_BITS
    assert all(primitive(*direction) == direction for direction in sequence.directions)
    corners = [corner for ring in polygon.rings for corner in ring]
    middles = [((ax + bx) / 2, (ay + by) / 2) for ring in polygon.rings for (ax, ay), (bx, by) in pairwise([*ring, ring[0]])]
    critical = critical_points(polygon, sequence.directions[0])
    for start in [*corners, *middles, *critical, *starts(polygon, random.Random(5), inside)]:
        assert follow(polygon, start, sequence.directions)[-1] == sequence.end


@pytest.mark.slow
@pytest.mark.parametrize("order", ["greedy", "paper"])
@pytest.mark.parametrize("name", KNOWN)
def test_every_start_ends_in_one_point(name: str, order: Order) -> None:
    check(KNOWN[name], localizing_sequence(KNOWN[name], order), 12)


@pytest.mark.slow
def test_many_walls() -> None:
    polygon = random_polygon(50, 4)
    greedy, paper = localizing_sequence(polygon), localizing_sequence(polygon, "paper")
    check(polygon, greedy, 10)
    verify(paper)
    assert len(greedy) <= 0.8 * len(paper)


@pytest.mark.parametrize("polygon", [HOLED, TOUCHING, TWO_TOUCHING])
def test_holes(polygon: Polygon) -> None:
    check(polygon, localizing_sequence(polygon), 12)


@pytest.mark.slow
def test_a_comb_takes_as_many_motions_however_many_branches_it_has() -> None:
    """The thesis' regular environment takes 5 (table 3.1), for it shrinks all branches at once."""
    assert len({len(localizing_sequence(comb(branches))) for branches in (2, 4, 8)}) == 1
    assert len(localizing_sequence(comb(8))) <= 5
    assert len(localizing_sequence(comb(8), "paper")) <= 5


def test_progress_and_turned_rings() -> None:
    told: list[tuple[int, tuple[int, int]]] = []
    clockwise = Polygon(SPIKES.outer[::-1])
    sequence = localizing_sequence(clockwise, progress=lambda done, sizes: told.append((done, sizes)))
    assert told == list(enumerate(sequence.sizes))[1:]
    assert set(clockwise.outer) == set(sequence.polygon.outer)
    assert localizing_sequence(clockwise) == sequence


@pytest.mark.slow
def test_the_same_plan_every_time() -> None:
    assert localizing_sequence(random_polygon(20, 2)) == localizing_sequence(random_polygon(20, 2))


def test_where_none_is_found_it_says_so_and_claims_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ial.compass.point_phase.Chase.search", lambda *_: None)
    with pytest.raises(SequenceError, match=r"none found: 3 places are left .* no proof"):
        localizing_sequence(random_polygon(10, 0), "paper")
    monkeypatch.setattr("ial.compass.segment_phase._MOST_MOTIONS", 0)
    with pytest.raises(SequenceError, match=r"none found: after 0 motions whole pieces .* no proof"):
        localizing_sequence(SQUARE)


def test_walls_in_directions_of_too_many_bits_are_refused() -> None:
    with pytest.raises(MapError, match="wall 2 has a direction of 69 bits"):
        localizing_sequence(Polygon(((0, 0), (4, 0), (4 + Fraction(1, 2**67), 3), (0, 3))))  # type: ignore[arg-type]


@pytest.mark.slow
def test_the_rational_numbers_of_python_lead_to_the_same_sequence() -> None:
    pytest.importorskip("gmpy2")
    program = """
import sys
sys.modules["gmpy2"] = None
from ial.compass import localizing_sequence
from tests.maps.polygons.random_polygons import random_polygon
for seed in range(3):
    made = localizing_sequence(random_polygon(14, seed))
    print(made.directions, made.sizes, *map(str, made.end))
"""
    root = Path(__file__).resolve().parents[2]
    told = subprocess.run([sys.executable, "-c", program], cwd=root, check=True, capture_output=True, text=True).stdout.splitlines()
    made = [localizing_sequence(random_polygon(14, seed)) for seed in range(3)]
    assert told == [f"{each.directions} {each.sizes} {each.end[0]} {each.end[1]}" for each in made]


@pytest.mark.slow
@pytest.mark.parametrize("order", ["greedy", "paper"])
@pytest.mark.parametrize("scale", [Fraction(1, 10**9), Fraction(10**9)])
def test_tiny_and_huge_environments_have_sequences_too(order: Order, scale: Fraction) -> None:
    verify(localizing_sequence(Polygon(tuple((scale * x, scale * y) for x, y in example_polygon().outer)), order))
