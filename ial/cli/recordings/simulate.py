"""`ial simulate`: a recording with exact truth."""

import math
from pathlib import Path
from typing import Annotated

import typer

from ial.cli.shell.options import ConfigPath, LaserPose, MapTopic, Overwrite, Semantics
from ial.cli.shell.outputs import check_outputs
from ial.cli.shell.terminal import say, shown
from ial.errors import ConfigError


def simulate(
    map_path: Annotated[Path, typer.Option("--map", metavar="MAP", help="The map to drive in.")],
    out: Annotated[Path, typer.Option(metavar="REC", help="The recording to write: .mcap or .bag; the truth goes beside it as .tum.")],
    seed: Annotated[int, typer.Option(min=0, help="The same seed gives the same bits.")] = 0,
    scans: Annotated[int, typer.Option(min=1, help="Number of scans.")] = 200,
    beams: Annotated[int, typer.Option(min=2, help="Beams per scan.")] = 181,
    view_rad: Annotated[float, typer.Option(help="Angle from the first beam to the last.")] = math.pi,
    range_max_m: Annotated[float, typer.Option(help="The sensor's limit.")] = 30.0,
    laser_pose: LaserPose = None,
    range_error_m: Annotated[float, typer.Option(help="Bound of the error of a range.")] = 0.02,
    bearing_error_rad: Annotated[float, typer.Option(help="Bound of the error of a bearing.")] = 0.002,
    outliers: Annotated[int, typer.Option(min=0, help="At most so many bad beams per scan.")] = 0,
    step_m: Annotated[float, typer.Option(help="Largest way from scan to scan.")] = 0.1,
    turn_rad: Annotated[float, typer.Option(help="Largest turn from scan to scan.")] = 0.1,
    period_s: Annotated[float, typer.Option(help="Time between scans.")] = 0.1,
    config: ConfigPath = None,
    semantics: Semantics = "nav2",
    map_topic: MapTopic = None,
    overwrite: Overwrite = False,
) -> None:
    """Drive a robot at random through a map and record it; errors stay within bounds, those of the odometry within the configured ones."""
    from ial.cli.lidar.config_file import resolve
    from ial.cli.shell.inputs import Inputs
    from ial.datasets.conversion import convert
    from ial.datasets.scan import Mounting
    from ial.datasets.simulator import Lidar, SensorErrors
    from ial.datasets.simulator import simulate as drive
    from ial.datasets.trajectory import write_tum
    from ial.datasets.walk import random_walk
    from ial.keys.reading import read

    sizes = {"view-rad": view_rad, "range-max-m": range_max_m, "step-m": step_m, "turn-rad": turn_rad, "period-s": period_s}
    for name, value in sizes.items():
        if not (math.isfinite(value) and value > 0.0):
            raise ConfigError(f"--{name} is {value}; give a finite number above 0")
    truth = out.with_suffix(".tum")
    check_outputs([out, truth], [map_path, config], overwrite)
    bounds = resolve(config).bounds.motion
    inputs = Inputs(map_path=map_path, laser_pose=laser_pose, semantics=semantics, map_topic=map_topic)
    grid = inputs.grid()
    at = inputs.mounting
    mounting = Mounting() if at is None else Mounting(at.x, at.y, at.theta)
    lidar = Lidar(beams, -0.5 * view_rad, view_rad / (beams - 1), range_max=range_max_m, mounting=mounting)
    given = {"range_error_m": range_error_m, "bearing_error_rad": bearing_error_rad, "outliers": outliers}
    errors = read(SensorErrors(), given)
    path = random_walk(grid, scans, seed, step_m, turn_rad)
    simulation = drive(grid, path, lidar, errors, bounds, seed, period_s)
    count = convert(simulation.recording, out)
    write_tum(simulation.truth, truth)
    say(f"{count} scans written to {shown(out)}, the truth to {shown(truth)}")
    say(f"ial localize {shown(out)} --map {shown(map_path)} --truth {shown(truth)}")
