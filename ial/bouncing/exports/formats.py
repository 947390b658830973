"""The formats of exports, and `export`: a filter as the files of another program."""

from collections.abc import Mapping
from pathlib import Path
from typing import Literal, get_args

from ial.bouncing.exports.archive import plain_archive, plain_piece_archive
from ial.bouncing.exports.c_source import c_header
from ial.bouncing.exports.csv_table import csv_text
from ial.bouncing.exports.dot import dot_text
from ial.bouncing.exports.exported_filter import ExportedFilter
from ial.bouncing.exports.finite_automaton import FiniteAutomaton
from ial.bouncing.exports.jflap import jff_text
from ial.bouncing.exports.piece_source import PieceTables, c_piece_header
from ial.bouncing.exports.verilog import memory_image, verilog_module
from ial.bouncing.filters.piece_filter import PieceFilter
from ial.errors import ConfigError
from ial.whole_file import whole_files

Format = Literal["c", "verilog", "dot", "jff", "csv", "npz"]

_SUFFIXES: Mapping[str, Format] = {
    ".h": "c",
    ".v": "verilog",
    ".dot": "dot",
    ".gv": "dot",
    ".jff": "jff",
    ".csv": "csv",
    ".npz": "npz",
}


def format_of(path: Path) -> Format:
    """Return the format that the suffix of a file stands for.

    Raises
    ------
    ConfigError
        If it stands for none.
    """
    try:
        return _SUFFIXES[path.suffix.lower()]
    except KeyError:
        raise ConfigError(
            f"{path}: no format has the suffix {path.suffix!r}; use one of {', '.join(_SUFFIXES)}, or name the format: "
            f"{', '.join(get_args(Format))}"
        ) from None


def files_of(path: Path, form: Format) -> list[Path]:
    """Return the files that an export consists of: the given one, and for Verilog the memory image, with the suffix ``.hex``.

    Raises
    ------
    ConfigError
        If the two would be the same.
    """
    if form != "verilog":
        return [path]
    image = path.with_suffix(".hex")
    if image == path:
        raise ConfigError(f"{path}: the memory image gets the suffix .hex; give the module another one, such as .v")
    return [path, image]


def export(
    exported: ExportedFilter, path: str | Path, form: Format | None = None, prefix: str = "bounce", force: bool = False
) -> list[Path]:
    """Write a filter for another program; files appear when all of them are complete.

    Parameters
    ----------
    exported
        The filter.
    path
        The file to write; see `files_of` for those beside it.
    form
        The format; that of the suffix if it is None.
    prefix
        What names in C and Verilog begin with.
    force
        Whether to draw a graph that nobody can read.

    Returns
    -------
    list of Path
        The files that were written.

    Raises
    ------
    ConfigError
        If the format is unknown, the prefix is no identifier, or a graph has too many states.
    OutputError
        If a file cannot be written.
    """
    path = Path(path)
    form = format_of(path) if form is None else form
    files = files_of(path, form)
    if form == "c":
        contents = [c_header(exported, prefix).encode()]
    elif form == "verilog":
        contents = [verilog_module(exported, files[1].name, prefix).encode(), memory_image(exported).encode()]
    elif form == "dot":
        contents = [dot_text(exported, force).encode()]
    elif form == "jff":
        contents = [jff_text(FiniteAutomaton.of_table(exported.table)).encode()]
    elif form == "csv":
        contents = [csv_text(exported.table).encode()]
    elif form == "npz":
        contents = [plain_archive(exported)]
    else:
        raise ConfigError(f"the format {form!r} is unknown; use one of {', '.join(get_args(Format))}")
    with whole_files(*files, what="the export") as lent:
        for part, content in zip(lent, contents, strict=True):
            part.write_bytes(content)
    return files


def export_pieces(made: PieceFilter, path: str | Path, form: Format = "c", prefix: str = "bounce") -> PieceTables:
    """Write a filter of pieces of walls as a C header or plain arrays; return the tables of the header.

    Parameters
    ----------
    made
        The filter.
    path
        The file to write.
    form
        ``c`` or ``npz``.
    prefix
        What the names in C begin with.

    Raises
    ------
    ConfigError
        If the form is another one, or the prefix is no identifier.
    FilterError
        As `c_piece_header`.
    OutputError
        If the file cannot be written.
    """
    if form not in ("c", "npz"):
        raise ConfigError("a filter of pieces of walls is no table; give --format c or npz")
    content = c_piece_header(made.map, prefix, made.first).encode() if form == "c" else plain_piece_archive(made)
    with whole_files(path, what="the export") as (part,):
        part.write_bytes(content)
    return PieceTables.of(made.map, prefix, made.first)
