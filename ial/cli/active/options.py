"""Options of `ial explore`."""

from pathlib import Path
from typing import Annotated, Literal

import typer

SPARE_M = 0.15
"""By how much the clearance is larger than the radius, if nobody says (m)."""

EMBEDDED_MAP, EMBEDDED_START = "plan:office", (17.6, 9.8, -1.3)
"""What is explored if nobody says: from here, a robot needs both stages of the planner."""

STARTS = 10
"""From so many starts planners are compared, if nobody says."""

PlannerName = Literal["direction", "entropy", "target", "random", "frontier"]

MapChoice = Annotated[
    str | None,
    typer.Option(
        "--map",
        metavar="MAP",
        help="A map.yaml, a recording with a nav_msgs/OccupancyGrid topic, or plan:NAME for an embedded floor plan: rooms, office, "
        "corridors, curved, detached, ring. The office if it is left out.",
    ),
]
WorldChoice = Annotated[
    str | None,
    typer.Option("--world", metavar="MAP", help="What the robot really drives in, if it differs from the map; the same if left out."),
]
Start = Annotated[
    tuple[float, float, float] | None,
    typer.Option(
        metavar="X Y θ",
        help="Where the robot starts, in metres and radians; drawn with the seed if left out; without --map, a place of the office.",
    ),
]
Planning = Annotated[PlannerName, typer.Option(help="What chooses the next drive.")]
Drives = Annotated[int, typer.Option(metavar="N", help="Give up after so many drives.")]
Seed = Annotated[int, typer.Option(min=0, help="The same seed gives the same start, errors and choices.")]
Radius = Annotated[float, typer.Option(metavar="M", help="Radius of the robot.")]
Clearance = Annotated[
    float | None,
    typer.Option(
        metavar="M",
        help="What it keeps to everything where it looks, from its centre: `robot_radius_m` of the configuration.",
        show_default=f"{SPARE_M:g} m more than the radius",
    ),
]
Range = Annotated[float, typer.Option("--range", metavar="M", help="How far the lidar sees.")]
Beams = Annotated[int, typer.Option(metavar="N", help="Beams per scan.")]
FieldOfView = Annotated[float, typer.Option("--fov", metavar="DEGREES", help="Angle that the lidar sees, ahead in the middle.")]
RangeError = Annotated[float, typer.Option("--range-error-m", help="Bound of the error of a range.")]
BearingError = Annotated[float, typer.Option("--bearing-error-rad", help="Bound of the error of a bearing.")]
BadBeams = Annotated[int, typer.Option(metavar="N", help="At most so many bad beams per scan.")]
Adversarial = Annotated[bool, typer.Option("--adversarial", help="Errors are as large as their bounds allow.")]
Outliers = Annotated[
    str | None,
    typer.Option(
        metavar="Q",
        help="How many of the used beams the localizer takes for possibly bad: a whole number, a fraction like 0.2, or auto.",
        show_default="as many as --bad-beams",
    ),
]
Settings = Annotated[
    list[str] | None, typer.Option("--set", metavar="KEY=VALUE", help="Any other key of the configuration; may be repeated.")
]
Alpha = Annotated[float | None, typer.Option(help="Weight of how many places read differently.", show_default="0.95")]
Beta = Annotated[float | None, typer.Option(help="Weight of by how much they do.", show_default="0.05")]
Raw = Annotated[bool, typer.Option("--raw", help="Weigh differences in metres, as the paper does.")]
Guaranteed = Annotated[bool, typer.Option("--guaranteed", help="Compare bounds of what can be read, and not single readings.")]
Animation = Annotated[
    Path | None, typer.Option("--animate", metavar="FILE", help="Write a film of the run: a name that ends in .gif or .mp4.")
]
Compare = Annotated[bool, typer.Option("--compare", help="Drive from the same starts with every planner, and print a table.")]
Starts = Annotated[
    int | None, typer.Option(metavar="N", help="With --compare: from so many starts, which are drawn.", show_default=str(STARTS))
]
