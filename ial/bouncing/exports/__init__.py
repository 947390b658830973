"""Filters for microcontrollers, hardware, and other tools.

Names are loaded when they are first used.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ial.bouncing.exports.archive import plain_archive as plain_archive
    from ial.bouncing.exports.archive import plain_piece_archive as plain_piece_archive
    from ial.bouncing.exports.automata_lib import to_automata as to_automata
    from ial.bouncing.exports.c_source import c_header as c_header
    from ial.bouncing.exports.c_tables import CTables as CTables
    from ial.bouncing.exports.csv_table import csv_text as csv_text
    from ial.bouncing.exports.dot import dot_text as dot_text
    from ial.bouncing.exports.exported_filter import ExportedFilter as ExportedFilter
    from ial.bouncing.exports.finite_automaton import FiniteAutomaton as FiniteAutomaton
    from ial.bouncing.exports.formats import export as export
    from ial.bouncing.exports.jflap import jff_text as jff_text
    from ial.bouncing.exports.jflap import read_jff as read_jff
    from ial.bouncing.exports.piece_source import PieceTables as PieceTables
    from ial.bouncing.exports.piece_source import c_piece_header as c_piece_header
    from ial.bouncing.exports.verilog import memory_image as memory_image
    from ial.bouncing.exports.verilog import verilog_module as verilog_module
else:
    from ial.lazy import lazy as _lazy

    __getattr__, __dir__, __all__ = _lazy(
        __name__,
        {
            "automata_lib": ("to_automata",),
            "c_source": ("c_header",),
            "c_tables": ("CTables",),
            "csv_table": ("csv_text",),
            "dot": ("dot_text",),
            "formats": ("export",),
            "exported_filter": ("ExportedFilter",),
            "finite_automaton": ("FiniteAutomaton",),
            "jflap": ("jff_text", "read_jff"),
            "archive": ("plain_archive", "plain_piece_archive"),
            "piece_source": ("PieceTables", "c_piece_header"),
            "verilog": ("memory_image", "verilog_module"),
        },
    )
