"""`ial`: the commands."""

from importlib.metadata import version
from typing import Annotated, Any

import typer
from typer.core import TyperGroup

from ial.cli.active import explore
from ial.cli.bounce import advise, build, calibrate, export, run, search_angle, show
from ial.cli.bounce import simulate as bounce_simulate
from ial.cli.compass import plan, verify
from ial.cli.compass import run as compass_run
from ial.cli.compass import show as compass_show
from ial.cli.lidar import bounds, localize, replay, stream, warm, where
from ial.cli.odometer import run as odometer_run
from ial.cli.odometer import show as odometer_show
from ial.cli.recordings import convert, info, kidnap, map_info, simulate
from ial.cli.shell.outcome import exit_status
from ial.cli.shell.terminal import say


class Commands(TyperGroup):
    """Runs a command and turns what goes wrong into an exit status."""

    def invoke(self, ctx: Any) -> Any:
        """Run the chosen command."""
        with exit_status():
            return super().invoke(ctx)


app = typer.Typer(
    cls=Commands,
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    epilog="Exit status: 0 done, 2 wrong input or usage, 3 ran but never localized.",
)
maps = typer.Typer(no_args_is_help=True, help="Look at a map.")
bounce = typer.Typer(no_args_is_help=True, help="Localize a robot that has a contact sensor and a clock.")
compass = typer.Typer(no_args_is_help=True, help="Localize a robot that has a compass and a contact sensor.")
odometer = typer.Typer(no_args_is_help=True, help="Localize a robot that measures its turns and how far it drives.")
app.command("localize")(localize.localize)
app.command("where")(where.where)
app.command("explore")(explore.explore)
app.command("bounds")(bounds.bounds)
app.command("info")(info.info)
app.command("convert")(convert.convert)
app.command("kidnap")(kidnap.kidnap)
app.command("simulate")(simulate.simulate)
app.command("replay")(replay.replay)
app.command("warm")(warm.warm)
maps.command("info")(map_info.map_info)
app.add_typer(maps, name="map")
bounce.command("advise")(advise.advise)
bounce.command("build")(build.build)
bounce.command("run")(run.run)
bounce.command("calibrate")(calibrate.calibrate)
bounce.command("export")(export.export)
bounce.command("search-angle")(search_angle.search_angle)
bounce.command("show")(show.show)
bounce.command("simulate")(bounce_simulate.simulate)
app.add_typer(bounce, name="bounce")
compass.command("plan")(plan.plan)
compass.command("verify")(verify.verify)
compass.command("run")(compass_run.run)
compass.command("show")(compass_show.show)
app.add_typer(compass, name="compass")
odometer.command("run")(odometer_run.run)
odometer.command("show")(odometer_show.show)
app.add_typer(odometer, name="odometer")


@app.command(
    "stream", help=stream.SUMMARY, context_settings={"ignore_unknown_options": True, "allow_extra_args": True, "help_option_names": []}
)
def _stream(ctx: typer.Context) -> None:
    stream.stream(ctx.args)


def _print_version(wanted: bool) -> None:
    if wanted:
        say(f"ial {version('ial')}")
        raise typer.Exit


@app.callback()
def ial(
    version: Annotated[bool, typer.Option("--version", help="Print the version.", callback=_print_version, is_eager=True)] = False,
) -> None:
    """Guaranteed robot localization: all poses that a lidar recording, a map and error bounds allow."""
