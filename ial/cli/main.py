"""`ial`: the command, and how its outcome becomes an exit status."""

from importlib.metadata import version
from typing import Annotated, Any

import typer
from typer.core import TyperGroup

from ial.cli import convert, info, kidnap, localize, map_info, replay, simulate, stream, warm
from ial.cli.terminal import remark, remarks, say
from ial.errors import IalError

WRONG_INPUT, INTERRUPTED = 2, 130


class Commands(TyperGroup):
    """Runs a command; an error of ial becomes one line on stderr and exit status 2, an interruption status 130."""

    def invoke(self, ctx: Any) -> Any:
        """Run the chosen command."""
        with remarks():
            try:
                return super().invoke(ctx)
            except IalError as error:
                remark("error", str(error), "bold red")
                raise typer.Exit(WRONG_INPUT) from None
            except KeyboardInterrupt:
                remark("interrupted", "nothing was written", "bold red")
                raise typer.Exit(INTERRUPTED) from None


app = typer.Typer(
    cls=Commands,
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    epilog="Exit status: 0 done, 2 wrong input or usage, 3 ran but never localized.",
)
maps = typer.Typer(no_args_is_help=True, help="Look at a map.")
app.command("localize")(localize.localize)
app.command("stream")(stream.stream)
app.command("info")(info.info)
app.command("convert")(convert.convert)
app.command("kidnap")(kidnap.kidnap)
app.command("simulate")(simulate.simulate)
app.command("replay")(replay.replay)
app.command("warm")(warm.warm)
maps.command("info")(map_info.map_info)
app.add_typer(maps, name="map")


def _print_version(wanted: bool) -> None:
    if wanted:
        say(f"ial {version('ial')}")
        raise typer.Exit


@app.callback()
def ial(
    version: Annotated[bool, typer.Option("--version", help="Print the version.", callback=_print_version, is_eager=True)] = False,
) -> None:
    """Guaranteed robot localization: all poses that a lidar recording, a map and error bounds allow."""


def main() -> None:
    """Run the command line."""
    app()
