"""A filter as hardware: a memory image for ``$readmemh``, and a small module that reads it."""

import re
from dataclasses import dataclass

import numpy as np

from ial.bouncing.automata.table import FilterTable
from ial.bouncing.exports.exported_filter import ExportedFilter
from ial.bouncing.exports.identifier import check_identifier
from ial.errors import ConfigError

_MODULE = """\
module {prefix}_filter #(
    parameter IMAGE = "{image}"
) (
    input  wire clk,
    input  wire reset,   // at a rising edge of clk: nothing is known any more
    input  wire step,    // at a rising edge of clk: an observation was made
    input  wire bump,    // whether it was a bump
    output reg  [{state}:0] state,
    output wire [{colour}:0] colour,  // 1 until the robot is localized, then 2 + number of the knowledge cycle
    output wire trapped  // the observations fit no place{trap_says}
);
    // Each word: the state after a bump, the state after a step without one, the colour. The word is read together with the
    // state it belongs to, so that the memory can be a block RAM.
    reg [{word}:0] memory [0:{trap}];
    reg [{word}:0] now;
    wire [{state}:0] next = reset ? {bits}'d0 : !step ? state : bump ? now[{bump_high}:{bump_low}] : now[{free_high}:{free_low}];

    initial $readmemh(IMAGE, memory);

    always @(posedge clk) begin
        state <= next;
        now <= memory[next];
    end

    assign colour = now[{colour}:0];
    assign trapped = state == {bits}'d{trap};
endmodule
"""


@dataclass(frozen=True)
class WordLayout:
    """How many bits of a word of the memory image stand for what.

    Parameters
    ----------
    state_bits
        The width of a state; a word has two, that after a bump in the highest bits.
    colour_bits
        The width of a colour, in the lowest bits.
    """

    state_bits: int
    colour_bits: int

    @classmethod
    def of(cls, table: FilterTable) -> "WordLayout":
        """Return the narrowest words for a table."""
        return cls(table.trap.bit_length(), int(table.colours.max()).bit_length())

    @property
    def bits(self) -> int:
        """The width of a word."""
        return 2 * self.state_bits + self.colour_bits


def memory_image(exported: ExportedFilter) -> str:
    """Return the words of all states in hexadecimal, one a line, the trap last."""
    table = exported.table
    layout = WordLayout.of(table)
    digits = -(-layout.bits // 4)
    free, bump = table.successors.T.astype(object)  # Python's integers: a word can have more than 64 bits
    words = (bump << layout.state_bits | free) << layout.colour_bits | table.colours.astype(object)
    lines = [f"// {line}" for line in exported.about()]
    return "\n".join([*lines, *(f"{word:0{digits}x}" for word in np.asarray(words).tolist())]) + "\n"


def verilog_module(exported: ExportedFilter, image: str, prefix: str = "bounce") -> str:
    """Return the text of a synthesizable module, Verilog 2001.

    Parameters
    ----------
    exported
        The filter.
    image
        The name of the file with the memory image.
    prefix
        The module is called ``prefix_filter``.

    Raises
    ------
    ConfigError
        If the prefix is no identifier, or the name of the image cannot stand in the text of a module.
    """
    check_identifier(prefix)
    if not re.fullmatch(r"[\w.+ -]+", image, re.ASCII):
        raise ConfigError(f"the file name {image!r} cannot stand in Verilog; give one of letters, digits, dots, hyphens and underscores")
    table = exported.table
    layout = WordLayout.of(table)
    restarts = bool(table.successors[table.trap, 0] != table.trap)
    text = _MODULE.format(
        prefix=prefix,
        image=image,
        bits=layout.state_bits,
        state=layout.state_bits - 1,
        colour=layout.colour_bits - 1,
        word=layout.bits - 1,
        bump_high=layout.bits - 1,
        bump_low=layout.state_bits + layout.colour_bits,
        free_high=layout.state_bits + layout.colour_bits - 1,
        free_low=layout.colour_bits,
        trap=table.trap,
        trap_says="; the next step starts anew" if restarts else ", until reset",
    )
    return "".join(f"// {line}\n" for line in ("Written by ial.", *exported.about())) + text
