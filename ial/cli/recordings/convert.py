"""`ial convert`: any recording as a ROS bag or as JSON lines."""

import sys
from pathlib import Path
from typing import Annotated

import typer

from ial.cli.shell.options import LaserPose, OdomTopic, Overwrite, ScanTopics
from ial.cli.shell.outputs import STDOUT, check_outputs, check_places
from ial.cli.shell.terminal import remark, say


def convert(
    recording: Annotated[
        Path | None,
        typer.Argument(metavar="[RECORDING]", show_default=False, help="Any recording; the embedded one if it is left out."),
    ] = None,
    target: Annotated[
        Path | None, typer.Argument(metavar="[OUT]", show_default=False, help="The file to write: .mcap for ROS 2, .bag for ROS 1.")
    ] = None,
    lines: Annotated[
        Path | None, typer.Option("--jsonl", metavar="FILE", help="Write JSON lines, as `ial stream` reads them; - for standard output.")
    ] = None,
    scan_topic: ScanTopics = None,
    odom_topic: OdomTopic = None,
    laser_pose: LaserPose = None,
    overwrite: Overwrite = False,
) -> None:
    """Write a recording as .mcap, .bag or JSON lines; localizing that gives the same enclosures, bit for bit."""
    from ial.cli.shell.inputs import Inputs
    from ial.datasets.conversion import convert, convert_to_lines
    from ial.errors import OutputError

    if (target is None) == (lines is None):
        raise OutputError("one file is written: give RECORDING OUT for a bag, or --jsonl FILE for JSON lines")
    inputs = Inputs(recording, None, scan_topic, odom_topic, laser_pose)
    path, _ = inputs.paths
    file = target or lines
    if file is None or str(lines) == "-":
        check_places([STDOUT], [path])
    else:
        check_outputs([file], [path], overwrite)
    source = inputs.source()
    if target is not None:
        count = convert(source, target)
    elif str(lines) == "-":
        convert_to_lines(source, sys.stdout)
        return
    elif lines is not None:
        count = convert_to_lines(source, lines)
    for reason, skipped in source.skipped.items():
        remark("skipped", f"{skipped} × {reason}", "yellow")
    for reason, repaired in source.repaired.items():
        remark("repaired", f"{repaired} × {reason}", "yellow")
    say(f"{count} scans written to {file}")
