import io
import json
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from ial.bouncing.cells.headings import Headings
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.bouncing.filters.filter_file import read_filter, write_filter
from ial.bouncing.filters.goal import Goal, Room
from ial.bouncing.filters.piece_filter import PieceFilter
from ial.bouncing.filters.robust_building import build_robust_filter
from ial.bouncing.filters.robust_filter import RobustFilter
from ial.bouncing.rays.piece_map import PieceMap
from ial.errors import FilterError, OutputError
from tests.bouncing.rays.test_real_robot import ROOM


@pytest.fixture
def path(made: BounceFilter, tmp_path: Path) -> Path:
    write_filter(made, tmp_path / "a.npz")
    return tmp_path / "a.npz"


def test_a_filter_comes_back_as_it_was(made: BounceFilter, path: Path) -> None:
    again = read_filter(path)
    assert isinstance(again, BounceFilter)
    assert again.setting == made.setting
    for part in ("table", "places"):
        for name, array in vars(getattr(made, part)).items():
            assert np.array_equal(array, getattr(getattr(again, part), name)), name
    state = int(np.flatnonzero(made.table.colours == 2)[-1])
    assert again.where(state) == made.where(state)
    assert list(path.parent.iterdir()) == [path]


def test_a_robust_filter_comes_back_as_it_was(tmp_path: Path) -> None:
    goal = Goal((Room("all", *map(Fraction, (0, 0, 4, 3))), Room("half", *map(Fraction, (0, 0, 2, 3)), "room")))
    bounds = ExecutionBounds(Fraction(1, 3), Fraction(1, 7), 1)
    made = build_robust_filter({"room": ROOM}, Headings.of_angle(Fraction(90), 8, Fraction(2)), Fraction(1), goal, bounds, most_states=50)
    write_filter(made, tmp_path / "b.npz")
    again = read_filter(tmp_path / "b.npz")
    assert isinstance(again, RobustFilter)
    assert (again.setting, again.bounds, again.goal, again.growth) == (made.setting, bounds, goal, made.growth)
    for part in ("table", "places"):
        for name, array in vars(getattr(made, part)).items():
            assert np.array_equal(array, getattr(getattr(again, part), name)), name


def test_a_filter_of_pieces_comes_back_as_it_was(tmp_path: Path) -> None:
    bounds, angle, step = ExecutionBounds(Fraction(1, 3), Fraction(1, 7), 1), Fraction(200, 3), Fraction(1, 3)
    pieces = PieceMap.of(ROOM, angle, step, bounds, Fraction(1), 36)
    made = PieceFilter(pieces, "room", angle, step, bounds, Goal(width=Fraction(3, 2)))
    write_filter(made, tmp_path / "c.npz")
    again = read_filter(tmp_path / "c.npz")
    assert isinstance(again, PieceFilter)
    assert (again.name, again.bounce_deg, again.step_m, again.bounds, again.goal) == ("room", angle, step, bounds, made.goal)
    assert (again.map.headings, again.map.turns, again.map.walls.origin) == (36, pieces.turns, pieces.walls.origin)
    for name in ("parts", "starts", "ends", "least", "most", "longest", "boxes_mm"):
        assert np.array_equal(getattr(again.map, name), getattr(pieces, name)), name
    assert np.array_equal(again.map.walls.table[0], pieces.walls.table[0])
    damaged = bytearray((tmp_path / "c.npz").read_bytes())
    damaged[len(damaged) // 2] ^= 0x10
    (tmp_path / "c.npz").write_bytes(damaged)
    with pytest.raises(FilterError, match=r"c\.npz: .*(truncated|damaged)"):
        read_filter(tmp_path / "c.npz")


def test_a_truncated_file_is_refused(path: Path) -> None:
    whole = path.read_bytes()
    for size in (0, 10, len(whole) // 3, len(whole) - 200, len(whole) - 1):
        path.write_bytes(whole[:size])
        with pytest.raises(FilterError, match=r"a\.npz: .*(truncated|damaged)"):
            read_filter(path)


def test_every_damaged_byte_is_noticed(path: Path, made: BounceFilter) -> None:
    whole = bytearray(path.read_bytes())
    for at in range(0, len(whole), 37):
        path.write_bytes(whole[:at] + bytes([whole[at] ^ 0x10]) + whole[at + 1 :])
        try:
            again = read_filter(path)  # bytes of the archive's own bookkeeping may differ, as long as the content does not
        except FilterError:
            continue
        assert np.array_equal(again.table.successors, made.table.successors)
        assert again.setting == made.setting


def rewritten(path: Path, **changes: object) -> None:
    with np.load(path) as archive:
        arrays = dict(archive)
    about = json.loads(arrays.pop("about").tobytes())
    for name, value in changes.items():
        if name in arrays:
            arrays[name] = value  # type: ignore[assignment]
        else:
            about[name] = value
    content = io.BytesIO()
    np.savez(content, about=np.frombuffer(json.dumps(about).encode(), dtype=np.uint8), **arrays)
    path.write_bytes(content.getvalue())


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"version": 2}, "a filter of version 2, and this ial reads 1; build it again"),
        ({"form": "something else"}, "a filter of version 1, and"),
        ({"colours": np.zeros(3, dtype=np.int32)}, "damaged: its checksum differs"),
        ({"colours": np.zeros(3)}, "damaged"),
        ({"setting": {}}, "damaged"),
        ({"sha256": ""}, "damaged"),
    ],
)
def test_a_changed_file_is_refused(path: Path, changes: dict[str, object], message: str) -> None:
    rewritten(path, **changes)
    with pytest.raises(FilterError, match=message):
        read_filter(path)


def test_what_is_no_filter_is_refused(tmp_path: Path, made: BounceFilter) -> None:
    with pytest.raises(FilterError, match="cannot be read"):
        read_filter(tmp_path / "nowhere.npz")
    np.savez(tmp_path / "b.npz", x=np.zeros(3))
    with pytest.raises(FilterError, match="no filter that ial has written"):
        read_filter(tmp_path / "b.npz")
    np.save(tmp_path / "c.npy", np.zeros(3))
    with pytest.raises(FilterError, match="no filter that ial has written"):
        read_filter(tmp_path / "c.npy")
    with pytest.raises(OutputError, match="cannot be written"):
        write_filter(made, tmp_path / "nowhere" / "a.npz")
