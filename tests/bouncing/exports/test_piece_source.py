import subprocess
from dataclasses import replace
from fractions import Fraction
from itertools import islice
from pathlib import Path

import numpy as np
import pytest

from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.exports import c_array
from ial.bouncing.exports.piece_source import PieceTables, c_piece_header
from ial.bouncing.rays.first_bump import FirstBumps
from ial.bouncing.rays.legs import Legs
from ial.bouncing.rays.piece_map import PieceMap
from ial.bouncing.rays.piece_model import PieceModel
from ial.bouncing.rays.real_robot import RealRobot
from ial.bouncing.start import Start
from ial.errors import ConfigError, FilterError
from tests.bouncing.exports import avr
from tests.bouncing.exports.rooms import random_streams
from tests.bouncing.exports.test_c_source import COMPILERS, compiled
from tests.bouncing.judged_runs import WORLDS
from tests.bouncing.rays.test_real_robot import ROOM

SOME = ExecutionBounds(Fraction(2), Fraction(1, 50), 1)

REPLAY = """\
#include <stdio.h>
#include "f.h"

static room_filter now;

int main(void) {
    int letter;
    room_start(&now);
    while ((letter = getchar()) != EOF) {
        room_box_t box = {0, 0, 0, 0};
        unsigned long sum = 0;
        unsigned i;
        if (letter == '\\n') {
            room_start(&now);
            continue;
        }
        printf("%d", room_update(&now, letter == '1'));
        printf(" %lu", (unsigned long)room_count(&now));
        for (i = 0; i < ROOM_PIECES; i++) {
            sum = (sum + (now.held[i / 8u] >> (i & 7u) & 1u) * (unsigned long)(i + 1u) * (i + 7u)) % 1000003u;
        }
        printf(" %lu %d", sum, room_box(&now, &box));
        printf(" %lu %lu %lu %lu\\n", (unsigned long)box.x0, (unsigned long)box.y0, (unsigned long)box.x1, (unsigned long)box.y1);
    }
    return 0;
}
"""


@pytest.fixture(scope="module")
def room() -> PieceMap:
    """Pieces that fill no whole number of bytes."""
    made = PieceMap.of(ROOM, Fraction(-110), Fraction(1, 4), SOME, Fraction(1, 2), 33)
    assert len(made) % 8
    return made


def own_streams(environment: str, count: int, steps: int, radius: Fraction = Fraction(0)) -> list[list[int]]:
    """What robots with errors observe."""
    robots = (RealRobot(WORLDS[environment], Fraction(100), Fraction(1, 4), radius, SOME, seed) for seed in range(count))
    return [[pose.observation for pose in islice(robot.run(), steps)] for robot in robots]


def expected(map_: PieceMap, streams: list[list[int]], first: FirstBumps | None = None) -> list[list[int]]:
    """What the set filter says in Python."""
    model, boxes, parts = PieceModel(map_, first), map_.boxes_mm, int(map_.parts.sum())
    rows = []
    for stream in streams:
        states = model.universe()
        for observation in stream:
            states = states if model.empty(states) else model.step(states, None, observation)
            bumped = len(states) > 0 and states.pieces[0] >= 0
            pieces = states.pieces[states.pieces >= 0].astype(np.int64)
            held = boxes[pieces % parts]
            box = [*held[:, :2].min(axis=0), *held[:, 2:].max(axis=0)] if bumped else [0] * 4
            count = len(pieces) if bumped or not len(states) else len(map_)
            checksum = int(((pieces + 1) * (pieces + 7)).sum()) % 1000003
            rows.append([int(len(states) > 0), count, checksum, int(bumped), *map(int, box)])
    return rows


def replayed(program: Path, streams: list[list[int]]) -> list[list[int]]:
    """The rows that the program prints, for all streams, one after the other."""
    text = "".join("".join(map(str, stream)) + "\n" for stream in streams)
    done = subprocess.run([program], input=text, capture_output=True, text=True, check=True)
    return [[int(word) for word in line.split()] for line in done.stdout.splitlines()]


@pytest.mark.slow
@pytest.mark.parametrize("compiler", COMPILERS)
def test_sets_in_c_are_those_in_python(room: PieceMap, compiler: str, tmp_path: Path) -> None:
    streams = [stream[:40] for stream in random_streams(200)]
    rows = replayed(compiled(compiler, c_piece_header(room, "room"), REPLAY, tmp_path), streams)
    wanted = expected(room, streams)
    assert rows == wanted
    trapped = np.array([row[0] for row in wanted]) == 0
    assert trapped.any()
    assert not trapped.all()


@pytest.mark.slow
@pytest.mark.parametrize(("world", "radius"), [("hall", Fraction(0)), ("hall", Fraction(1, 2)), ("corridors", Fraction(3, 5))])
def test_robots_with_errors_are_followed_in_c(tmp_path: Path, world: str, radius: Fraction) -> None:
    """Among them disks wider than the corridors, so that there are parts of walls where none can stand."""
    made = PieceMap.of(WORLDS[world], Fraction(100), Fraction(1, 4), SOME, Fraction(1, 2), 36, radius)
    assert (np.diff(made.starts) == 0).any() == (world == "corridors")
    streams = own_streams(world, 12, 150, radius)
    rows = replayed(compiled("gcc", c_piece_header(made, "room"), REPLAY, tmp_path), streams)
    assert rows == expected(made, streams)
    assert all(row[0] for row in rows)
    assert min(row[1] for row in rows) < 200


@pytest.mark.slow
def test_a_start_of_which_something_is_known_is_the_same_in_c(room: PieceMap, tmp_path: Path) -> None:
    made = PieceMap.of(WORLDS["hall"], Fraction(100), Fraction(1, 4), SOME, Fraction(1, 2), 36)
    legs = Legs(made.walls, Fraction(100), Fraction(1, 4), SOME)
    first = FirstBumps.of(made, legs, Start((Fraction(1), Fraction(1), Fraction(2), Fraction(2)), ((Fraction(0), Fraction(20)),)))
    streams = [*random_streams(60), *([int(at == count) for at in range(count + 1)] for count in range(60))]
    rows = replayed(compiled("gcc", c_piece_header(made, "room", first), REPLAY, tmp_path), streams)
    wanted = expected(made, streams, first)
    assert rows == wanted
    assert {row[0] for row in wanted} == {0, 1}


@pytest.mark.slow
def test_tables_in_pieces_tell_the_same(room: PieceMap, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(c_array, "LARGEST_BYTES", 63)
    header = c_piece_header(room, "room")
    assert "room_starts_at(" in header
    streams = [stream[:30] for stream in random_streams(40)]
    assert replayed(compiled("gcc", header, REPLAY, tmp_path), streams) == expected(room, streams)


AVR_REPLAY = avr.REPLAY.replace("    room_state state = ROOM_START;\n", "").replace("int main", "static room_filter now;\n\nint main")
AVR_REPLAY = AVR_REPLAY[: AVR_REPLAY.index("        state = room_step")] + (
    "        number((uint32_t)room_update(&now, seen[i]));\n        number(room_count(&now));\n        put('\\n');\n"
    + AVR_REPLAY[AVR_REPLAY.index("    }\n    cli();") :]
)
AVR_REPLAY = AVR_REPLAY.replace("    UCSR0B", "    room_start(&now);\n    UCSR0B")


def test_a_microcontroller_follows_a_robot_with_errors(tmp_path: Path) -> None:
    made = PieceMap.of(WORLDS["hall"], Fraction(100), Fraction(1, 4), SOME, Fraction(1, 2), 36)
    (stream,) = own_streams("hall", 1, 120)
    program = avr.compiled_for("atmega2560", "__flash", c_piece_header(made, "room"), AVR_REPLAY % ",".join(map(str, stream)), tmp_path)
    sections = avr.sections(program)
    tables = PieceTables.of(made, "room")
    assert sections[".text"] > sum(tables.arrays[name].size for name in ("starts", "ends", "least", "most", "longest"))
    assert sections[".bss"] == tables.ram_bytes
    assert avr.run_on("atmega2560", program) == [row[:2] for row in expected(made, [stream])]


def test_bytes_are_those_of_the_compiler(room: PieceMap, tmp_path: Path) -> None:
    tables = PieceTables.of(room, "room")
    names = " + ".join(f"sizeof({each.name})" for each in tables.arrays.values())
    program = f'#include <stdio.h>\n#include "f.h"\nint main(void) {{ printf("%lu %lu", (unsigned long)({names}), '
    program += "(unsigned long)sizeof(room_filter)); return 0; }\n"
    done = subprocess.run([compiled("gcc", c_piece_header(room, "room"), program, tmp_path)], capture_output=True, text=True, check=True)
    assert done.stdout == f"{tables.flash_bytes} {tables.ram_bytes}"


def test_steps_that_do_not_fit_the_counter_are_refused(room: PieceMap) -> None:
    c_piece_header(replace(room, most=np.minimum(room.most, 1) * 65_534), "room")
    with pytest.raises(FilterError, match="65535 steps between two bumps"):
        c_piece_header(replace(room, most=np.minimum(room.most, 1) * 65_535), "room")


def test_what_is_no_identifier_is_refused(room: PieceMap) -> None:
    with pytest.raises(ConfigError, match="is no identifier"):
        c_piece_header(room, "a b")
