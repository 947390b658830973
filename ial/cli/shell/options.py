"""Options that several commands share."""

from pathlib import Path
from typing import Annotated, Literal

import typer

RecordingPath = Annotated[
    Path, typer.Argument(metavar="RECORDING", help="A ROS 1 .bag, a ROS 2 folder, .db3 or .mcap, or a CARMEN log (plain or .gz).")
]
ScanTopics = Annotated[
    list[str] | None,
    typer.Option("--scan-topic", metavar="TOPIC", help="The laser scans, if there are several topics; repeated for several lidars."),
]
OdomTopic = Annotated[
    str | None, typer.Option(metavar="TOPIC", help="The odometry, if there are several topics; /tf takes odom → base_link from tf.")
]
LaserPose = Annotated[
    tuple[float, float, float] | None,
    typer.Option(metavar="X Y YAW", help="Where the laser sits in base_link, in metres and radians, in place of what tf_static says."),
]
Semantics = Annotated[
    Literal["nav2", "ros1"], typer.Option("--map-semantics", help="Whose rules turn pixels into free, occupied and unknown.")
]
MapTopic = Annotated[str | None, typer.Option(metavar="TOPIC", help="The map's topic, if MAP is a recording with several.")]
Json = Annotated[bool, typer.Option("--json", help="Print one JSON object on stdout.")]
Overwrite = Annotated[bool, typer.Option("--overwrite", help="Replace files that exist; what the command reads is never replaced.")]
ConfigPath = Annotated[Path | None, typer.Option("--config", metavar="FILE", help="A YAML file with the configuration.")]
