"""Maps as ROS keeps them: a YAML file beside an image (map_server of ROS 1, nav2_map_server of ROS 2)."""

import warnings
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import yaml

from ial.errors import MapError, OutputError
from ial.maps.grids.image_file import Image, read_image
from ial.maps.grids.map_metadata import MapMetadata, Semantics, read_metadata
from ial.maps.grids.map_warning import MapWarning
from ial.maps.grids.occupancy_class import classify_occupancy
from ial.maps.grids.occupancy_grid import FREE, UNKNOWN, OccupancyGrid
from ial.maps.grids.pgm import encode_pgm
from ial.whole_file import whole_files

SAVED_UNKNOWN = 205  # the grey that map savers write for unknown; its occupancy is 50 / 255 = 0.19608
_SAVED_GREY = np.array([254, 0, SAVED_UNKNOWN], dtype=np.uint8)  # of free, occupied, unknown
_LUMA = np.array([212656, 715158, 72186])  # red, green, blue of ITU-R BT.709, in millionths

ClassArray = npt.NDArray[np.uint8]
LevelArray = npt.NDArray[Any]


def read_map(path: str | Path, semantics: Semantics = "nav2") -> OccupancyGrid:
    """Read a map from its YAML file.

    The occupancy of a pixel is its blackness, (white − value) / white, or with ``negate`` its brightness. The thresholds of the file are
    applied to it once, in every mode, so that a pixel becomes

    ============  ==========================================  ==========================================
    mode          nav2                                        ros1
    ============  ==========================================  ==========================================
    trinary       occupied if >= ``occupied_thresh``, free    occupied if >, free if <, else unknown; alpha
                  if <= ``free_thresh``, else unknown; not    counts as a fourth colour
                  fully opaque: unknown
    scale         the same: the in-between values of 1 to     the same as trinary without alpha
                  99 are neither free nor occupied
    raw           value v of 0 to 100 is the occupancy        the same with > and <, and ``negate`` is applied
                  v / 100, others are unknown; ``negate``
                  and alpha are ignored
    colours       luma (BT.709)                               mean
    ============  ==========================================  ==========================================

    Parameters
    ----------
    path
        The YAML file. ``image:`` in it is relative to its folder; ``~/`` is the home folder.
    semantics
        Whose rules to follow: "nav2" (ROS 2) or "ros1".

    Raises
    ------
    MapError
        If a file is missing, damaged, or says something impossible. A map without an occupied or a free cell is read; `check_usable`
        tells whether it can serve.

    Warns
    -----
    MapWarning
        If pixels of 205, the grey that map savers write for unknown, become free: ``free_thresh: 0.25`` does that.
    """
    path = Path(path)
    metadata = read_metadata(path)
    if semantics not in ("nav2", "ros1"):
        raise MapError(f"the semantics {semantics!r} of a map file is unknown; give 'nav2' or 'ros1'")
    image = read_image(metadata.image)
    cells = classified(image, metadata, semantics)
    _warn_about_205(image, cells, metadata, path)
    try:
        return OccupancyGrid(cells[::-1], metadata.resolution, metadata.origin)
    except MapError as error:
        raise MapError(f"{path}: {error}") from error


def classified(image: Image, metadata: MapMetadata, semantics: Semantics) -> ClassArray:
    """Return the classes of all pixels, by way of a table of all levels of grey."""
    ros1 = semantics == "ros1"
    level, white = _mean_level(image, metadata.mode == "trinary") if ros1 else _luma_level(image)
    levels = np.arange(white + 1)
    raw = metadata.mode == "raw"
    if (ros1 and metadata.negate) if raw else not metadata.negate:
        levels = levels[::-1]
    if raw:
        value = (510 * levels + white) // (2 * white)  # of 0 … 255, to nearest
        table = classify_occupancy(value / 100, metadata.free_thresh, metadata.occupied_thresh, ros1)
        table[value > 100] = UNKNOWN
    else:
        table = classify_occupancy(levels / white, metadata.free_thresh, metadata.occupied_thresh, ros1)
    cells = table[level]
    if image.alpha is not None and not raw and not ros1:
        cells[image.alpha < image.maximum] = UNKNOWN
    return cells


def _mean_level(image: Image, with_alpha: bool) -> tuple[LevelArray, int]:
    """Return the sums of all channels, and the sum for white."""
    channels = [image.colour] if image.colour.shape[2] == 3 or image.alpha is None else [image.colour] * 3
    if with_alpha and image.alpha is not None:
        channels.append(image.alpha[:, :, None])
    joined = np.concatenate(channels, axis=2)
    return joined.sum(axis=2, dtype=np.int32), image.maximum * joined.shape[2]


def _luma_level(image: Image) -> tuple[LevelArray, int]:
    if image.colour.shape[2] == 1:
        return image.colour[:, :, 0], image.maximum
    weighted = image.colour.astype(np.int64) @ _LUMA
    return (weighted + 500_000) // 1_000_000, image.maximum


def _warn_about_205(image: Image, cells: ClassArray, metadata: MapMetadata, path: Path) -> None:
    if metadata.mode == "raw" or image.maximum != 255:
        return
    count = int(np.count_nonzero((image.colour == SAVED_UNKNOWN).all(axis=2) & (cells == FREE)))
    if count:
        warnings.warn(
            f"{path}: {count} pixels have the grey 205, which map savers write for unknown, but free_thresh {metadata.free_thresh} makes "
            "them free; if they are unknown, write free_thresh: 0.196",
            MapWarning,
            stacklevel=3,
        )


def write_map(grid: OccupancyGrid, path: str | Path) -> None:
    """Write a map as a YAML file and, beside it under the same name, an image in PGM: free 254, occupied 0, unknown 205.

    `read_map` gives back the same cells, and the same numbers to the last bit. The two files appear together.

    Raises
    ------
    OutputError
        If the name does not end in .yaml or .yml, or the folder cannot be written.
    """
    path = Path(path)
    if path.suffix not in (".yaml", ".yml"):
        raise OutputError(f"{path}: a map is written as a YAML file with an image beside it; give a name that ends in .yaml")
    image = path.with_suffix(".pgm")
    metadata = {
        "image": image.name,
        "mode": "trinary",
        "resolution": grid.resolution,
        "origin": [grid.origin.x, grid.origin.y, grid.origin.theta],
        "negate": 0,
        "occupied_thresh": 0.65,
        "free_thresh": 0.196,
    }
    with whole_files(image, path, what="the map") as (pixels, text):
        pixels.write_bytes(encode_pgm(_SAVED_GREY[grid.cells[::-1]]))
        text.write_bytes(yaml.safe_dump(metadata, sort_keys=False, default_flow_style=None, allow_unicode=True).encode())
