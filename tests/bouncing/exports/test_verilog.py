import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from ial.bouncing.automata.table import FilterTable
from ial.bouncing.exports.exported_filter import ExportedFilter
from ial.bouncing.exports.verilog import WordLayout, memory_image, verilog_module
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.errors import ConfigError
from tests.bouncing.exports.rooms import own_streams, random_streams

BENCH = """\
`timescale 1ns / 1ns
module bench;
    // Stimuli: reset, step, bump; what is read after each rising edge is printed.
    reg [2:0] stimuli [0:{last}];
    reg clk = 0, reset = 1, step = 0, bump = 0;
    wire [{state}:0] state;
    wire [{colour}:0] colour;
    wire trapped;
    integer at;
    room_filter under_test(.clk(clk), .reset(reset), .step(step), .bump(bump), .state(state), .colour(colour), .trapped(trapped));
    initial begin
        $readmemb("stimuli.txt", stimuli);
        for (at = 0; at <= {last}; at = at + 1) begin
            {{reset, step, bump}} = stimuli[at];
            #1 clk = 1;
            #1 $display("%0d %0d %0d", state, colour, trapped);
            clk = 0;
        end
        $finish;
    end
endmodule
"""


def words(image: str) -> list[int]:
    """The memory as `$readmemh` reads it."""
    return [int(line, 16) for line in image.splitlines() if not line.startswith("//")]


@pytest.mark.parametrize("restart", [False, True])
def test_the_image_holds_the_table(small: BounceFilter, restart: bool) -> None:
    table = ExportedFilter.of(small, restart=restart).table
    image = memory_image(ExportedFilter.of(small, restart=restart))
    layout = WordLayout.of(table)
    rows = []
    for word in words(image):
        assert word < 2**layout.bits
        colour, both = word % 2**layout.colour_bits, word >> layout.colour_bits
        rows.append((both % 2**layout.state_bits, both >> layout.state_bits, colour))
    assert rows == [(*row, colour) for row, colour in zip(table.successors.tolist(), table.colours.tolist(), strict=True)]
    assert {len(line) for line in image.splitlines() if not line.startswith("//")} == {-(-layout.bits // 4)}


def test_words_of_wide_colours(corner: BounceFilter) -> None:
    table = FilterTable(
        np.ones((2, 2), dtype=np.int32), np.array([1, 2**31 - 1], dtype=np.int32), np.array([1, 0]), np.array([1, 0], dtype=np.uint64)
    )
    assert words(memory_image(ExportedFilter(table, None, corner.setting))) == [(3 << 31) + 1, (3 << 31) + 2**31 - 1]


@pytest.mark.parametrize("restart", [False, True])
def test_the_module_steps_as_python_does(small: BounceFilter, restart: bool, tmp_path: Path) -> None:
    if shutil.which("iverilog") is None:
        pytest.skip("iverilog is not installed")
    exported = ExportedFilter.of(small, restart=restart)
    table = exported.table
    streams = own_streams(small)[::5] + random_streams(40)
    stimuli, expected = [], []

    def clock(reset: int, step: int, bump: int, state: int) -> None:
        stimuli.append(f"{reset}{step}{bump}")
        expected.append(f"{state} {table.colours[state]} {int(state == table.trap)}")

    for number, stream in enumerate(streams):
        clock(1, number % 2, 1, 0)  # reset wins over an observation
        state = 0
        for at, bump in enumerate(stream):
            state = table.step(state, bump)
            clock(0, 1, bump, state)
            if at % 7 == 0:
                clock(0, 0, 1 - bump, state)  # nothing was observed
    layout = WordLayout.of(table)
    (tmp_path / "room.hex").write_text(memory_image(exported))
    (tmp_path / "room.v").write_text(verilog_module(exported, "room.hex", "room"))
    (tmp_path / "stimuli.txt").write_text("\n".join(stimuli) + "\n")
    text = BENCH.format(last=len(stimuli) - 1, state=layout.state_bits - 1, colour=layout.colour_bits - 1)
    (tmp_path / "bench.v").write_text(text)
    made = subprocess.run(["iverilog", "-g2001", "-Wall", "-o", "run", "bench.v", "room.v"], cwd=tmp_path, capture_output=True, text=True)
    assert (made.returncode, [line for line in made.stderr.splitlines() if "timescale" not in line]) == (0, [])
    done = subprocess.run(["vvp", "run"], cwd=tmp_path, capture_output=True, text=True, check=True)
    lines = [line for line in done.stdout.splitlines() if "$finish" not in line]
    assert lines == expected
    assert any(line.endswith(" 1") for line in lines)


@pytest.mark.parametrize(("image", "prefix", "message"), [("a.hex", "1a", "no identifier"), ('a".hex', "a", "cannot stand in Verilog")])
def test_what_cannot_stand_in_a_module_is_refused(corner: BounceFilter, image: str, prefix: str, message: str) -> None:
    with pytest.raises(ConfigError, match=message):
        verilog_module(ExportedFilter.of(corner), image, prefix)
