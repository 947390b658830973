"""`ial kidnap`: a recording in which the robot is carried elsewhere."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ial.cli.shell.options import LaserPose, OdomTopic, Overwrite, RecordingPath, ScanTopics
from ial.cli.shell.outputs import check_outputs
from ial.cli.shell.terminal import remark, say

if TYPE_CHECKING:
    from ial.datasets.kidnapping import Kidnapping


def kidnap(
    recording: RecordingPath,
    target: Annotated[Path, typer.Argument(metavar="OUT", help="The file to write: .mcap for ROS 2, .bag for ROS 1.")],
    at: Annotated[
        list[str], typer.Option(metavar="A:B", help="Behind scan A goes on with scan B, later or earlier; may be repeated, in order.")
    ],
    truth: Annotated[
        Path | None, typer.Option(metavar="TUM", help="The reference trajectory; put together anew and written beside OUT as .tum.")
    ] = None,
    scan_topic: ScanTopics = None,
    odom_topic: OdomTopic = None,
    laser_pose: LaserPose = None,
    overwrite: Overwrite = False,
) -> None:
    """Write a recording in which the robot is carried from place to place while odometry and clock go on as if nothing happened."""
    from ial.cli.shell.inputs import Inputs
    from ial.datasets.conversion import convert
    from ial.datasets.kidnapping import kidnap
    from ial.datasets.trajectory import read_tum, write_tum

    jumps = [_parsed(text) for text in at]
    beside = target.with_suffix(".tum")
    check_outputs([target] if truth is None else [target, beside], [recording, truth], overwrite)
    reference = None if truth is None else read_tum(truth)
    kidnapped, moved = kidnap(Inputs(recording, None, scan_topic, odom_topic, laser_pose).source(), jumps, reference)
    count = convert(kidnapped, target)
    for reason, skipped in kidnapped.skipped.items():
        remark("skipped", f"{skipped} × {reason}", "yellow")
    for reason, repaired in kidnapped.repaired.items():
        remark("repaired", f"{repaired} × {reason}", "yellow")
    say(f"{count} scans written to {target}, {len(jumps)} {'kidnapping' if len(jumps) == 1 else 'kidnappings'}")
    if moved is not None:
        write_tum(moved, beside)
        say(f"{len(moved)} reference poses written to {beside}")


def _parsed(text: str) -> "Kidnapping":
    from ial.datasets.kidnapping import Kidnapping
    from ial.errors import ConfigError

    before, colon, after = text.partition(":")
    if not colon or not before.strip().isdigit() or not after.strip().isdigit():
        raise ConfigError(f"--at {text}: give two numbers of scans, such as --at 100:400")
    return Kidnapping(int(before), int(after))
