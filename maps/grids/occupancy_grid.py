"""`OccupancyGrid`: the map that a lidar is localized in."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import Boxes
from ial.errors import MapError
from ial.maps.grids.rigid_transform import boxes_from_frame, boxes_into_frame
from ial.pose import Pose

FREE, OCCUPIED, UNKNOWN = 0, 1, 2
CLASS_NAMES = ("free", "occupied", "unknown")

LARGEST_SIDE = 2**16  # cells; the margins of `ial.lidar.margins` are proved for tables up to here
LARGEST_AREA = 2**30  # cells; what fits into the memory of an ordinary computer, and into 32-bit counts
SMALLEST_RESOLUTION, LARGEST_RESOLUTION = 1e-6, 1e3  # metres; beyond these a number is a mistake or another unit

_UNMOVED = Pose()

FloatArray = npt.NDArray[np.float64]
MaskArray = npt.NDArray[np.bool_]


def check_resolution(resolution: float) -> None:
    """Raise `MapError` unless a resolution is a width of a cell in metres that can be meant."""
    if not (math.isfinite(resolution) and resolution > 0.0):
        raise MapError(f"the resolution is {resolution}; give the width of a cell in metres, a finite number greater than 0")
    if not SMALLEST_RESOLUTION <= resolution <= LARGEST_RESOLUTION:
        raise MapError(
            f"the resolution is {resolution} m per cell; give it in metres, between {SMALLEST_RESOLUTION:g} and {LARGEST_RESOLUTION:g}"
        )


def check_size(rows: int, columns: int) -> None:
    """Raise `MapError` unless a grid of this many cells can be used."""
    if rows < 1 or columns < 1:
        raise MapError(f"the map has {columns} × {rows} cells; give at least one")
    if rows > LARGEST_SIDE or columns > LARGEST_SIDE or rows * columns > LARGEST_AREA:
        raise MapError(
            f"the map has {columns} × {rows} cells; at most 2**16 = {LARGEST_SIDE} per side and 2**30 in all are supported: "
            "crop it, or use larger cells"
        )


@dataclass(frozen=True, eq=False)
class OccupancyGrid:
    """A plane of square cells, each free, occupied or unknown.

    The *grid frame* has its origin at the lower left corner of the map, x along the rows and y along the columns, in metres. Cell (row,
    column) is the closed square [column·r, (column+1)·r] × [row·r, (row+1)·r] of it. The *map frame* (REP-105) is the one poses are
    published in; the grid may lie in it shifted and rotated.

    Parameters
    ----------
    cells
        One of `FREE`, `OCCUPIED`, `UNKNOWN` each, uint8 of shape (rows, columns), row 0 at the bottom. Kept as a read-only view.
    resolution
        The width r of a cell in metres.
    origin
        T_map_grid: the pose of the lower left corner in the map frame, as in ``nav_msgs/MapMetaData``.

    Raises
    ------
    MapError
        If the cells are empty, too many (2**16 per side, 2**30 in all) or of another type or class, the resolution is not a positive
        finite number, or the origin is not finite.
    """

    cells: npt.NDArray[np.uint8]
    resolution: float
    origin: Pose = _UNMOVED

    def __post_init__(self) -> None:
        cells = np.asarray(self.cells)
        if cells.ndim != 2 or cells.dtype != np.uint8:
            raise MapError(f"the cells are an array of {cells.dtype} with shape {cells.shape}; give uint8 with shape (rows, columns)")
        check_size(*cells.shape)
        if cells.max() > UNKNOWN:
            raise MapError(f"a cell has the class {cells.max()}; give {FREE} (free), {OCCUPIED} (occupied) or {UNKNOWN} (unknown)")
        check_resolution(self.resolution)
        at = (self.origin.x, self.origin.y, self.origin.theta)
        if not all(map(math.isfinite, at)):
            raise MapError(f"the origin of the map is {at}; give finite numbers (x, y in metres, yaw in radians)")
        view = np.ascontiguousarray(cells).view()
        view.setflags(write=False)
        object.__setattr__(self, "cells", view)
        object.__setattr__(self, "resolution", float(self.resolution))

    def __repr__(self) -> str:
        return f"<OccupancyGrid: {self.columns} × {self.rows} cells of {self.resolution} m, lower left corner at {self.origin}>"

    def _repr_png_(self) -> bytes:
        """Return a picture for a notebook."""
        from ial.maps.grids.grid_picture import png

        return png(self.cells)

    @property
    def rows(self) -> int:
        """The number of cells along y."""
        return int(self.cells.shape[0])

    @property
    def columns(self) -> int:
        """The number of cells along x."""
        return int(self.cells.shape[1])

    @property
    def width_m(self) -> float:
        """The extent along x in metres, rounded to nearest."""
        return self.columns * self.resolution

    @property
    def height_m(self) -> float:
        """The extent along y in metres, rounded to nearest."""
        return self.rows * self.resolution

    def mask(self, *classes: int) -> MaskArray:
        """Return which cells are of one of these classes, bool of shape (rows, columns)."""
        marked = np.zeros(self.cells.shape, dtype=np.bool_)
        for each in classes:
            if each not in (FREE, OCCUPIED, UNKNOWN):
                raise ValueError(f"{each} is no class of cells; give FREE, OCCUPIED or UNKNOWN")
            marked |= self.cells == each
        return marked

    def to_map(self, x: npt.ArrayLike, y: npt.ArrayLike, theta: npt.ArrayLike = 0.0) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return poses of the grid frame as poses of the map frame, in plain double precision: for data and pictures, never for a bound."""
        c, s = math.cos(self.origin.theta), math.sin(self.origin.theta)
        x, y = np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)
        return self.origin.x + c * x - s * y, self.origin.y + s * x + c * y, _wrapped(theta, self.origin.theta)

    def to_grid(self, x_map: npt.ArrayLike, y_map: npt.ArrayLike, theta: npt.ArrayLike = 0.0) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return poses of the map frame as poses of the grid frame, in plain double precision: for data and pictures, never for a bound."""
        c, s = math.cos(self.origin.theta), math.sin(self.origin.theta)
        x, y = np.asarray(x_map, dtype=np.float64) - self.origin.x, np.asarray(y_map, dtype=np.float64) - self.origin.y
        return c * x + s * y, c * y - s * x, _wrapped(theta, -self.origin.theta)

    def pose_to_map(self, pose: Pose) -> Pose:
        """Return a pose of the grid frame as a pose of the map frame, in plain double precision."""
        return self.origin @ pose

    def pose_to_grid(self, pose: Pose) -> Pose:
        """Return a pose of the map frame as a pose of the grid frame, in plain double precision."""
        x, y, theta = self.to_grid(pose.x, pose.y, pose.theta)
        return Pose(float(x), float(y), float(theta))

    def boxes_to_map(self, boxes: Boxes) -> Boxes:
        """Return boxes (x, y, θ) around the same poses, of the grid frame in and of the map frame out, rounded outward."""
        return boxes_from_frame(boxes, self.origin)

    def boxes_to_grid(self, boxes: Boxes) -> Boxes:
        """Return boxes (x, y, θ) around the same poses, of the map frame in and of the grid frame out, rounded outward."""
        return boxes_into_frame(boxes, self.origin)

    def describe(self) -> dict[str, Any]:
        """Return size, resolution, origin, and the number and area of the cells of each class, as plain values that JSON can hold."""
        counts = {name: int(np.count_nonzero(self.cells == index)) for index, name in enumerate(CLASS_NAMES)}
        return {
            "columns": self.columns,
            "rows": self.rows,
            "width_m": self.width_m,
            "height_m": self.height_m,
            "resolution_m": self.resolution,
            "origin": {"x": self.origin.x, "y": self.origin.y, "theta": self.origin.theta},
            "cells": counts,
            "area_m2": {name: count * self.resolution**2 for name, count in counts.items()},
        }


def _wrapped(theta: npt.ArrayLike, turn: float) -> FloatArray:
    """Return θ plus a turn, in [-π, π]; an angle that is already there keeps its bits."""
    angle = np.asarray(theta, dtype=np.float64) + turn
    return np.asarray(np.where(np.abs(angle) <= math.pi, angle, angle - 2.0 * math.pi * np.rint(angle / (2.0 * math.pi))))


def check_usable(grid: OccupancyGrid, domain: tuple[int, ...] = (FREE,)) -> None:
    """Raise unless a map can serve for localization.

    Parameters
    ----------
    grid
        The map.
    domain
        The classes of cells in which the robot may be.

    Raises
    ------
    MapError
        If no cell is occupied, so that no beam could tell one pose from another, or none belongs to the domain.
    """
    counts = [np.count_nonzero(grid.cells == each) for each in range(len(CLASS_NAMES))]
    held = ", ".join(f"{count} {name}" for count, name in zip(counts, CLASS_NAMES, strict=True))
    if not counts[OCCUPIED]:
        raise MapError(
            f"the map has no occupied cell ({held}), so there is nothing to localize against; check the image, negate and occupied_thresh"
        )
    if not any(counts[each] for each in domain):
        wanted = " or ".join(CLASS_NAMES[each] for each in domain)
        raise MapError(f"the map has no {wanted} cell ({held}), so the robot can be nowhere; check the image, negate and free_thresh")
