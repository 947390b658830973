"""`ial bounce export`: a filter for a microcontroller, for hardware, or for another tool."""

from pathlib import Path
from typing import Annotated, Literal

import typer

from ial.cli.shell.options import Overwrite
from ial.cli.shell.outputs import check_outputs
from ial.cli.shell.terminal import remark, say, shown


def export(
    filter_path: Annotated[Path, typer.Argument(metavar="FILTER", help="What `ial bounce build` has written.")],
    out: Annotated[Path, typer.Option(metavar="FILE", help="The file to write; Verilog has a .hex beside it.")],
    form: Annotated[
        Literal["c", "verilog", "dot", "jff", "csv", "npz"] | None,
        typer.Option("--format", help="What to write; what the suffix of FILE stands for if it is left out."),
    ] = None,
    prefix: Annotated[str, typer.Option(metavar="NAME", help="What names in C and Verilog begin with.")] = "bounce",
    minimize: Annotated[
        Literal["colours", "localized"] | None,
        typer.Option(help="Use the fewest states that tell the same colours, or only whether the robot is localized."),
    ] = None,
    restart: Annotated[bool, typer.Option("--restart", help="Begin anew after a rejection: the robot may have been carried.")] = False,
    flash: Annotated[int, typer.Option(min=0, metavar="BYTES", help="Warn of C tables that are larger.")] = 64 * 1024,
    overwrite: Overwrite = False,
    force: Annotated[bool, typer.Option("--force", help="Write a DOT file of any number of states.")] = False,
) -> None:
    """Write a filter in the form of another program."""
    from ial.bouncing.exports import formats
    from ial.bouncing.exports.c_tables import CTables
    from ial.bouncing.exports.exported_filter import ExportedFilter
    from ial.bouncing.filters.filter_file import read_filter
    from ial.bouncing.filters.piece_filter import PieceFilter
    from ial.errors import ConfigError

    form = formats.format_of(out) if form is None else form
    check_outputs(formats.files_of(out, form), [filter_path], overwrite)
    made = read_filter(filter_path)
    if isinstance(made, PieceFilter):
        if form not in ("c", "npz") or minimize or restart:
            raise ConfigError(
                f"{filter_path}: a filter of pieces of walls is no table; give --format c or npz, without --minimize and --restart"
            )
        tables = formats.export_pieces(made, out, form, prefix)
        say(f"{len(made.map)} pieces of walls in {shown(out)}")
        if form == "npz":
            return
        say(f"flash: {tables.flash_bytes:,} bytes")
        say(f"RAM: {tables.ram_bytes:,} bytes")
        return
    exported = ExportedFilter.of(made, minimize, restart)
    files = formats.export(exported, out, form, prefix, force)
    say(f"{len(exported.table) - 1} states and a trap in {' and '.join(shown(file) for file in files)}")
    if form == "c":
        c_tables = CTables.of(exported, prefix)
        say(f"flash: {c_tables.stepping_bytes:,} bytes for steps and colours, {c_tables.flash_bytes:,} with all tables")
        say(f"RAM: {c_tables.ram_bytes} byte{'s' * (c_tables.ram_bytes != 1)}")
        excess = c_tables.excess(flash)
        if excess:
            remark("warning", excess, "yellow")
