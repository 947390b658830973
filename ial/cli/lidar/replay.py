"""`ial replay`: whether this machine keeps up with a recording."""

from pathlib import Path
from typing import Annotated

import typer

from ial.cli.shell.options import ConfigPath, Json, LaserPose, MapTopic, OdomTopic, ScanTopics, Semantics
from ial.cli.shell.terminal import say, say_json
from ial.errors import ConfigError


def replay(
    recording: Annotated[
        Path | None, typer.Argument(metavar="[RECORDING]", show_default=False, help="Any recording; the embedded sample if it is left out.")
    ] = None,
    map_path: Annotated[Path | None, typer.Option("--map", metavar="MAP", help="A map.yaml, or a recording with a map topic.")] = None,
    realtime: Annotated[bool, typer.Option("--realtime", help="Let scans arrive as they were recorded.")] = False,
    speed: Annotated[float, typer.Option(metavar="X", help="With --realtime: so many times faster.")] = 1.0,
    deadline: Annotated[float | None, typer.Option(metavar="S", help="Seconds after which a scan is answered with a coarser set.")] = None,
    config: ConfigPath = None,
    settings: Annotated[
        list[str] | None, typer.Option("--set", metavar="KEY=VALUE", help="Any key of the configuration; may be repeated.")
    ] = None,
    scan_topic: ScanTopics = None,
    odom_topic: OdomTopic = None,
    laser_pose: LaserPose = None,
    semantics: Semantics = "nav2",
    map_topic: MapTopic = None,
    threads: Annotated[int, typer.Option(metavar="N", min=1, help="Threads of the kernels.")] = 1,
    as_json: Json = False,
) -> None:
    """Localize a recording without writing results, and print how long each scan waited for its answer."""
    if recording is not None and map_path is None:
        raise ConfigError(f"no map to localize {recording} in; give --map MAP: a map.yaml, or the recording itself if it holds the map")
    if not 0.0 < speed < float("inf"):
        raise ConfigError(f"--speed {speed:g}: give a number above 0")
    if deadline is not None and not 0.0 < deadline < float("inf"):
        raise ConfigError(f"--deadline {deadline:g}: give a number of seconds above 0")
    from ial.cli.lidar.config_file import resolve
    from ial.cli.shell.inputs import Inputs
    from ial.contractors.threads import set_threads
    from ial.lidar.localizer import Localizer
    from ial.lidar.warming import warm
    from ial.study.replay import replay

    resolved = resolve(config, settings or (), max_seconds=deadline)
    set_threads(threads)
    inputs = Inputs(recording, map_path, scan_topic, odom_topic, laser_pose, semantics, map_topic)
    source, grid = inputs.source(), inputs.grid()
    warm(resolved)
    outcome = replay(source, Localizer(grid, config=resolved), speed if realtime else None)
    latencies = outcome.latencies
    if as_json:
        quantiles = {name: latencies.quantile(share) for name, share in (("median_s", 0.5), ("p99_s", 0.99))}
        counts = {"scans": outcome.scans, "late": outcome.late, "limited": outcome.limited, "recorded_s": outcome.recorded_s}
        say_json({**counts, "latency": {**quantiles, "max_s": latencies.max_s}})
        return
    say(f"{outcome.scans} scans of {outcome.recorded_s:.1f} s: {latencies}")
    if realtime:
        say(f"{outcome.late} answers came after the next scan was due")
    if outcome.limited:
        say(f"{outcome.limited} answers were made coarser by the deadline or by max_boxes")
