"""`ial localize`: the main job, from a recording and a map to a folder of results."""

from pathlib import Path
from typing import Annotated, Literal

import typer

from ial.cli.lidar.report import report
from ial.cli.shell.options import ConfigPath, Json, LaserPose, MapTopic, OdomTopic, Overwrite, ScanTopics, Semantics
from ial.cli.shell.out_folder import point_latest, stamped_folder, tell_replaced
from ial.cli.shell.outputs import check_folder
from ial.cli.shell.terminal import say, say_json, shown
from ial.errors import ConfigError

NEVER_LOCALIZED = 3


def localize(
    recording: Annotated[
        Path | None,
        typer.Argument(metavar="[RECORDING]", show_default=False, help="ROS bag or CARMEN log; the embedded sample if it is left out."),
    ] = None,
    map_path: Annotated[
        Path | None, typer.Option("--map", metavar="MAP", help="A map.yaml, or a recording with a nav_msgs/OccupancyGrid topic.")
    ] = None,
    config: ConfigPath = None,
    out: Annotated[Path | None, typer.Option(metavar="DIR", help="Where to write; out/<recording>-<time> if it is left out.")] = None,
    static: Annotated[bool, typer.Option("--static", help="Localize every scan alone, with no motion and no memory.")] = False,
    start: Annotated[int, typer.Option("--from", metavar="K", min=0, help="The first scan, counted from 0.")] = 0,
    stop: Annotated[int | None, typer.Option("--to", metavar="K", min=1, help="The scan to stop before.")] = None,
    every: Annotated[int, typer.Option(metavar="N", min=1, help="Process every Nth scan; the motion in between adds up.")] = 1,
    truth: Annotated[Path | None, typer.Option(metavar="TUM", help="A reference trajectory to measure the guarantee against.")] = None,
    truth_frame: Annotated[Literal["base", "laser"], typer.Option(help="Whose poses the reference holds.")] = "base",
    initial: Annotated[
        tuple[float, float, float] | None, typer.Option(metavar="X Y θ", help="Where the robot is at the start, in metres and radians.")
    ] = None,
    initial_radius: Annotated[
        tuple[float, float] | None, typer.Option(metavar="M RAD", help="How far off that may be in x and y, and in θ.")
    ] = None,
    outliers: Annotated[
        str | None, typer.Option(metavar="Q", help="How many of the used beams may be bad: a whole number, a fraction like 0.2, or auto.")
    ] = None,
    domain: Annotated[Literal["free", "free_or_unknown"] | None, typer.Option(help="Where the base may be.", show_default="free")] = None,
    settings: Annotated[
        list[str] | None, typer.Option("--set", metavar="KEY=VALUE", help="Any other key of the configuration; may be repeated.")
    ] = None,
    dump_config: Annotated[bool, typer.Option("--dump-config", help="Print the resolved configuration and stop.")] = False,
    scan_topic: ScanTopics = None,
    odom_topic: OdomTopic = None,
    laser_pose: LaserPose = None,
    semantics: Semantics = "nav2",
    map_topic: MapTopic = None,
    threads: Annotated[int | None, typer.Option(metavar="N", min=1, help="Threads of the kernels; all cores by default.")] = None,
    overwrite: Overwrite = False,
    as_json: Json = False,
) -> None:
    """Find, for every scan, all poses that a recording, a map and the error bounds allow.

    Writes trajectory.tum, enclosures.jsonl, events.jsonl, summary.json, config.yaml, picture.png and result.mcap.
    """
    from ial.cli.lidar.config_file import resolve

    resolved = resolve(config, settings or (), outliers=outliers, domain=domain)
    if dump_config:
        from ial.lidar.configuration.config_record import config_yaml

        say(config_yaml(resolved).rstrip())
        return
    if recording is not None and map_path is None:
        raise ConfigError(f"no map to localize {recording} in; give --map MAP: a map.yaml, or the recording itself if it holds the map")
    if stop is not None and stop <= start:
        raise ConfigError(f"no scan lies from {start} up to {stop}; give a --to above --from")
    if (initial is None) != (initial_radius is None):
        raise ConfigError("--initial X Y θ and --initial-radius M RAD belong together; give both")

    from ial.cli.lidar.job import Job
    from ial.cli.shell.inputs import Inputs
    from ial.contractors.threads import set_threads
    from ial.results.lidar.run_results import FILES

    set_threads(threads)
    inputs = Inputs(recording, map_path, scan_topic, odom_topic, laser_pose, semantics, map_topic)
    folder = out or stamped_folder("sample" if recording is None else str(recording))
    job = Job(inputs, resolved, folder, start, stop, every, static, truth, truth_frame, initial, initial_radius)
    replaces = check_folder(folder, FILES, [*inputs.paths, config, truth], overwrite)
    summary, record = job.run()
    if replaces:
        tell_replaced(folder)
    if out is None:
        point_latest(folder)
    if as_json:
        say_json(record)
    else:
        for line in report(summary, record):
            say(line)
        say(f"results in {shown(folder)}")
    if not summary.localized:
        raise typer.Exit(NEVER_LOCALIZED)
