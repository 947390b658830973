"""The rooms of the house as the page on the architecture states them, and a picture of who imports whom.

The tests enforce the same table. `make docs` draws the picture; alone: ``python docs/house.py PICTURE``.
"""

import ast
import re
import sys
from collections.abc import Iterator
from graphlib import TopologicalSorter
from pathlib import Path
from typing import Any, NamedTuple

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "developing" / "architecture.md"

_ROW = re.compile(r"^\| (?P<floor>\d) \| `(?P<path>[^`]*)` \| (?P<holds>[^|]*) \|(?P<siblings>[^|]*)\|$", re.MULTILINE)
_UNDRAWN = {"errors", "lazy", "pose", "whole_file"}  # imported from everywhere: their arrows would hide all others


class Room(NamedTuple):
    """A package or a file of ial, and the floor that it stands on.

    Parameters
    ----------
    floor
        From 0, the ground.
    path
        The folder or the file, from the top of the repository.
    planned
        Whether it is still to come.
    siblings
        The rooms of its own floor that it may import.
    """

    floor: int
    path: Path
    planned: bool
    siblings: frozenset[str]

    def files(self) -> list[Path]:
        """Return the files of the room."""
        return [self.path] if self.path.suffix else sorted(self.path.rglob("*.py"))


def rooms(page: str) -> dict[str, Room]:
    """Return the rooms by their names, from the table of floors of a page.

    Raises
    ------
    ValueError
        If a room stands in the table twice.
    """
    house: dict[str, Room] = {}
    for row in _ROW.finditer(page):
        path = ROOT / row["path"]
        if path.stem in house:
            raise ValueError(f"{PAGE.name}: the room {path.stem} stands in the table of floors twice; leave one")
        siblings = frozenset(re.findall(r"`(\w+)`", row["siblings"]))
        house[path.stem] = Room(int(row["floor"]), path, row["holds"].startswith("to come"), siblings)
    return house


def imported(room: Room) -> Iterator[str]:
    """Yield the rooms that a room imports, itself among them; once for each import."""
    for file in room.files():
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "ial":
                yield from ((f"{node.module}.{alias.name}").split(".")[1] for alias in node.names)


def arrows(house: dict[str, Room]) -> dict[str, set[str]]:
    """Return for each room the others that it imports."""
    return {name: set(imported(room)) - {name} for name, room in house.items()}


def reached(house: dict[str, set[str]]) -> dict[str, set[str]]:
    """Return for each room all that its imports lead to, in one step or several."""
    below: dict[str, set[str]] = {}
    for name in TopologicalSorter(house).static_order():
        below[name] = house[name].union(*(below[other] for other in house[name]))
    return below


def draw(picture: Path) -> None:
    """Draw the rooms on their floors, with an arrow from each to those that it imports; an arrow is pale where a longer way leads there."""
    from matplotlib import pyplot

    house = {name: room for name, room in rooms(PAGE.read_text(encoding="utf-8")).items() if not room.planned}
    leads = {name: others - _UNDRAWN for name, others in arrows(house).items() if name not in _UNDRAWN}
    beyond = reached(leads)
    figure, axes = pyplot.subplots(figsize=(10, 8))
    axes.set(xlim=(-0.2, 3.2), ylim=(-0.4, 5.4))
    axes.axis("off")
    boxes = {}
    for floor in {room.floor for room in house.values()}:
        axes.text(-0.2, floor, f"floor {floor}", va="center", color="0.4")
        texts = [_text(name, house[name]) for name in leads if house[name].floor == floor]
        names = [name for name in leads if house[name].floor == floor]
        if floor == 0:
            names, texts = [*names, ""], [*texts, "\n".join(sorted(_UNDRAWN))]
        for place, (name, text) in enumerate(zip(names, texts, strict=True)):
            boxes[name] = _box(axes, text, 0.2 + 3.0 * (place + 0.5) / len(names), floor, pale=not name)
    figure.canvas.draw()  # only now is it known how far the boxes reach
    for name, others in leads.items():
        for other in others:
            _arrow(axes, boxes[name], boxes[other], pale=any(other in beyond[between] for between in others))
    figure.savefig(picture, dpi=100, bbox_inches="tight")
    pyplot.close(figure)


def _text(name: str, room: Room) -> str:
    """Return the name of a room and of its folders, three in a line."""
    folders = [] if room.path.suffix else sorted(path.name for path in room.path.iterdir() if (path / "__init__.py").exists())
    return "\n".join([name, *(", ".join(folders[start : start + 3]) for start in range(0, len(folders), 3))])


def _box(axes: Any, text: str, x: float, y: float, *, pale: bool) -> Any:
    frame = {"boxstyle": "round,pad=0.5", "facecolor": "0.95" if pale else "#dbe9f6", "edgecolor": "0.7" if pale else "#2b6cb0"}
    return axes.text(x, y, text, ha="center", va="center", fontsize=9, bbox=frame, zorder=3)


def _arrow(axes: Any, start: Any, end: Any, *, pale: bool) -> None:
    """Draw an arrow from the lower side of a box to the upper side of another, or between the sides of neighbours."""
    above, beneath = (box.get_bbox_patch().get_window_extent().transformed(axes.transData.inverted()) for box in (start, end))
    (x, y), (to_x, to_y) = start.get_position(), end.get_position()
    if y == to_y:
        right = to_x > x
        ends = (above.x1 if right else above.x0, y), (beneath.x0 if right else beneath.x1, y)
    else:
        lean = 0.4 * (to_x - x) / (y - to_y)  # so that arrows do not all meet in one point
        ends = tuple(
            (place + max(-0.4 * box.width, min(0.4 * box.width, shift)), side)
            for place, box, shift, side in ((x, above, lean, above.y0), (to_x, beneath, -lean, beneath.y1))
        )
    style = {"arrowstyle": "-|>", "color": "0.85" if pale else "0.25", "connectionstyle": f"arc3,rad={0.1 if pale else 0.0}", "shrinkB": 0}
    axes.annotate("", xy=ends[1], xytext=ends[0], arrowprops=style, zorder=1 if pale else 2)


if __name__ == "__main__":
    draw(Path(sys.argv[1]))
