"""`read_picture`: a picture of a floor, drawn or photographed, as an occupancy grid whose cells are its pixels."""

import struct
from pathlib import Path

import numpy as np

from ial.errors import MapError
from ial.maps.grids.image_file import Image, read_image
from ial.maps.grids.map_file import classified
from ial.maps.grids.map_metadata import MapMetadata
from ial.maps.grids.occupancy_grid import OccupancyGrid, check_resolution, check_size
from ial.pose import Pose

PICTURES = (".png", ".pgm", ".jpg", ".jpeg", ".bmp")
_FREE_THRESH, _OCCUPIED_THRESH = 0.196, 0.65  # of a map.yaml as map savers write it
_JPEG, _JPEG_END, _BMP = b"\xff\xd8\xff", b"\xff\xd9", b"BM"


def is_picture(path: Path) -> bool:
    """Return whether the name of a file ends as that of a picture, in small or capital letters."""
    return path.suffix.lower() in PICTURES


def read_picture(path: Path, resolution: float) -> OccupancyGrid:
    """Read a picture, its lower left corner at (0, 0).

    Light pixels are free and dark ones occupied, as in a map file of the mode trinary with ``free_thresh: 0.196`` and
    ``occupied_thresh: 0.65``: free from a grey of 206 of 255 on, occupied up to 89. Those between, and those that are not fully opaque, are
    unknown. What the file is (PNG, PGM, JPEG or BMP) is told by its content.

    Parameters
    ----------
    path
        The picture.
    resolution
        The width of a pixel in metres.

    Raises
    ------
    MapError
        If the file is missing, damaged, cut short or of another kind, or the resolution cannot be meant.
    """
    check_resolution(resolution)
    if not path.is_file():
        raise MapError(f"{path}: the picture does not exist, or is no file; check the path")
    metadata = MapMetadata(path, resolution, Pose(), False, _FREE_THRESH, _OCCUPIED_THRESH)
    return OccupancyGrid(classified(_image(path), metadata, "nav2")[::-1], resolution)


def _image(path: Path) -> Image:
    """Return the pixels. JPEG and BMP are read here, for map files are never in these."""
    try:
        with path.open("rb") as file:
            begin = file.read(3)
        if not begin.startswith((_JPEG, _BMP)):
            return read_image(path)
        data = path.read_bytes()
    except OSError as error:
        raise MapError(f"{path}: the picture cannot be read ({error.strerror or error}); check the path") from None
    try:
        jpeg = begin == _JPEG
        if not (_jpeg_is_whole(data) if jpeg else _bmp_is_whole(data)):  # a decoder would fill in what is missing
            raise MapError("the picture is cut short; save it again")
        return _decoded(data, with_alpha=not jpeg and _has_alpha(data))
    except MapError as error:
        raise MapError(f"{path}: {error}") from None


def _jpeg_is_whole(data: bytes) -> bool:
    return data.rstrip(b"\0").endswith(_JPEG_END)


def _bmp_is_whole(data: bytes) -> bool:
    if len(data) < 26:
        return False
    (size,) = struct.unpack_from("<I", data, 2)
    columns, rows = struct.unpack_from("<ii", data, 18)
    check_size(abs(rows), columns)
    return int(size) <= len(data)


def _has_alpha(bmp: bytes) -> bool:
    """Return whether a bitmap says which bits hold the opacity; the fourth byte of an older one means nothing."""
    header, bits, compression = struct.unpack_from("<I", bmp, 14)[0], *struct.unpack_from("<HI", bmp[:34].ljust(34, b"\0"), 28)
    return bits == 32 and header >= 56 and compression == 3 and len(bmp) >= 70 and any(bmp[66:70])


def _decoded(data: bytes, with_alpha: bool) -> Image:
    """Return the pixels as a viewer shows them: a photograph is turned as its camera was held."""
    import cv2

    try:
        decoded = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED if with_alpha else cv2.IMREAD_COLOR)
    except cv2.error as error:
        raise MapError(f"the picture cannot be decoded ({error.err or error}); save it as PNG") from None
    if decoded is None:
        raise MapError("the picture is damaged, or of a kind that is not supported; save it as PNG")
    pixels = np.asarray(decoded)
    check_size(*pixels.shape[:2])
    return Image(pixels[:, :, 2::-1], pixels[:, :, 3] if with_alpha else None, 255)
