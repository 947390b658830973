"""One filter, which every picture of a bouncing robot is made of, and the pixels of a picture."""

from fractions import Fraction
from pathlib import Path

import cv2
import numpy as np
import numpy.typing as npt

from ial.bouncing.cells.cell_map import CellMap
from ial.bouncing.cells.headings import Headings
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.bouncing.filters.building import build_filter
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.outline import outlines
from ial.maps.polygons.raster import rasterize
from ial.results.bouncing.ground import BounceGround
from ial.results.palette import rgb

Image = npt.NDArray[np.uint8]
ROOM = np.ones((4, 6), dtype=np.bool_)
ROOM[2:, :2] = False
NOOK = np.ones((3, 3), dtype=np.bool_)
ENVIRONMENTS = {name: Environment(outlines(free, Fraction(1)), Fraction(1)) for name, free in (("room", ROOM), ("nook", NOOK))}


def built(names: list[str], headings: int = 4) -> tuple[BounceFilter, list[BounceGround], list[CellMap]]:
    chosen = {name: ENVIRONMENTS[name] for name in names}
    turns = Headings.of_angle(Fraction(90), headings)
    grounds = [BounceGround(name, rasterize(each, Fraction(1))) for name, each in chosen.items()]
    return build_filter(chosen, turns), grounds, [CellMap(ground.raster, turns, merge=True) for ground in grounds]


def read(path: Path) -> Image:
    image = cv2.imread(str(path))
    assert image is not None
    assert list(path.parent.iterdir()) == [path], "no half file is left"
    return image[..., ::-1].astype(np.uint8)


def pixels(image: Image, colour: str) -> int:
    return int((np.abs(image - np.array(rgb(colour)) * 255.0).max(axis=2) < 2.0).sum())
