"""`ial info`: what a recording holds, and what it lacks."""

from typing import TYPE_CHECKING

import typer

from ial.cli.shell.options import Json, LaserPose, OdomTopic, RecordingPath, ScanTopics
from ial.cli.shell.terminal import out, remark, say, say_json, visible

if TYPE_CHECKING:
    from ial.datasets.info import RecordingInfo


def info(
    recording: RecordingPath,
    scan_topic: ScanTopics = None,
    odom_topic: OdomTopic = None,
    laser_pose: LaserPose = None,
    as_json: Json = False,
) -> None:
    """Say what a recording holds: topics, counts, rates, beams, ranges, frames, and what is missing.

    The exit status is 2 if something stands in the way of localizing with it.
    """
    from ial.cli.shell.inputs import Inputs

    about = Inputs(recording, None, scan_topic, odom_topic, laser_pose).source().info()
    if as_json:
        say_json(about.as_dict())
    else:
        _print(about)
    for fault in about.missing:
        remark("missing", fault, "bold red")
    if about.missing:
        raise typer.Exit(2)


def _print(about: "RecordingInfo") -> None:
    from rich.table import Table
    from rich.text import Text

    say(f"{about.name}: {about.format}")
    if about.topics:
        table = Table("topic", "type", box=None, pad_edge=False, header_style="bold")
        table.add_column("messages", justify="right")
        for topic in about.topics:
            table.add_row(Text(visible(topic.name)), Text(visible(topic.type)), str(topic.count))
        out.print(table)
    for name, text in _facts(about):
        say(f"{name:<10}  {text}")


def _facts(about: "RecordingInfo") -> list[tuple[str, str]]:
    """Return what is known, as pairs of a word and a text."""
    facts = []
    if about.scans:
        rate = "" if about.duration_s is None else f" in {about.duration_s:.2f} s, {about.scan_rate_hz:.2f} per second"
        facts.append(("scans", f"{about.scans}{rate}"))
    for name, reasons in (("skipped", about.skipped), ("repaired", about.repaired)):
        facts += [(name, f"{count} × {reason}") for reason, count in reasons.items()]
    if about.beams:
        counts = ", ".join(map(str, about.beams))
        facts.append(("beams", f"{counts} per scan, from {about.angle_min:.4f} by {about.angle_increment:.6f} rad"))
        facts.append(("", ", ".join(f"{count} {kind.replace('_', ' ')}" for kind, count in about.beam_classes.items())))
    if about.range_seen_m is not None:
        nearest, farthest = about.range_seen_m
        facts.append(("ranges", f"{nearest:.3f} to {farthest:.3f} m, limits {about.range_min:g} to {about.range_max:g} m"))
    if about.scans:
        facts.append(("odometry", f"{about.path_m:.1f} m travelled"))
    if about.frames:
        facts.append(("frames", ", ".join(f"{role}: {frame}" for role, frame in about.frames.items())))
    for frame, at in about.mountings.items():
        hangs = ", upside down" if at.upside_down else ""
        facts.append(("laser", f"{frame} at x {at.x:.3f} m, y {at.y:.3f} m, yaw {at.yaw:.4f} rad on the robot{hangs}"))
    return facts
