"""Pictures of floors: what of them is free, in every kind of file, and files that are damaged."""

import struct
from pathlib import Path

import cv2
import numpy as np
import pytest

from ial.errors import MapError
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, UNKNOWN
from ial.maps.grids.picture import is_picture, read_picture

PLAN = np.full((40, 64), 255, dtype=np.uint8)
PLAN[:, :8] = PLAN[32:, :] = 0  # a wall on the left and one below, on the lattice of JPEG's blocks, which keep them sharp


@pytest.mark.parametrize("suffix", [".png", ".pgm", ".jpg", ".jpeg", ".bmp", ".PNG"])
def test_light_pixels_are_free_in_every_kind_of_file(suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"plan{suffix}"
    assert is_picture(path)
    assert cv2.imwrite(str(path), PLAN)
    grid = read_picture(path, 0.05)
    assert (grid.resolution, grid.origin.x, grid.origin.y) == (0.05, 0.0, 0.0)
    assert (grid.cells == np.where(PLAN[::-1] > 128, FREE, OCCUPIED)).all()


def test_the_thresholds_are_those_of_a_map_as_map_savers_write_it(tmp_path: Path) -> None:
    levels = np.array([[0, 89, 90, 205, 206, 255]], dtype=np.uint8)
    for suffix in (".png", ".bmp"):
        cv2.imwrite(str(tmp_path / f"a{suffix}"), levels)
        grid = read_picture(tmp_path / f"a{suffix}", 1.0)
        assert grid.cells.tolist() == [[OCCUPIED, OCCUPIED, UNKNOWN, UNKNOWN, FREE, FREE]]


def test_colours_count_by_their_lightness(tmp_path: Path) -> None:
    blue_yellow = np.array([[[255, 0, 0], [0, 255, 255]]], dtype=np.uint8)  # blue, green, red
    for suffix in (".png", ".bmp"):
        cv2.imwrite(str(tmp_path / f"a{suffix}"), blue_yellow)
        assert read_picture(tmp_path / f"a{suffix}", 1.0).cells.tolist() == [[OCCUPIED, FREE]]


def test_what_is_transparent_is_not_free(tmp_path: Path) -> None:
    white = np.full((1, 3, 4), 255, dtype=np.uint8)
    white[0, 1:, 3] = 254, 0
    for suffix in (".png", ".bmp"):
        cv2.imwrite(str(tmp_path / f"a{suffix}"), white)
        assert read_picture(tmp_path / f"a{suffix}", 1.0).cells.tolist() == [[FREE, UNKNOWN, UNKNOWN]]


def test_the_fourth_byte_of_an_old_bitmap_is_no_opacity(tmp_path: Path) -> None:
    pixels = bytes([255, 255, 255, 0, 0, 0, 0, 0])
    header = struct.pack("<IiiHHIIiiII", 40, 2, 1, 1, 32, 0, len(pixels), 0, 0, 0, 0)
    (tmp_path / "a.bmp").write_bytes(b"BM" + struct.pack("<IHHI", 54 + len(pixels), 0, 0, 54) + header + pixels)
    assert read_picture(tmp_path / "a.bmp", 1.0).cells.tolist() == [[FREE, OCCUPIED]]


@pytest.mark.parametrize("suffix", [".png", ".pgm", ".jpg", ".bmp"])
def test_a_picture_that_is_cut_short_is_refused(suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"plan{suffix}"
    cv2.imwrite(str(path), PLAN)
    data = path.read_bytes()
    for count in (20, len(data) // 2, len(data) - 3):
        path.write_bytes(data[:count])
        with pytest.raises(MapError, match=rf"plan\{suffix}: .*(cut short|pixels|damaged|header|ends|holds)"):
            read_picture(path, 0.05)


@pytest.mark.parametrize(
    ("name", "data", "message"),
    [
        ("a.jpg", b"\xff\xd8\xff\xe0 a photograph\xff\xd9", "damaged"),
        ("a.bmp", b"BM" + struct.pack("<I", 60) + bytes(12) + struct.pack("<ii", 10**6, 10**6) + bytes(40), "1000000 × 1000000"),
        ("a.png", b"GIF89a", "neither a PGM"),
        ("a.png", None, "does not exist"),
    ],
)
def test_what_is_no_picture_is_refused(name: str, data: bytes | None, message: str, tmp_path: Path) -> None:
    if data is not None:
        (tmp_path / name).write_bytes(data)
    with pytest.raises(MapError, match=message):
        read_picture(tmp_path / name, 0.05)


@pytest.mark.parametrize("resolution", [0.0, -1.0, float("nan"), 1e-9])
def test_a_resolution_that_cannot_be_meant_is_refused(resolution: float, tmp_path: Path) -> None:
    cv2.imwrite(str(tmp_path / "a.png"), PLAN)
    with pytest.raises(MapError, match="resolution is"):
        read_picture(tmp_path / "a.png", resolution)
