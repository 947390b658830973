"""`ial stream`: odometry and scans in, one estimate out for each scan, for as long as they come.

Its options are read by argparse: typer imports pydantic, which a small computer on a robot shall not have to load.
"""

import argparse
import math
import os
from collections.abc import Sequence
from pathlib import Path

from ial.errors import ConfigError

SUMMARY = "Localize while odometry and scans arrive as JSON lines on standard input; `ial convert --jsonl` makes such lines."


def stream(arguments: Sequence[str]) -> None:
    """Run the command with its arguments."""
    chosen = _parser().parse_args(arguments)
    if chosen.map is None:
        from ial.datasets.sample import sample_map_path

        raise ConfigError(f"no map to localize in; give --map MAP (the one of the embedded recording is {sample_map_path()})")
    if chosen.deadline is not None and not 0.0 < chosen.deadline < math.inf:
        raise ConfigError(f"--deadline {chosen.deadline:g}: give a number of seconds above 0")
    state = None if chosen.state is None else Path(os.path.realpath(chosen.state))  # a link to it is kept
    _check_outputs(chosen, state)
    from ial.cli.lidar.config_file import resolve
    from ial.cli.lidar.streaming import Streaming
    from ial.cli.shell.inputs import Inputs
    from ial.contractors.threads import set_threads

    set_threads(chosen.threads)
    Streaming(
        inputs=Inputs(
            chosen.recording, chosen.map, laser_pose=chosen.laser_pose, semantics=chosen.map_semantics, map_topic=chosen.map_topic
        ),
        config=resolve(chosen.config, chosen.set, max_seconds=chosen.deadline),
        out=chosen.out,
        state=state,
        overwrite=chosen.overwrite,
    ).run()


def _check_outputs(chosen: argparse.Namespace, state: Path | None) -> None:
    from ial.cli.shell.outputs import STDIN, STDOUT, check_outputs, check_places
    from ial.whole_file import unfinished

    states = [] if state is None else [state, unfinished(state)]
    check_places([chosen.out or STDOUT, *states], [chosen.recording or STDIN, chosen.map, chosen.config])
    if chosen.out is not None and (state is None or not state.exists()):  # else the file is known by the state
        check_outputs([chosen.out], [], chosen.overwrite)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="ial stream",
        description=SUMMARY,
        epilog="Ends when the input ends, or on SIGTERM or Ctrl-C after the scan at hand. Exit status: 0 done, 2 wrong input or usage.",
    )
    parser.add_argument("recording", metavar="RECORDING", nargs="?", type=Path, help="any recording; standard input if it is left out")
    parser.add_argument("--map", metavar="MAP", type=Path, help="a map.yaml, or a recording with a nav_msgs/OccupancyGrid topic")
    parser.add_argument("--config", metavar="FILE", type=Path, help="a YAML file with the configuration")
    parser.add_argument("--set", metavar="KEY=VALUE", action="append", default=[], help="any key of it; may be repeated")
    parser.add_argument(
        "--deadline", metavar="S", type=float, help="seconds after which a scan is answered with a coarser set, which holds all the same"
    )
    parser.add_argument("--out", metavar="FILE", type=Path, help="where to write the lines; standard output if it is left out")
    parser.add_argument(
        "--state", metavar="FILE", type=Path, help="kept up to date after every scan: a run that was killed goes on from there"
    )
    parser.add_argument("--overwrite", action="store_true", help="replace FILE of --out if it exists when a run begins")
    parser.add_argument(
        "--laser-pose", metavar=("X", "Y", "YAW"), nargs=3, type=float, help="where the laser sits in base_link, metres and radians"
    )
    parser.add_argument("--map-semantics", choices=("nav2", "ros1"), default="nav2", help="whose rules turn pixels into cells")
    parser.add_argument("--map-topic", metavar="TOPIC", help="the map's topic, if MAP is a recording with several")
    parser.add_argument("--threads", metavar="N", type=_count, default=1, help="threads of the kernels (1)")
    return parser


def _count(text: str) -> int:
    number = float(text)
    if not (math.isfinite(number) and number == int(number) >= 1):
        raise argparse.ArgumentTypeError("give a whole number of at least 1")
    return int(number)
