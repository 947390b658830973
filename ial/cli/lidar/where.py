"""`ial where`: in which of several maps a recording was made."""

from pathlib import Path
from typing import Annotated

import typer

from ial.cli.shell.options import ConfigPath, Json, LaserPose, OdomTopic, Overwrite, ScanTopics, Semantics
from ial.cli.shell.outputs import check_outputs
from ial.cli.shell.terminal import progress, say, say_json
from ial.errors import ConfigError

NEVER_LOCALIZED = 3


def where(
    recording: Annotated[
        Path | None, typer.Argument(metavar="[RECORDING]", show_default=False, help="Any recording; the embedded sample if it is left out.")
    ] = None,
    maps: Annotated[list[Path] | None, typer.Option("--map", metavar="MAP", help="A map.yaml; give the option once for each map.")] = None,
    out: Annotated[Path | None, typer.Option(metavar="FILE", help="Also write one JSON line for each scan.")] = None,
    config: ConfigPath = None,
    settings: Annotated[
        list[str] | None, typer.Option("--set", metavar="KEY=VALUE", help="Any key of the configuration; may be repeated.")
    ] = None,
    start: Annotated[int, typer.Option("--from", metavar="K", min=0, help="The first scan, counted from 0.")] = 0,
    stop: Annotated[int | None, typer.Option("--to", metavar="K", min=1, help="The scan to stop before.")] = None,
    every: Annotated[int, typer.Option(metavar="N", min=1, help="Process every Nth scan.")] = 1,
    scan_topic: ScanTopics = None,
    odom_topic: OdomTopic = None,
    laser_pose: LaserPose = None,
    semantics: Semantics = "nav2",
    overwrite: Overwrite = False,
    as_json: Json = False,
) -> None:
    """Localize a recording in several maps at once, and say in which of them the robot can be: the others are proved impossible."""
    if not maps:
        raise ConfigError("no map to localize in; give --map once for each map")
    from ial.cli.lidar.config_file import resolve
    from ial.cli.lidar.where_report import Lines, named
    from ial.cli.shell.inputs import Inputs
    from ial.datasets.recording import steps
    from ial.lidar.atlas import Atlas

    inputs = Inputs(recording, None, scan_topic, odom_topic, laser_pose)
    check_outputs([] if out is None else [out], [inputs.paths[0], *maps, config], overwrite)
    resolved = resolve(config, settings or ())
    source = inputs.source()
    grids = {name: Inputs(map_path=path, semantics=semantics).grid() for name, path in named(maps).items()}
    atlas = Atlas(grids, resolved)
    with Lines(out) as lines:
        chosen = steps(source, resolved.bounds.motion, start, stop, every, no_return=resolved.free_space.no_return)
        for step in progress(chosen, None, Path(source.name).name):
            lines.add(step, atlas.update(step.motion, step.scan))
    if as_json:
        say_json(lines.record())
    else:
        for text in lines.report():
            say(text)
    if lines.last is None or lines.last.map is None:
        raise typer.Exit(NEVER_LOCALIZED)
