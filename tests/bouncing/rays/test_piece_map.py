from fractions import Fraction

import numpy as np
import pytest

from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.rays.piece_map import PieceMap
from ial.bouncing.rays.ray_model import RayModel
from ial.errors import ConfigError, FilterError, MapError
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.polygon import Polygon
from tests.bouncing.disk_truth import follow_pieces
from tests.bouncing.piece_truth import follow
from tests.bouncing.rays.test_real_robot import ROOM, ring

NONE = ExecutionBounds()


@pytest.mark.slow
@pytest.mark.parametrize("first", range(0, 120, 12))
def test_a_robot_with_real_geometry_is_never_lost(first: int) -> None:
    assert sum(follow(seed).losses for seed in range(first, first + 12)) == 0


@pytest.mark.slow
@pytest.mark.parametrize("first", range(0, 96, 12))
def test_a_disk_is_never_lost(first: int) -> None:
    assert sum(follow_pieces(seed).losses for seed in range(first, first + 12)) == 0


def test_a_disk_is_never_where_it_does_not_fit() -> None:
    """A corridor of 1 m between two rooms: a disk of radius 0.8 m cannot pass it, one of 0.4 m can."""
    rooms = Environment((Polygon(ring((0, 0), (4, 0), (4, 1), (7, 1), (7, 0), (11, 0), (11, 4), (7, 4), (7, 2), (4, 2), (4, 4), (0, 4))),))
    for radius, passes in ((Fraction(2, 5), True), (Fraction(4, 5), False)):
        made = PieceMap.of(rooms, Fraction(100), Fraction(1, 4), NONE, Fraction(1, 4), 72, radius)
        standing = np.flatnonzero(made.longest >= 0) % made.parts.sum()
        x0, x1 = made.boxes_mm[:, 0] / 1000 - float(radius), made.boxes_mm[:, 2] / 1000 - float(radius)
        in_corridor = (x0[standing] > 4.3) & (x1[standing] < 6.7)
        assert in_corridor.any() == passes
        begins, left = np.repeat(np.arange(len(made)), np.diff(made.starts)) % made.parts.sum(), x1 < 4.3
        assert (left[begins] & ~left[made.ends]).any() == passes
    with pytest.raises(MapError, match="radius 3 m fits nowhere"):
        PieceMap.of(rooms, Fraction(100), Fraction(1, 4), NONE, Fraction(1, 4), 72, Fraction(3))


@pytest.mark.slow
@pytest.mark.parametrize("radius", [Fraction(0), Fraction(1, 5)])
def test_a_map_is_the_same_from_whatever_corner_its_rings_begin(radius: Fraction) -> None:
    """And whatever was in the memory before: what is measured of walls that no ray of a beam can meet is never read."""
    outer, hole = ring((0, 0), (9, 0), (9, 4), (5, 4), (5, 7), (0, 7)), ring((2, 2), (2, 4), (3, 4), (3, 2))
    found = set()
    for turn in range(4):
        made = Environment((Polygon(outer[turn:] + outer[:turn], (hole[turn:] + hole[:turn],)),))
        map_ = PieceMap.of(made, Fraction(100), Fraction(1, 4), NONE, Fraction(1, 2), 36, radius)
        found.add((len(map_), len(map_.ends)))
    assert len(found) == 1


def test_many_walls_are_no_reason_to_refuse() -> None:
    """`RayModel` refuses so many unless its sets may have more pieces; here sets are not made coarser."""
    teeth = [corner for x in range(330) for corner in ((x, 4), (x + 0.5, 3.5))][::-1]
    saw = Environment((Polygon(ring((0, 0), (330, 0), *teeth)),))
    with pytest.raises(ConfigError, match="too coarse"):
        RayModel(saw, Fraction(100), Fraction(100))
    made = PieceMap.of(saw, Fraction(100), Fraction(100), NONE, Fraction(1000), 32)
    assert len(made) == 32 * (2 + 2 * 330)
    assert (np.diff(made.starts) > 0).all()


def test_what_is_done_is_told() -> None:
    told: list[tuple[int, int]] = []
    made = PieceMap.of(ROOM, Fraction(100), Fraction(1), NONE, Fraction(1), 36, progress=lambda *each: told.append(each))
    assert told == [(done, len(told)) for done in range(1, len(told) + 1)]
    assert len(told) > made.most.max()


@pytest.mark.parametrize(
    ("change", "error", "message"),
    [
        ({"part_m": Fraction(0)}, ConfigError, "0 m wide"),
        ({"headings": 31}, ConfigError, "31 intervals of headings are too wide"),
        ({"part_m": Fraction(1, 10**6)}, FilterError, "at most 1048576"),
        ({"part_m": Fraction(1, 10**5)}, FilterError, "at most 1048576"),
        ({"part_m": Fraction(1, 10**300)}, FilterError, "at most 1048576"),
        ({"step_m": Fraction(0)}, ConfigError, "step is 0 m"),
        ({"step_m": Fraction(1, 10**300)}, FilterError, "steps between two bumps; use longer steps"),
        ({"radius_m": Fraction(-1)}, ConfigError, "radius of the robot is -1 m"),
    ],
)
def test_what_cannot_be_meant_is_refused(change: dict[str, object], error: type[Exception], message: str) -> None:
    usual = {"bounce_deg": Fraction(90), "step_m": Fraction(1), "bounds": NONE, "part_m": Fraction(1), "headings": 36}
    with pytest.raises(error, match=message):
        PieceMap.of(ROOM, **(usual | change))  # type: ignore[arg-type]
