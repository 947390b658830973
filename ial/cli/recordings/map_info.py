"""`ial map info`: what a map holds, and whether one can localize in it."""

from pathlib import Path
from typing import Annotated

import typer

from ial.cli.shell.options import Json, MapTopic, Semantics
from ial.cli.shell.terminal import say, say_json


def map_info(
    path: Annotated[Path, typer.Argument(metavar="MAP", help="A map.yaml, or a recording with a nav_msgs/OccupancyGrid topic.")],
    semantics: Semantics = "nav2",
    map_topic: MapTopic = None,
    as_json: Json = False,
) -> None:
    """Say what a map holds: size, resolution, origin, and its free, occupied and unknown cells."""
    from ial.cli.shell.inputs import Inputs
    from ial.maps.grids.occupancy_grid import check_usable

    grid = Inputs(map_path=path, semantics=semantics, map_topic=map_topic).grid()
    facts = grid.describe()
    if as_json:
        say_json(facts)
    else:
        origin, total = facts["origin"], facts["columns"] * facts["rows"]
        say(f"{path}: {facts['width_m']:.2f} × {facts['height_m']:.2f} m, {facts['columns']} × {facts['rows']} cells")
        say(f"resolution  {facts['resolution_m']:g} m per cell")
        say(f"origin      x {origin['x']:g} m, y {origin['y']:g} m, yaw {origin['theta']:g} rad")
        for name, count in facts["cells"].items():
            say(f"{name:<10}  {count} cells, {facts['area_m2'][name]:.1f} m², {100.0 * count / total:.1f} %")
    check_usable(grid)
