"""`ial bounds`: which bounds a recording keeps, and a configuration to paste."""

from pathlib import Path
from typing import Annotated, Literal

import typer

from ial.cli.shell.options import ConfigPath, Json, LaserPose, MapTopic, OdomTopic, Overwrite, ScanTopics, Semantics
from ial.cli.shell.out_folder import stamped_folder, tell_replaced
from ial.cli.shell.outputs import check_folder
from ial.cli.shell.terminal import progress, remark, say, say_json, shown
from ial.errors import ConfigError

_FILES = ("bounds.json", "config.yaml", "failures.npz", "picture.png")  # the record first


def bounds(
    recording: Annotated[
        Path | None, typer.Argument(metavar="[RECORDING]", show_default=False, help="Any recording; the embedded sample if it is left out.")
    ] = None,
    map_path: Annotated[Path | None, typer.Option("--map", metavar="MAP", help="A map.yaml, or a recording with a map topic.")] = None,
    truth: Annotated[
        Path | None, typer.Option(metavar="TUM", help="A reference trajectory; without it, the localizer's own unique poses are taken.")
    ] = None,
    truth_frame: Annotated[Literal["base", "laser"], typer.Option(help="Whose poses the reference holds.")] = "base",
    config: ConfigPath = None,
    settings: Annotated[
        list[str] | None, typer.Option("--set", metavar="KEY=VALUE", help="Any key of the configuration; may be repeated.")
    ] = None,
    out: Annotated[Path | None, typer.Option(metavar="DIR", help="Where to write; out/<recording>-<time> if it is left out.")] = None,
    start: Annotated[int, typer.Option("--from", metavar="K", min=0, help="The first scan, counted from 0.")] = 0,
    stop: Annotated[int | None, typer.Option("--to", metavar="K", min=1, help="The scan to stop before.")] = None,
    every: Annotated[int, typer.Option(metavar="N", min=1, help="Take the beams of every Nth scan.")] = 1,
    scan_topic: ScanTopics = None,
    odom_topic: OdomTopic = None,
    laser_pose: LaserPose = None,
    semantics: Semantics = "nav2",
    map_topic: MapTopic = None,
    overwrite: Overwrite = False,
    as_json: Json = False,
) -> None:
    """Measure how far beams and odometry are from a reference, and suggest bounds; draw where beams fail.

    Writes bounds.json, config.yaml, failures.npz and picture.png.
    """
    if recording is not None and map_path is None:
        raise ConfigError(f"no map that {recording} belongs to; give --map MAP: a map.yaml, or the recording itself if it holds the map")
    from ial.cli.lidar.bounds_report import doubts, lines
    from ial.cli.lidar.config_file import resolve
    from ial.cli.shell.inputs import Inputs
    from ial.datasets.trajectory import read_tum
    from ial.lidar.configuration.config_record import config_record, config_yaml
    from ial.results.lidar.failure_picture import draw_failures
    from ial.results.lidar.result_folder import ResultFolder
    from ial.study.bounds_survey import BoundsSurvey
    from ial.study.reference import own_poses, reference_poses

    resolved = resolve(config, settings or ())
    folder_path = out or stamped_folder("bounds-" + ("sample" if recording is None else recording.name))
    inputs = Inputs(recording, map_path, scan_topic, odom_topic, laser_pose, semantics, map_topic)
    replaces = check_folder(folder_path, _FILES, [*inputs.paths, config, truth], overwrite)
    with ResultFolder(folder_path) as folder:
        source, grid = inputs.source(), inputs.grid()
        survey = BoundsSurvey(grid, resolved)
        if truth is None:
            pairs = own_poses(source, grid, resolved, start, stop, every)
        else:
            pairs = reference_poses(source, read_tum(truth), truth_frame, resolved, start, stop)  # motion from each scan to the next
        for step, pose in progress(pairs, None, Path(source.name).name):
            survey.add(step, pose, beams=(step.index - start) % every == 0)
        if not survey.scans:
            fault = "its stamps do not meet those of the scans" if truth is not None else "the robot was never localized; give --truth"
            raise ConfigError(f"{source.name}: no scan has a reference pose: {fault}")
        suggestion = survey.suggestion()
        folder.write("config.yaml", config_yaml(suggestion))
        failures = survey.failures
        failures.save(folder.place("failures.npz"))
        draw_failures(folder.place("picture.png"), grid, source.name, failures.cell_m, failures.good, failures.ended, failures.passed)
        steps_of = 1 if truth is not None else every  # scans
        record = {"circular": truth is None, "steps_of": steps_of, **survey.record(), "suggestion": config_record(suggestion)}
        record = folder.conclude("bounds.json", record)
    if replaces:
        tell_replaced(folder_path)
    if as_json:
        say_json(record)
        return
    for line in lines(record, resolved):
        say(line)
    for line in doubts(record):
        remark("warning", line, "yellow")
    say(f"results in {shown(folder_path)}; use the bounds with --config {shown(folder_path / 'config.yaml')}")
