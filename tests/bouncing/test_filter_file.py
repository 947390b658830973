import io
import json
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from ial.bouncing.bounce_filter import BounceFilter
from ial.bouncing.building import build_filter
from ial.bouncing.determinization import determinize
from ial.bouncing.filter_file import read_filter, write_filter
from ial.bouncing.graph import disjoint_union
from ial.bouncing.headings import Headings
from ial.errors import ConfigError, FilterError, MapError, OutputError
from ial.maps.environment import Environment
from ial.maps.outline import outlines
from ial.maps.wkt import parse_wkt
from tests.bouncing.worlds import cell_map, drawn, twin_information_states

HALL, STORE = drawn("....... ....... ....... ..#.... ......."), drawn(".....# ...... ..#... ...... #.....")


@pytest.fixture(scope="module")
def made() -> BounceFilter:
    environments = {name: Environment(outlines(free, Fraction(1, 2)), Fraction(1, 2)) for name, free in (("hall", HALL), ("store", STORE))}
    return build_filter(environments, Headings.of_angle(Fraction(90), 24))


@pytest.fixture
def path(made: BounceFilter, tmp_path: Path) -> Path:
    write_filter(made, tmp_path / "a.npz")
    return tmp_path / "a.npz"


def test_a_filter_comes_back_as_it_was(made: BounceFilter, path: Path) -> None:
    again = read_filter(path)
    assert again.setting == made.setting
    for part in ("table", "places"):
        for name, array in vars(getattr(made, part)).items():
            assert np.array_equal(array, getattr(getattr(again, part), name)), name
    state = int(np.flatnonzero(made.table.colours == 2)[-1])
    assert again.where(state) == made.where(state)
    assert list(path.parent.iterdir()) == [path]


def test_places_are_those_of_the_sets(made: BounceFilter) -> None:
    maps = [cell_map(free, 90, 24) for free in (HALL, STORE)]
    automaton = determinize(disjoint_union([each.graph for each in maps]))
    _, sets = twin_information_states(automaton.graph)
    assert len(made.table) == len(automaton) + 1
    for state in np.flatnonzero(automaton.colours > 1).tolist():
        places = {(p.environment, p.x_m, p.y_m, heading) for p in made.where(state) for heading in p.headings_deg}
        expected = set()
        for vertex in sets[state]:
            number = int(automaton.graph.part_of(vertex))
            row, column, heading = (int(each) for each in maps[number].configurations(vertex - automaton.graph.starts[number]))
            x, y = Fraction(2 * column + 1, 4), Fraction(2 * row + 1, 4)
            expected.add((("hall", "store")[number], x, y, Fraction(15 * heading)))
        assert places == expected
        assert len(places) == made.table.uncertainty[state]
    assert made.where(0) == made.where(made.table.trap) == []


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


def test_what_cannot_be_built_is_refused() -> None:
    room, headings = Environment(parse_wkt("POLYGON ((0 0, 4 0, 4 3, 0 3, 0 0))")), Headings.of_angle(Fraction(90))
    with pytest.raises(ConfigError, match="no environment"):
        build_filter({}, headings)
    with pytest.raises(ConfigError, match="width of a cell is not known"):
        build_filter({"room": room}, headings)
    with pytest.raises(MapError, match=r"room: no cell is free for a robot of radius 2 m in cells of 1 m"):
        build_filter({"room": room}, headings, Fraction(1), Fraction(2))
    with pytest.raises(FilterError, match="more than 3 states"):
        build_filter({"room": room}, headings, Fraction(1), most_states=3)
    assert build_filter({"room": room}, headings, Fraction(1), Fraction(1)).table.uncertainty[0] == 8
