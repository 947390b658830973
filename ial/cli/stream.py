"""`ial stream`: odometry and scans in, one estimate out for each scan, for as long as they come."""

from pathlib import Path
from typing import Annotated

import typer

from ial.cli.options import ConfigPath, LaserPose, MapTopic, Semantics, pose_of
from ial.errors import ConfigError


def stream(
    recording: Annotated[
        Path | None, typer.Argument(metavar="[RECORDING]", show_default=False, help="Any recording; standard input if it is left out.")
    ] = None,
    map_path: Annotated[Path | None, typer.Option("--map", metavar="MAP", help="A map.yaml, or a recording with a map topic.")] = None,
    config: ConfigPath = None,
    settings: Annotated[
        list[str] | None, typer.Option("--set", metavar="KEY=VALUE", help="Any key of the configuration; may be repeated.")
    ] = None,
    deadline: Annotated[
        float | None, typer.Option(metavar="S", help="Seconds after which a scan is answered with a coarser set, which holds all the same.")
    ] = None,
    out: Annotated[Path | None, typer.Option(metavar="FILE", help="Where to write the lines; standard output if it is left out.")] = None,
    state: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Kept up to date after every scan: a run that was killed goes on from there.")
    ] = None,
    laser_pose: LaserPose = None,
    semantics: Semantics = "nav2",
    map_topic: MapTopic = None,
    threads: Annotated[int, typer.Option(metavar="N", min=1, help="Threads of the kernels.")] = 1,
) -> None:
    """Localize while odometry and scans arrive as JSON lines on standard input; `ial convert --jsonl` makes such lines.

    Ends when the input ends, or on SIGTERM or Ctrl-C, after the scan at hand.
    """
    if map_path is None:
        from ial.datasets.sample import sample_map_path

        raise ConfigError(f"no map to localize in; give --map MAP (the one of the embedded recording is {sample_map_path()})")
    from ial.cli.config_file import resolve
    from ial.cli.streaming import Streaming
    from ial.contractors.threads import set_threads

    set_threads(threads)
    Streaming(
        recording=recording,
        map_path=map_path,
        config=resolve(config, settings or (), max_seconds=deadline),
        out=out,
        state=state,
        laser_pose=pose_of(laser_pose),
        semantics=semantics,
        map_topic=map_topic,
    ).run()
