"""Filters exported to C: bytes of flash and RAM, what the compiler makes of them, and streams replayed in C and in Python."""

import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path

import numpy as np
from report import Report, options
from timing import timed

from ial.bouncing.automata.table import FilterTable
from ial.bouncing.cells.headings import Headings
from ial.bouncing.exports.c_source import c_header
from ial.bouncing.exports.c_tables import CTables
from ial.bouncing.exports.exported_filter import ExportedFilter
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.bouncing.filters.building import build_filter
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.outline import outlines

ABOUT = """\
A room of 19 cells with 8 headings, 152 configurations, as the environments of the paper's tables; it is one of those in `bouncing.py`.
*Flash* and *RAM* are computed from the tables; *compiled* is what `size -A` says of a part of a program that only steps (`step` and
`colour`), and of one that uses every table. Every other random stream is possible in the room as far as the filter can tell; the others
are so up to a random observation, and after it zeros and ones with a share that varies from stream to stream. The states after all
observations are compared one by one."""

BLOCKED = [(0, 0), (0, 1), (0, 2), (3, 3), (4, 4), (2, 2)]
"""The blocked cells, (row, column), of 5 × 5."""

STEPPING = """\
#include "filter.h"
room_state now;
unsigned observe(int bump);
unsigned observe(int bump) { now = room_step(now, bump); return room_colour(now); }
"""
TELLING = """
unsigned many(void);
unsigned many(void) { return room_size(now) + (unsigned)room_environment_mask(now) + room_place_count(now); }
room_place_t place(unsigned char i);
room_place_t place(unsigned char i) { return room_place(now, i); }
unsigned heading(unsigned char i, unsigned char k);
unsigned heading(unsigned char i, unsigned char k) { return room_heading_count(place(i)) ? room_heading(place(i), k) : 0u; }
"""

REPLAY = """\
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include "filter.h"

/* replay COUNT LENGTH: observations, a byte each, on standard input; states, a byte each, on standard output; seconds on standard error */
int main(int argc, char **argv) {
    const size_t count = argc == 3 ? (size_t)atol(argv[1]) : 0, length = argc == 3 ? (size_t)atol(argv[2]) : 0;
    unsigned char *seen = malloc(count * length);
    room_state *states = malloc(count * length * sizeof(room_state));
    struct timespec begun, ended;
    size_t i, k;
    if (seen == NULL || states == NULL || fread(seen, 1, count * length, stdin) != count * length) {
        return 1;
    }
    clock_gettime(CLOCK_MONOTONIC, &begun);
    for (i = 0; i < count; i++) {
        room_state state = ROOM_START;
        for (k = 0; k < length; k++) {
            state = room_step(state, seen[i * length + k]);
            states[i * length + k] = state;
        }
    }
    clock_gettime(CLOCK_MONOTONIC, &ended);
    fprintf(stderr, "%.9f", (double)(ended.tv_sec - begun.tv_sec) + 1e-9 * (double)(ended.tv_nsec - begun.tv_nsec));
    return fwrite(states, sizeof(room_state), count * length, stdout) != count * length;
}
"""

COMPILER = ("gcc", "-Wall", "-Wextra", "-Wpedantic", "-Werror")
VARIANTS: tuple[tuple[str, dict[str, object]], ...] = (
    ("as it is", {}),
    ("restarting", {"restart": True}),
    ("minimized, colours", {"keep": "colours"}),
    ("minimized, localized", {"keep": "localized"}),
)


def room(angle: int) -> BounceFilter:
    """Return the filter of the room."""
    free = np.ones((5, 5), dtype=np.bool_)
    free[tuple(np.transpose(BLOCKED))] = False
    return build_filter({"room": Environment(outlines(free, Fraction(1)), Fraction(1))}, Headings.of_angle(Fraction(angle), 8))


def variants() -> Iterator[tuple[str, ExportedFilter]]:
    """Yield the filters by name."""
    for angle in (45, 135):
        made = room(angle)
        for name, changes in VARIANTS:
            yield f"{angle}°, {name}", ExportedFilter.of(made, **changes)  # type: ignore[arg-type]


def sections(folder: Path, program: str) -> str:
    """Return the bytes of text and of constants of a compiled part of a program."""
    (folder / "part.c").write_text(program)
    subprocess.run([*COMPILER, "-std=c99", "-Os", "-c", "part.c", "-o", "part.o"], cwd=folder, check=True)
    listed = subprocess.run(["size", "-A", "part.o"], cwd=folder, check=True, capture_output=True, text=True).stdout
    sizes = dict.fromkeys((".text", ".rodata", ".bss"), 0)
    for name, size in re.findall(r"^(\.[a-z]+)\S*\s+(\d+)", listed, re.MULTILINE):
        if name in sizes:
            sizes[name] += int(size)
    return f"{sizes['.text']} / {sizes['.rodata']} / {sizes['.bss']}"


def sizes(folder: Path) -> Iterator[tuple[str, ...]]:
    """Yield the memory that filters take."""
    for name, exported in variants():
        (folder / "filter.h").write_text(c_header(exported, "room"))
        tables = CTables.of(exported, "room")
        everything = "–" if exported.places is None else sections(folder, STEPPING + TELLING)
        computed = (f"{tables.stepping_bytes:,}", f"{tables.flash_bytes:,}", str(tables.ram_bytes))
        yield name, str(len(exported.table)), *computed, sections(folder, STEPPING), everything


def streams(table: FilterTable, count: int, length: int, seed: int) -> np.typing.NDArray[np.uint8]:
    """Return random observations, a stream in each row: every other one never traps, the others need not make sense from somewhere on."""
    chooser = np.random.default_rng(seed)
    seen = (chooser.random((count, length)) < chooser.random((count, 1))).astype(np.uint8)
    sensible = np.where(np.arange(count) % 2, length, chooser.integers(0, length, count))
    state = np.zeros(count, dtype=np.int64)
    for at in range(length):
        seen[:, at] ^= (table.successors[state, seen[:, at]] == table.trap) & (at < sensible)
        state = table.successors[state, seen[:, at]]
    return seen


def python_states(table: FilterTable, seen: np.typing.NDArray[np.uint8]) -> np.typing.NDArray[np.int64]:
    """Return the states after each observation."""
    return np.array([table.run(stream) for stream in seen.tolist()])


def replays(folder: Path, count: int, length: int) -> Iterator[tuple[str, ...]]:
    """Yield how streams are replayed."""
    for name, exported in variants():
        seen = streams(exported.table, count, length, 1)
        (folder / "filter.h").write_text(c_header(exported, "room"))
        (folder / "replay.c").write_text(REPLAY)
        subprocess.run([*COMPILER, "-std=gnu99", "-O2", "replay.c", "-o", "replay"], cwd=folder, check=True)
        times = []
        for _ in range(5):
            done = subprocess.run([folder / "replay", str(count), str(length)], input=seen.tobytes(), capture_output=True, check=True)
            times.append(float(done.stderr))
        replayed = np.frombuffer(done.stdout, dtype=np.uint8).reshape(seen.shape)
        seconds, states = timed(python_states, exported.table, seen, runs=1)
        different = int((states != replayed).any(axis=1).sum())
        trapped = int((states == exported.table.trap).any(axis=1).sum())
        if different:
            sys.exit(f"{name}: {different} streams differ")
        visited = f"{len(np.unique(np.append(states, 0)))} of {len(exported.table)}"
        fast, slow = seen.size / min(times) / 1e6, seen.size / seconds / 1e6
        yield name, f"{count:,} × {length}", str(different), f"{trapped:,}", visited, f"{fast:.0f}", f"{slow:.2f}", f"{fast / slow:.0f}"


def main() -> None:
    """Measure, print, and write."""
    parser = options(__doc__ or "")
    parser.add_argument("--streams", type=int, default=100_000, metavar="N", help="how many random streams")
    parser.add_argument("--length", type=int, default=64, metavar="N", help="observations of each")
    chosen = parser.parse_args()
    if shutil.which("gcc") is None or shutil.which("size") is None:
        sys.exit("gcc and size (binutils) are needed; install them")
    report = Report("The bouncing robot, exported to C", ABOUT)
    compiler = subprocess.run(["gcc", "--version"], capture_output=True, text=True, check=True).stdout.splitlines()[0]
    report.say(f"{compiler}, -Os: bytes of .text / .rodata / .bss. Flash and RAM in bytes.\n")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        head = ("filter", "states with trap", "flash, stepping", "flash, all", "RAM", "compiled, stepping", "compiled, all")
        report.table(head, sizes(folder))
        report.say("Random streams from the start, million observations per second, one thread; C with -O2 is the best of five runs.\n")
        head = ("filter", "streams", "that differ", "that trap", "states visited", "C", "Python's FilterTable", "times as fast")
        report.table(head, replays(folder, chosen.streams, chosen.length))
    report.write(chosen.out)


if __name__ == "__main__":
    main()
