import ast
import random
import re
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest

import ial.compass.verifier
from ial.compass.planning import localizing_sequence
from ial.compass.sequence import Sequence
from ial.compass.verifier import Places, follow, image, stop, verify, whole_walls
from ial.errors import MapError, SequenceError
from ial.maps.polygons.polygon import Polygon
from tests.maps.polygons.exact.test_shooter import end_of_ray, is_free, starts
from tests.maps.polygons.known_polygons import HOLED, L_SHAPE, SPIKES, SQUARE, TOUCHING, comb
from tests.maps.polygons.random_polygons import random_polygon


def test_it_shares_no_code_with_what_it_judges() -> None:
    tree = ast.parse(Path(ial.compass.verifier.__file__).read_text())
    names = {str(node.module) for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
    names |= {alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names}
    assert {each for each in names if each.split(".")[0] == "ial"} == {"ial.errors"}
    assert not names & {"numpy", "gmpy2"}


@pytest.mark.parametrize("polygon", [HOLED, TOUCHING, SPIKES, random_polygon(12, 1, 30)])
def test_its_rays_end_where_the_next_part_is_not_free(polygon: Polygon) -> None:
    chooser = random.Random(2)
    walls, unit = whole_walls(polygon)
    assert unit == 1
    for start in starts(polygon, chooser, 25):
        for direction in [(1, 0), (0, -1), (chooser.randrange(-9, 10), chooser.randrange(1, 10))]:
            assert stop(walls, start, direction) == end_of_ray(polygon, start, direction)


def test_an_image_holds_where_robots_of_the_set_stop_and_what_comes_from_it() -> None:
    polygon, direction = L_SHAPE, (3, 1)
    walls, _ = whole_walls(polygon)
    after = image(walls, Places({5: [(Fraction(0), Fraction(1))]}, set()), direction)  # the left wall, from the top down
    parts = [Fraction(part, 60) for part in range(1, 60)]
    ends = {follow(polygon, (Fraction(0), 4 - 4 * part), [direction])[-1] for part in parts}
    assert after.points == {(4, 2), (2, 2), (2, 4)}
    assert after.points <= ends
    for x, y in ends:
        on_spans = any(
            (ax + low * (bx - ax) - x) * (ax + high * (bx - ax) - x) + (ay + low * (by - ay) - y) * (ay + high * (by - ay) - y) < 0
            and (bx - ax) * (y - ay) == (by - ay) * (x - ax)
            for wall, spans in after.spans.items()
            for (ax, ay), (bx, by) in [walls[wall]]
            for low, high in spans
        )
        assert on_spans or (x, y) in after.points


def test_corners_may_be_fractions() -> None:
    third = Polygon(tuple((x / 3, y / 7) for x, y in SPIKES.outer))
    assert whole_walls(third)[1] == 21
    sequence = localizing_sequence(third)
    verify(sequence)
    assert follow(third, third.outer[3], sequence.directions)[-1] == sequence.end


SEQUENCES = [localizing_sequence(polygon) for polygon in (SPIKES, comb(4, irregular=True), random_polygon(12, 0), random_polygon(14, 3))]


def altered(sequence: Sequence, chooser: random.Random) -> Iterator[tuple[str, Sequence]]:
    """Yield sequences in which one thing is changed, without end."""
    while True:
        at = chooser.randrange(len(sequence))
        kind = chooser.choice(["direction", "vertex", "end", "missing step", "sizes"])
        directions, sizes = list(sequence.directions), list(sequence.sizes)
        if kind == "direction":
            x, y = directions[at]
            directions[at] = chooser.choice([(-x, -y), (y, -x), (x + chooser.choice((-1, 1)), y), (x, y + 1)])
            if directions[at] == (0, 0):
                continue
            yield kind, replace(sequence, directions=tuple(directions))
        elif kind == "vertex":
            corners = list(sequence.polygon.outer)
            moved = chooser.randrange(len(corners))
            corners[moved] = corners[moved][0] + Fraction(chooser.choice((-1, 1)), 3), corners[moved][1]
            try:
                yield kind, replace(sequence, polygon=Polygon(tuple(corners)))
            except MapError:
                continue
        elif kind == "end":
            yield kind, replace(sequence, end=(sequence.end[0] + Fraction(chooser.choice((-1, 1)), 10**9), sequence.end[1]))
        elif kind == "sizes":
            sizes[at] = sizes[at][0], sizes[at][1] + 1
            yield kind, replace(sequence, sizes=tuple(sizes))
        else:
            del directions[at], sizes[at + 1]
            yield kind, replace(sequence, directions=tuple(directions), sizes=tuple(sizes))


def localizes(sequence: Sequence) -> bool:
    """Whether it leads every corner and some other starts to its end."""
    every = [*sequence.polygon.outer, *starts(sequence.polygon, random.Random(1), 8)]
    return all(follow(sequence.polygon, start, sequence.directions)[-1] == sequence.end for start in every)


@pytest.mark.slow
@pytest.mark.parametrize("sequence", SEQUENCES)
def test_certificates_that_were_altered_and_signed_anew_are_refused_unless_they_are_right(sequence: Sequence) -> None:
    """The digests of a file would give these away at once; here the geometry alone must."""
    verify(sequence)
    kinds, changes = [], altered(sequence, random.Random(8))
    for kind, other in (next(changes) for _ in range(25)):
        try:
            verify(other)
        except SequenceError as error:
            kinds += [kind] * bool(re.match(r"step \d+: ", str(error)))
        else:
            assert kind in {"direction", "vertex", "missing step"}
            assert localizes(other)  # what was changed makes no difference
    assert set(kinds) == {"direction", "vertex", "end", "missing step", "sizes"}
    assert len(kinds) >= 17


def test_it_says_at_which_step_and_what_is_wrong() -> None:
    sequence = localizing_sequence(SQUARE)
    short = replace(sequence, directions=sequence.directions[:1], sizes=sequence.sizes[:2])
    with pytest.raises(SequenceError, match="step 1: the robot may be in more than one place"):
        verify(short)
    with pytest.raises(SequenceError, match="step 1: there are 1 motions, but 2 states after them"):
        verify(replace(sequence, directions=sequence.directions[:1]))
    with pytest.raises(SequenceError, match="which is not exactly that"):
        verify(replace(sequence, end=(Fraction(1), Fraction(1))))
    with pytest.raises(SequenceError, match="step 0: 4 pieces of walls and 4 points are possible"):
        verify(replace(sequence, sizes=((3, 4), *sequence.sizes[1:])))


def test_a_start_stands_for_all_points_of_its_way() -> None:
    """Why the boundary is enough: a point inside, and the place on a wall straight behind it, are led to one place."""
    polygon = SPIKES
    walls, _ = whole_walls(polygon)
    for start in starts(polygon, random.Random(4), 20):
        for direction in [(1, 0), (-2, 3), (5, -9)]:
            behind = stop(walls, start, (-direction[0], -direction[1]))
            assert is_free(polygon, *behind)
            assert stop(walls, behind, direction) == stop(walls, start, direction)


def test_progress() -> None:
    told: list[tuple[int, int]] = []
    verify(SEQUENCES[0], lambda done, total: told.append((done, total)))
    assert told == [(step, len(SEQUENCES[0])) for step in range(1, 1 + len(SEQUENCES[0]))]
