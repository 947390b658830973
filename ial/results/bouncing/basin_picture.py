"""A picture of basins: to which periodic group a robot comes from each cell, one panel for each heading."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt
from matplotlib.colors import to_rgb
from matplotlib.patches import Patch

from ial.bouncing.cells.cell_map import CellMap
from ial.bouncing.cells.graph import disjoint_union
from ial.bouncing.cells.groups import PeriodicGroups, periodic_groups
from ial.results.bouncing.ground import BRIGHT, BounceGround
from ial.results.bouncing.page import BouncePage
from ial.results.palette import FREE

_MOST_PANELS = 16
_NAMED = 8  # the largest basins have a colour of their own
_OTHERS = "#8d99ae"
_PALEST = 0.72  # how near to white a robot is shown that is farthest from its group

FloatArray = npt.NDArray[np.float64]


def draw_basins(path: Path, maps: Sequence[CellMap], grounds: Sequence[BounceGround]) -> None:
    """Write a picture of all environments: the colour tells the group, and paler cells take more steps to it.

    Parameters
    ----------
    path
        The PNG file.
    maps
        The cell maps of the environments, for one bouncing angle.
    grounds
        The environments in the same order.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    graph = disjoint_union([each.graph for each in maps])
    groups = periodic_groups(graph)
    weights = np.ones(len(graph), dtype=np.int64) if graph.weights is None else graph.weights.astype(np.int64)
    basins = np.bincount(groups.group, weights=weights, minlength=groups.count + 1).astype(np.float64)
    largest = np.argsort(-basins[1:], kind="stable")[:_NAMED] + 1
    colours = np.tile(np.array(to_rgb(_OTHERS)), (groups.count + 1, 1))
    colours[largest] = [to_rgb(colour) for colour in BRIGHT[: len(largest)]]
    painted = _painted(groups, colours)

    headings, cell = maps[0].headings, float(maps[0].raster.cell)
    every = [(number, kind) for number in range(len(maps)) for kind in range(len(maps[number].classes))]
    shown = every[:_MOST_PANELS]
    keys = [Patch(color=colours[group], label=_words(groups, basins, int(group))) for group in largest]
    if groups.count > _NAMED:
        keys.append(Patch(color=_OTHERS, label=f"{groups.count - _NAMED} smaller basins"))
    title = f"{', '.join(each.name for each in grounds)[:70]}: basins of {groups.count} periodic group{'s' * (groups.count != 1)}"
    remark = f"bouncing angle {float(headings.bounce_deg):g}°, cells of {cell:g} m; axes in m; paler: more steps, up to "
    remark += f"{groups.longest_transient}" + (f"; {len(shown)} of {len(every)} panels" if len(shown) < len(every) else "")
    page = BouncePage(len(shown), float(np.median([grounds[number].shape for number, _ in shown])), title, remark, keys)
    for axes, (number, kind) in zip(page.panels, shown, strict=True):
        map_ = maps[number]
        first = graph.starts[number] + kind * len(map_.cells[0])
        pixels = np.ones((*map_.raster.free.shape, 3))
        pixels[map_.raster.free] = painted[first : first + len(map_.cells[0])]
        grounds[number].draw(axes, pixels)
        where = f"{grounds[number].name[:14]}, " if len(grounds) > 1 else ""
        axes.set_title(f"{where}{_headings(map_, kind)}", loc="left", fontsize=8.5)
    page.write(path)


def _painted(groups: PeriodicGroups, colours: FloatArray) -> FloatArray:
    """Return the colour of each vertex: that of its group, paler with its steps."""
    far = np.sqrt(groups.step / max(groups.longest_transient, 1))[:, None]
    pale = np.where(groups.step[:, None] > 0, 0.18 + (_PALEST - 0.18) * far, 0.0)
    return np.asarray(colours[groups.group] * (1.0 - pale) + np.array(to_rgb(FREE)) * pale)


def _words(groups: PeriodicGroups, basins: FloatArray, group: int) -> str:
    share = basins[group] / basins.sum()
    return f"group {group}: period {groups.periods[group - 1]}, {share:.1%} of all"


def _headings(map_: CellMap, kind: int) -> str:
    members = map_.classes.members(kind)
    x, y = map_.classes.offsets[kind]
    sign = {(1, 0): "→", (1, 1): "↗", (0, 1): "↑", (-1, 1): "↖", (-1, 0): "←", (-1, -1): "↙", (0, -1): "↓", (1, -1): "↘"}
    mark = sign[(int(np.sign(x)), int(np.sign(y)))]
    angles = [float(map_.headings.angle_deg(member)) for member in members]
    return f"{mark} heading {angles[0]:g}°" if len(angles) == 1 else f"{mark} {len(angles)} headings from {angles[0]:g}°"
