"""`ial convert`: any recording as a ROS bag."""

from pathlib import Path
from typing import Annotated

import typer

from ial.cli.options import LaserPose, OdomTopic, RecordingPath, ScanTopic, pose_of
from ial.cli.terminal import remark, say


def convert(
    recording: RecordingPath,
    target: Annotated[Path, typer.Argument(metavar="OUT", help="The file to write: .mcap for ROS 2, .bag for ROS 1.")],
    scan_topic: ScanTopic = None,
    odom_topic: OdomTopic = None,
    laser_pose: LaserPose = None,
) -> None:
    """Write a recording as .mcap or .bag; localizing that gives the same enclosures, bit for bit."""
    from ial.datasets.conversion import convert
    from ial.datasets.opening import open_recording
    from ial.errors import OutputError

    if target.exists() and recording.exists() and target.samefile(recording):
        raise OutputError(f"{target}: this is the recording itself; give another file to write to")
    source = open_recording(recording, scan_topic, odom_topic, pose_of(laser_pose))
    count = convert(source, target)
    for reason, skipped in source.skipped.items():
        remark("skipped", f"{skipped} × {reason}", "yellow")
    for reason, repaired in source.repaired.items():
        remark("repaired", f"{repaired} × {reason}", "yellow")
    say(f"{count} scans written to {target}")
