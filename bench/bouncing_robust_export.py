"""Every export of filters for robots with errors, replayed against Python on random streams."""

import io
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path

import numpy as np
import numpy.typing as npt
from bouncing_export import COMPILER, REPLAY, streams
from report import Report, options

sys.path.append(str(Path(__file__).parents[1]))  # rooms and readers are those of the tests

from ial.bouncing.automata.table import FilterTable
from ial.bouncing.cells.headings import Headings
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.exports.archive import plain_archive
from ial.bouncing.exports.c_source import c_header
from ial.bouncing.exports.csv_table import csv_text
from ial.bouncing.exports.dot import dot_text
from ial.bouncing.exports.exported_filter import ExportedFilter
from ial.bouncing.exports.finite_automaton import FiniteAutomaton
from ial.bouncing.exports.jflap import jff_text, read_jff
from ial.bouncing.exports.piece_source import PieceTables, c_piece_header
from ial.bouncing.exports.verilog import WordLayout, memory_image, verilog_module
from ial.bouncing.filters.goal import Goal
from ial.bouncing.filters.robust_building import build_robust_filter
from ial.bouncing.rays.piece_map import PieceMap
from ial.bouncing.rays.piece_model import PieceModel
from tests.bouncing.exports.test_dot import drawn
from tests.bouncing.exports.test_piece_source import REPLAY as PIECE_REPLAY
from tests.bouncing.exports.test_piece_source import expected
from tests.bouncing.exports.test_verilog import BENCH
from tests.bouncing.judged_runs import ARMS, WORLDS

Array = npt.NDArray[np.integer]

ABOUT = """\
The robust filter of two corridors (a disk of 0.4 m, turns ± 1°, steps ± 1 %), in every form that `ial bounce export` knows, and pieces of
walls (turns ± 2°, steps ± 2 %, counts ± 1) in C. Every other random stream is possible as far as the filter can tell; the others are so up
to a random observation. The states after all observations are compared one by one; of pieces how many are held, which, and in which
rectangle."""

SOME = ExecutionBounds(Fraction(2), Fraction(1, 50), 1)


def arms() -> ExportedFilter:
    """Return the robust filter of the corridors."""
    headings = Headings.of_angle(Fraction(90), 24, Fraction(4))
    errors = ExecutionBounds(Fraction(1), Fraction(1, 100), 0)
    made = build_robust_filter({"arms": ARMS}, headings, Fraction(1, 2), Goal(width=Fraction(2)), errors, Fraction(2, 5), 4000)
    return ExportedFilter.of(made)


def after(successors: Array, seen: npt.NDArray[np.uint8]) -> Array:
    """Return the states after all observations of all streams, by a table of successors."""
    states = np.zeros(len(seen), dtype=np.int64)
    columns = []
    for at in range(seen.shape[1]):
        states = successors[states, seen[:, at]]
        columns.append(states)
    return np.stack(columns, axis=1)


def in_c(exported: ExportedFilter, seen: npt.NDArray[np.uint8], folder: Path) -> Array:
    """Return the states that the compiled header goes through."""
    (folder / "filter.h").write_text(c_header(exported, "room"))
    (folder / "replay.c").write_text(REPLAY)
    subprocess.run([*COMPILER, "-std=gnu99", "-O2", "replay.c", "-o", "replay"], cwd=folder, check=True)
    done = subprocess.run([folder / "replay", *map(str, seen.shape)], input=seen.tobytes(), capture_output=True, check=True)
    return np.frombuffer(done.stdout, dtype=np.uint8 if len(exported.table) <= 256 else np.uint16).reshape(seen.shape)


def in_verilog(exported: ExportedFilter, seen: npt.NDArray[np.uint8], folder: Path) -> Array:
    """Return the states that the simulated module goes through."""
    resets = np.column_stack([np.full(len(seen), 4, dtype=np.uint8), seen | 2])
    (folder / "stimuli.txt").write_text("\n".join(f"{word:03b}" for word in resets.reshape(-1).tolist()) + "\n")
    (folder / "room.hex").write_text(memory_image(exported))
    (folder / "room.v").write_text(verilog_module(exported, "room.hex", "room"))
    layout = WordLayout.of(exported.table)
    (folder / "bench.v").write_text(BENCH.format(last=resets.size - 1, state=layout.state_bits - 1, colour=layout.colour_bits - 1))
    subprocess.run(["iverilog", "-g2001", "-o", "run", "bench.v", "room.v"], cwd=folder, check=True)
    done = subprocess.run(["vvp", "run"], cwd=folder, capture_output=True, text=True, check=True)
    states = [int(line.split()[0]) for line in done.stdout.splitlines() if "$finish" not in line]
    return np.array(states).reshape(resets.shape)[:, 1:]


def by_csv(exported: ExportedFilter) -> Array:
    """Return the successors that a spreadsheet reads."""
    return np.loadtxt(io.StringIO(csv_text(exported.table)), dtype=np.int64, delimiter=",", skiprows=1)[:, 1:3]


def by_dot(exported: ExportedFilter) -> Array:
    """Return the successors that are drawn."""
    _, arcs = drawn(dot_text(exported))
    return np.array([[arcs[state, letter] for letter in (0, 1)] for state in range(len(exported.table))])


def by_jff(exported: ExportedFilter, folder: Path) -> Array:
    """Return the successors that JFLAP reads."""
    (folder / "filter.jff").write_text(jff_text(FiniteAutomaton.of_table(exported.table)))
    arcs = {(state, text): to for state, text, to in read_jff(folder / "filter.jff").transitions}
    return np.array([[arcs[state, letter] for letter in "01"] for state in range(len(exported.table))])


def by_npz(exported: ExportedFilter) -> Array:
    """Return the successors that NumPy reads."""
    with np.load(io.BytesIO(plain_archive(exported)), allow_pickle=False) as arrays:
        return np.asarray(arrays["next"])


def tables(folder: Path, count: int, length: int) -> Iterator[tuple[str, ...]]:
    """Yield how many streams differ in each form of the table."""
    exported = arms()
    table: FilterTable = exported.table
    seen = streams(table, count, length, 2)
    wanted = np.array([table.run(stream) for stream in seen.tolist()])
    trapped = f"{int((wanted == table.trap).any(axis=1).sum()):,}"
    forms = {
        "csv": lambda: after(by_csv(exported), seen),
        "dot": lambda: after(by_dot(exported), seen),
        "jff": lambda: after(by_jff(exported, folder), seen),
        "npz": lambda: after(by_npz(exported), seen),
        "c, gcc": lambda: in_c(exported, seen, folder),
    }
    if shutil.which("iverilog"):
        forms["verilog, iverilog"] = lambda: in_verilog(exported, seen, folder)
    for name, replayed in forms.items():
        different = int((replayed() != wanted).any(axis=1).sum())
        yield f"{len(table)} states, {name}", f"{count:,} × {length}", trapped, str(different)


def piece_streams(made: PieceMap, count: int, length: int, seed: int) -> list[list[int]]:
    """Return random observations: every other stream never traps, the others need not make sense from somewhere on."""
    chooser, model, all_seen = np.random.default_rng(seed), PieceModel(made), []
    for number in range(count):
        sensible, share = length if number % 2 else int(chooser.integers(length)), 0.4 * chooser.random()
        states, seen = model.universe(), []
        for at in range(length):
            bump = int(chooser.random() < share)
            if not model.empty(states):
                after_it = model.step(states, None, bump)
                if model.empty(after_it) and at < sensible:
                    bump, after_it = 1 - bump, model.step(states, None, 1 - bump)
                states = after_it
            seen.append(bump)
        all_seen.append(seen)
    return all_seen


def pieces(folder: Path, count: int, length: int) -> Iterator[tuple[str, ...]]:
    """Yield how many streams differ in the header of pieces, for a point and a disk."""
    for world, radius in (("L", Fraction(0)), ("L", Fraction(2, 5)), ("corridors", Fraction(3, 5))):
        made = PieceMap.of(WORLDS[world], Fraction(100), Fraction(1, 2), SOME, Fraction(1), 32, radius)
        (folder / "f.h").write_text(c_piece_header(made, "room"))
        (folder / "pieces.c").write_text(PIECE_REPLAY)
        subprocess.run([*COMPILER, "-std=c99", "-O2", "pieces.c", "-o", "pieces"], cwd=folder, check=True)
        different = trapped = 0
        for seed, begin in enumerate(range(0, count, 1000)):
            some = piece_streams(made, min(1000, count - begin), length, seed)
            text = "".join("".join(map(str, stream)) + "\n" for stream in some)
            done = subprocess.run([folder / "pieces"], input=text, capture_output=True, text=True, check=True)
            rows = np.array([[int(word) for word in re.split(r"\s+", line)] for line in done.stdout.splitlines()])
            wanted = np.array(expected(made, some))
            shape = len(some), length, -1
            different += int((rows != wanted).reshape(shape).any(axis=(1, 2)).sum())
            trapped += int((wanted[:, 0] == 0).reshape(len(some), length).any(axis=1).sum())
        name = f"{len(made)} pieces, {world}, radius {float(radius):g} m; c, gcc"
        yield name, f"{count:,} × {length}", f"{trapped:,}", str(different)


ALL_FUNCTIONS = """\
#include "f.h"
static room_filter now;
void begin(void);
void begin(void) { room_start(&now); }
int update(int bump);
int update(int bump) { return room_update(&now, bump); }
uint32_t count(void);
uint32_t count(void) { return room_count(&now); }
int box(room_box_t *where);
int box(room_box_t *where) { return room_box(&now, where); }
"""
PROCESSORS = {
    "ATmega2560": ("avr-gcc", "-std=gnu99", "-mmcu=atmega2560", "-DROOM_FLASH=__memx"),
    "Cortex-M0": ("arm-none-eabi-gcc", "-std=c99", "-mcpu=cortex-m0", "-mthumb"),
    "Cortex-M4": ("arm-none-eabi-gcc", "-std=c99", "-mcpu=cortex-m4", "-mthumb"),
}


def code_bytes(folder: Path, compiler: str, *arguments: str) -> str:
    """Return the bytes of all functions of a header, without its tables."""
    if shutil.which(compiler) is None:
        return "–"
    subprocess.run([compiler, *arguments, "-Os", "-c", "functions.c", "-o", "functions.o"], cwd=folder, check=True)
    listed = subprocess.run([compiler.replace("gcc", "size"), "-A", "functions.o"], cwd=folder, check=True, capture_output=True, text=True)
    found = re.findall(r"^[.]text[^0-9]*([0-9]+)", listed.stdout, re.MULTILINE)
    return f"{sum(map(int, found)):,}"


def sizes(folder: Path) -> Iterator[tuple[str, ...]]:
    """Yield what headers of pieces take."""
    (folder / "functions.c").write_text(ALL_FUNCTIONS)
    for world, radius in (("L", Fraction(0)), ("hall", Fraction(0)), ("hall", Fraction(1, 5))):
        for part, headings in ((Fraction(1, 2), 36), (Fraction(1, 4), 72)):
            made = PieceMap.of(WORLDS[world], Fraction(100), Fraction(1, 4), SOME, part, headings, radius)
            (folder / "f.h").write_text(c_piece_header(made, "room"))
            tables = PieceTables.of(made, "room")
            code = [code_bytes(folder, *how) for how in PROCESSORS.values()]
            robot = f"{world}, a disk of {float(radius):g} m" if radius else world
            yield robot, f"{part} m, {headings} headings", f"{len(made):,}", f"{tables.flash_bytes:,}", f"{tables.ram_bytes:,}", *code


def main() -> None:
    """Measure, print, and write."""
    parser = options(__doc__ or "")
    parser.add_argument("--streams", type=int, default=100_000, metavar="N", help="how many random streams of each export")
    chosen = parser.parse_args()
    if shutil.which("gcc") is None:
        sys.exit("gcc is needed; install it")
    report = Report("Exports of filters for robots with errors", ABOUT)
    head = ("filter", "streams", "that trap", "that differ")
    with tempfile.TemporaryDirectory() as name:
        report.table(head, tables(Path(name), chosen.streams, 40))
        report.table(head, pieces(Path(name), chosen.streams, 24))
        report.say("What headers of pieces take, in bytes: -Os, steps of 1/4 m.\n")
        report.table(("room", "grid", "pieces", "flash, tables", "RAM", *(f"code, {each}" for each in PROCESSORS)), sizes(Path(name)))
    report.write(chosen.out)


if __name__ == "__main__":
    main()
