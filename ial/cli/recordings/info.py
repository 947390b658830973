"""`ial info`: what a recording holds, and what it lacks."""

from typing import TYPE_CHECKING

import typer

from ial.cli.shell.options import Json, LaserPose, OdomTopic, RecordingPath, ScanTopics
from ial.cli.shell.terminal import out, remark, say, say_json

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

    found = Inputs(recording, None, scan_topic, odom_topic, laser_pose).source().info()
    if as_json:
        say_json(found.as_dict())
    else:
        _print(found)
    for fault in found.missing:
        remark("missing", fault, "bold red")
    if found.missing:
        raise typer.Exit(2)


def _print(found: "RecordingInfo") -> None:
    from rich.table import Table

    say(f"{found.name}: {found.format}")
    if found.topics:
        table = Table("topic", "type", box=None, pad_edge=False, header_style="bold")
        table.add_column("messages", justify="right")
        for topic in found.topics:
            table.add_row(topic.name, topic.type, str(topic.count))
        out.print(table)
    for name, text in _facts(found):
        say(f"{name:<10}  {text}")


def _facts(found: "RecordingInfo") -> list[tuple[str, str]]:
    """Return what is known, as pairs of a word and a text."""
    facts = []
    if found.scans:
        rate = "" if found.duration_s is None else f" in {found.duration_s:.2f} s, {found.scan_rate_hz:.2f} per second"
        facts.append(("scans", f"{found.scans}{rate}"))
    for name, reasons in (("skipped", found.skipped), ("repaired", found.repaired)):
        facts += [(name, f"{count} × {reason}") for reason, count in reasons.items()]
    if found.beams:
        counts = ", ".join(map(str, found.beams))
        facts.append(("beams", f"{counts} per scan, from {found.angle_min:.4f} by {found.angle_increment:.6f} rad"))
        facts.append(("", ", ".join(f"{count} {kind.replace('_', ' ')}" for kind, count in found.beam_classes.items())))
    if found.range_seen_m is not None:
        nearest, farthest = found.range_seen_m
        facts.append(("ranges", f"{nearest:.3f} to {farthest:.3f} m, limits {found.range_min:g} to {found.range_max:g} m"))
    if found.scans:
        facts.append(("odometry", f"{found.path_m:.1f} m travelled"))
    if found.frames:
        facts.append(("frames", ", ".join(f"{role}: {frame}" for role, frame in found.frames.items())))
    for frame, at in found.mountings.items():
        hangs = ", upside down" if at.upside_down else ""
        facts.append(("laser", f"{frame} at x {at.x:.3f} m, y {at.y:.3f} m, yaw {at.yaw:.4f} rad on the robot{hangs}"))
    return facts
