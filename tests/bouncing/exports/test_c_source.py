import re
import shutil
import subprocess
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from ial.bouncing.automata.table import FilterTable
from ial.bouncing.exports import c_array
from ial.bouncing.exports.c_source import c_header
from ial.bouncing.exports.c_tables import CTables
from ial.bouncing.exports.exported_filter import ExportedFilter
from ial.bouncing.filters.bounce_filter import BounceFilter, Place
from ial.bouncing.filters.robust_filter import RobustFilter
from ial.errors import ConfigError
from tests.bouncing.exports import avr
from tests.bouncing.exports.rooms import own_streams, random_streams
from tests.bouncing.worlds import drawn

WARNINGS = ["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror", "-O2"]
COMPILERS = {"gcc": ["gcc", "-std=c99", "-x", "c"], "g++": ["g++", "-std=c++11", "-x", "c++"]}

REPLAY = """\
#include <stdio.h>
#include "f.h"

int main(void) {
    room_state state = ROOM_START;
    int letter;
    while ((letter = getchar()) != EOF) {
        if (letter == '\\n') {
            state = ROOM_START;
            continue;
        }
        state = room_step(state, letter == '1');
        printf("%lu %lu %d %d %lu\\n", (unsigned long)state, (unsigned long)room_colour(state), room_trapped(state),
               room_localized(state), (unsigned long)room_size(state));
    }
    return 0;
}
"""

PLACES = """\
#include <stdio.h>
#include "f.h"

int main(void) {
    unsigned state, i, k;
    for (state = 0; state < ROOM_STATES; state++) {
        for (i = 0; i < room_place_count((room_state)state); i++) {
            const room_place_t place = room_place((room_state)state, (unsigned char)i);
            printf("%u %u %u %u", state, (unsigned)place.environment, (unsigned)place.row, (unsigned)place.column);
            for (k = 0; k < room_heading_count(place); k++) {
                printf(" %u", (unsigned)room_heading(place, (unsigned char)k));
            }
            printf("\\n");
        }
    }
    return 0;
}
"""


def compiled(compiler: str, header: str, program: str, folder: Path, *more: str) -> Path:
    """A program that includes the header as f.h."""
    if shutil.which(compiler) is None:
        pytest.skip(f"{compiler} is not installed")
    (folder / "f.h").write_text(header)
    (folder / "main.c").write_text(program)
    subprocess.run([*COMPILERS[compiler], *WARNINGS, *more, str(folder / "main.c"), "-o", str(folder / "run")], check=True)
    return folder / "run"


def replayed(program: Path, streams: list[list[int]]) -> list[list[int]]:
    """The rows that the program prints for all streams, one after the other."""
    text = "".join("".join(map(str, stream)) + "\n" for stream in streams)
    done = subprocess.run([program], input=text, capture_output=True, text=True, check=True)
    return [[int(word) for word in line.split()] for line in done.stdout.splitlines()]


def expected(table: FilterTable, streams: list[list[int]]) -> list[list[int]]:
    """What Python says about them."""
    states = [state for stream in streams for state in table.run(stream)]
    return [
        [state, int(table.colours[state]), state == table.trap, table.is_localized(state), int(table.uncertainty[state])]
        for state in states
    ]


@pytest.mark.slow
@pytest.mark.parametrize("compiler", COMPILERS)
@pytest.mark.parametrize("restart", [False, True])
def test_c_steps_as_python_does(small: BounceFilter, compiler: str, restart: bool, tmp_path: Path) -> None:
    exported = ExportedFilter.of(small, restart=restart)
    program = compiled(compiler, c_header(exported, "room"), REPLAY, tmp_path)
    own, others = own_streams(small), random_streams()
    steps = replayed(program, own + others)
    assert steps == expected(exported.table, own + others)
    assert len(own) == 152 * len(small.setting.names)
    trapped = np.array([row[2] for row in steps])
    assert trapped[: 60 * len(own)].sum() == 0
    random = trapped[60 * len(own) :].reshape(len(others), -1)
    assert random.any(axis=1).sum() > 200
    assert bool((random[:, :-1] > random[:, 1:]).any()) == restart


@pytest.mark.slow
@pytest.mark.parametrize("restart", [False, True])
def test_a_robust_filter_steps_as_in_python(robust: RobustFilter, restart: bool, tmp_path: Path) -> None:
    exported = ExportedFilter.of(robust, restart=restart)
    header = c_header(exported, "room")
    assert " * Colour 2: a ___.\n * Colour 3: b.\n" in header
    assert "errs by at most 1 degrees in a turn, 1/100 of a step," in header
    streams = random_streams(2000)
    steps = replayed(compiled("gcc", header, REPLAY, tmp_path), streams)
    assert steps == expected(exported.table, streams)
    assert len({row[1] for row in steps}) >= 3, "localized in a room, not localized, and trapped"
    index = re.search(r"room_place\(room_state state, (\w+) i\)", header)
    assert index is not None
    check_places(robust, compiled("gcc", header, PLACES.replace("(unsigned char)i", f"({index[1]})i"), tmp_path))


@pytest.mark.slow
@pytest.mark.parametrize("keep", ["colours", "localized"])
def test_minimized_filters_have_the_same_colours(corner: BounceFilter, keep: str, tmp_path: Path) -> None:
    exported = ExportedFilter.of(corner, keep)  # type: ignore[arg-type]
    assert len(exported.table) < len(corner.table)
    header = c_header(exported, "room")
    assert "places" not in re.sub(r"/\*.*?\*/", "", header, flags=re.DOTALL)
    streams = own_streams(corner) + random_streams()
    steps = replayed(compiled("gcc", header, REPLAY, tmp_path), streams)
    assert steps == expected(exported.table, streams)
    colours = [int(corner.table.colours[state]) for stream in streams for state in corner.table.run(stream)]
    if keep == "localized":
        assert [row[2:4] for row in steps] == [row[2:4] for row in expected(corner.table, streams)]
    else:
        assert [row[1] for row in steps] == colours


@pytest.mark.parametrize("compiler", COMPILERS)
def test_places_are_those_of_the_filter(small: BounceFilter, compiler: str, tmp_path: Path) -> None:
    check_places(small, compiled(compiler, c_header(ExportedFilter.of(small), "room"), PLACES, tmp_path))


def check_places(small: BounceFilter | RobustFilter, program: Path) -> None:
    """Compare what a program prints with the places of a filter."""
    setting = small.setting
    shown: dict[int, list[Place]] = {}
    for line in subprocess.run([program], capture_output=True, text=True, check=True).stdout.splitlines():
        state, environment, row, column, *headings = map(int, line.split())
        x, y = setting.centre(environment, row, column)
        angles = tuple(setting.headings.angle_deg(each) for each in headings)
        shown.setdefault(state, []).append(Place(setting.names[environment], x, y, angles))
    assert shown == {state: small.where(state) for state in range(len(small.table)) if small.table.is_localized(state)}
    assert all(sum(len(place.headings_deg) for place in places) == small.table.uncertainty[state] for state, places in shown.items())


def test_merged_headings_are_listed(made: BounceFilter, tmp_path: Path) -> None:
    # 24 headings in 8 classes, in two environments.
    header = c_header(ExportedFilter.of(made), "room")
    lines = subprocess.run([compiled("gcc", header, PLACES, tmp_path)], capture_output=True, text=True, check=True).stdout.splitlines()
    for line in lines[:: max(1, len(lines) // 50)]:
        state, environment, _, _, *headings = map(int, line.split())
        assert tuple(made.setting.headings.angle_deg(each) for each in headings) in {place.headings_deg for place in made.where(state)}
        assert made.setting.names[environment] in {place.environment for place in made.where(state)}
    assert max(len(line.split()) for line in lines) > 5


@pytest.mark.slow
def test_wide_tables_are_compiled(tmp_path: Path) -> None:
    # More than 65,536 states: tables of 32 bits; a mask of environment 63 takes 64.
    count = 70_000
    successors = np.column_stack([np.r_[np.arange(1, count), 0, count], np.full(count + 1, count)]).astype(np.int32)
    colours = np.ones(count + 1, dtype=np.int32)
    colours[-1] = 2
    masks = np.full(count + 1, 2**63, dtype=np.uint64)
    table = FilterTable(successors, colours, np.full(count + 1, 300_000), masks)
    setting = ExportedFilter.of(small_filter()).setting
    exported = ExportedFilter(table, None, setting)
    header = c_header(exported, "room")
    assert "typedef uint32_t room_state;" in header
    assert f"{2**63}ull" in header
    stream = [0] * 69_999 + [0, 0, 1]
    assert replayed(compiled("gcc", header, REPLAY, tmp_path), [stream])[-4:] == expected(table, [stream])[-4:]


def small_filter() -> BounceFilter:
    from ial.bouncing.cells.headings import Headings
    from ial.bouncing.filters.building import build_filter
    from ial.maps.polygons.environment import Environment
    from ial.maps.polygons.outline import outlines

    name = 'a */ b\\\n"c" ??/ é'
    return build_filter({name: Environment(outlines(drawn("... .#."), Fraction(1)), Fraction(1))}, Headings.of_angle(Fraction(90)))


def test_names_of_environments_do_no_harm(tmp_path: Path) -> None:
    header = c_header(ExportedFilter.of(small_filter()), "room")
    assert "Environment 0: a __ b___c_ ___ _, lower" in header
    compiled("gcc", header, REPLAY, tmp_path)


@pytest.mark.parametrize("prefix", ["", "2fast", "a-b", "_a", "é", "a b", "a\n"])
def test_what_is_no_identifier_is_refused(corner: BounceFilter, prefix: str) -> None:
    with pytest.raises(ConfigError, match="is no identifier; give a letter"):
        c_header(ExportedFilter.of(corner), prefix)


@pytest.mark.parametrize("processor", ["atmega328p", "atmega2560"])
def test_tables_can_be_kept_in_flash(corner: BounceFilter, processor: str, tmp_path: Path) -> None:
    exported = ExportedFilter.of(corner)
    program = (
        '#include "f.h"\nroom_state now;\n'
        "int main(void) { now = room_step(now, 1); return (int)room_colour(now) + room_place(now, 0).row + room_size(now); }\n"
    )
    used = avr.sections(avr.compiled_for(processor, "__flash", c_header(exported, "room"), program, tmp_path, "-c"))
    in_flash = sum(size for name, size in used.items() if name.startswith(".progmem"))
    assert in_flash > CTables.of(exported, "room").stepping_bytes
    assert sum(size for name, size in used.items() if name.startswith((".data", ".rodata"))) == 0


def random_table(count: int) -> FilterTable:
    """A filter of so many states, which lead anywhere."""
    chooser = np.random.default_rng(count)
    successors = np.vstack([chooser.integers(0, count, (count, 2)), [[count, count]]]).astype(np.int32)
    colours = np.append(chooser.integers(1, 8, count), 9).astype(np.int32)
    return FilterTable(successors, colours, chooser.integers(1, 300, count + 1), np.ones(count + 1, dtype=np.uint64))


@pytest.mark.parametrize(("states", "processor", "flash"), [(9_000, "atmega2560", "__flash"), (24_000, "atmega2560", "__memx")])
def test_tables_that_are_too_large_for_one_array_run_on_an_avr(states: int, processor: str, flash: str, tmp_path: Path) -> None:
    table = random_table(states)
    header = c_header(ExportedFilter(table, None, small_filter().setting), "room")
    stream = np.random.default_rng(1).integers(0, 2, 300).tolist()
    program = avr.compiled_for(processor, flash, header, avr.REPLAY % ",".join(map(str, stream)), tmp_path)
    assert avr.sections(program)[".text"] > 2 * 2 * states
    assert avr.run_on(processor, program) == expected(table, [stream])


def test_tables_that_are_too_large_for_one_array_are_compiled_for_the_smallest_avr(tmp_path: Path) -> None:
    header = c_header(ExportedFilter(random_table(9_000), None, small_filter().setting), "room")
    avr.compiled_for("atmega328p", "__flash", header, avr.REPLAY % "0, 1", tmp_path, "-c")


@pytest.mark.slow
@pytest.mark.parametrize("compiler", COMPILERS)
def test_tables_in_pieces_tell_the_same(made: BounceFilter, compiler: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(c_array, "LARGEST_BYTES", 7)
    exported = ExportedFilter.of(made)
    header = c_header(exported, "room")
    for name in ("next", "colours", "sizes", "environments", "place_starts", "places", "place_rows", "class_starts", "class_headings"):
        assert f"room_{name}_at(" in header
    streams = random_streams()
    assert replayed(compiled(compiler, header, REPLAY, tmp_path), streams) == expected(exported.table, streams)
    check_places(made, compiled(compiler, header, PLACES, tmp_path))
