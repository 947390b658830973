"""Maps of ROS on disk: the rules of both map servers, pixel by pixel; the warning about 205; writing."""

import math
import warnings
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from ial.errors import MapError, OutputError
from ial.maps.grids.map_file import read_map, write_map
from ial.maps.grids.map_warning import MapWarning
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, UNKNOWN, OccupancyGrid
from ial.pose import Pose

F, X, U = FREE, OCCUPIED, UNKNOWN


def save(folder: Path, pixels: np.ndarray, **changes: object) -> Path:
    """Write an image (rows, columns) or (rows, columns, RGB or RGBA) as PNG with a map file beside it."""
    import cv2

    turned = pixels if pixels.ndim == 2 else pixels[:, :, [2, 1, 0, 3][: pixels.shape[2]]]
    assert cv2.imwrite(str(folder / "map.png"), turned)
    values = {"image": "map.png", "resolution": 0.05, "origin": [0, 0, 0], "negate": 0, "occupied_thresh": 0.65, "free_thresh": 0.196}
    (folder / "map.yaml").write_text("".join(f"{key}: {value}\n" for key, value in {**values, **changes}.items()))
    return folder / "map.yaml"


def row(*values: object, kind: type = np.uint8) -> np.ndarray:
    return np.array([values], dtype=kind)


def test_rows_are_flipped_and_columns_are_not(tmp_path: Path) -> None:
    grid = read_map(save(tmp_path, np.array([[0, 254], [254, 254], [205, 254]], np.uint8), origin=[1, 2, 0.5], resolution=0.1))
    assert grid.cells.tolist() == [[U, F], [F, F], [X, F]]
    assert (grid.resolution, grid.origin) == (0.1, Pose(1, 2, 0.5))


@pytest.mark.parametrize(
    ("semantics", "changes", "pixels", "classes"),
    [
        # occupancy is (255 - p) / 255: 153 gives 0.4, 102 gives 0.6
        ("nav2", {}, [0, 89, 90, 205, 206, 255], [X, X, U, U, F, F]),
        ("ros1", {}, [0, 89, 90, 205, 206, 255], [X, X, U, U, F, F]),
        ("nav2", {"occupied_thresh": 0.6, "free_thresh": 0.4}, [101, 102, 103, 152, 153, 154], [X, X, U, U, F, F]),
        ("ros1", {"occupied_thresh": 0.6, "free_thresh": 0.4}, [101, 102, 103, 152, 153, 154], [X, U, U, U, U, F]),
        ("nav2", {"negate": 1}, [0, 49, 50, 165, 166, 255], [F, F, U, U, X, X]),
        ("nav2", {"negate": "true"}, [0, 255], [F, X]),
        ("ros1", {"negate": 1}, [0, 49, 50, 165, 166, 255], [F, F, U, U, X, X]),
        ("nav2", {"mode": "scale"}, [0, 89, 90, 205, 206, 255], [X, X, U, U, F, F]),
        ("ros1", {"mode": "scale"}, [0, 89, 90, 205, 206, 255], [X, X, U, U, F, F]),
        ("nav2", {"mode": "raw"}, [0, 19, 20, 64, 65, 100, 101, 255], [F, F, U, U, X, X, U, U]),
        ("ros1", {"mode": "raw"}, [0, 19, 20, 65, 66, 100, 101, 255], [F, F, U, U, X, X, U, U]),
        ("nav2", {"mode": "raw", "negate": 1}, [0, 19, 100, 255], [F, F, X, U]),  # ignored
        ("ros1", {"mode": "raw", "negate": 1}, [255, 236, 155, 154, 0], [F, F, X, U, U]),  # applied
    ],
)
def test_grey_pixels(tmp_path: Path, semantics: str, changes: dict[str, object], pixels: list[int], classes: list[int]) -> None:
    assert read_map(save(tmp_path, row(*pixels), **changes), semantics).cells.tolist() == [classes]


@pytest.mark.parametrize(
    ("semantics", "mode", "classes"),
    [
        # black, white, grey each opaque; then black and white not quite opaque; then black and white transparent
        ("nav2", "trinary", [X, F, U, U, U, U, U]),
        ("nav2", "scale", [X, F, U, U, U, U, U]),
        ("nav2", "raw", [F, U, U, F, U, F, U]),
        # alpha is a fourth colour: (0 + 0 + 0 + 255) / 4 is occupied by 0.75; transparent white is 0.25, unknown
        ("ros1", "trinary", [X, F, U, X, F, X, U]),
        ("ros1", "scale", [X, F, U, X, F, X, F]),
    ],
)
def test_alpha(tmp_path: Path, semantics: str, mode: str, classes: list[int]) -> None:
    pixels = [(v, v, v, a) for v, a in ((0, 255), (255, 255), (128, 255), (0, 254), (255, 254), (0, 0), (255, 0))]
    assert read_map(save(tmp_path, row(*pixels), mode=mode), semantics).cells.tolist() == [classes]


def test_colours_by_luma_or_by_mean(tmp_path: Path) -> None:
    file = save(tmp_path, row((255, 0, 0), (0, 255, 0), (0, 0, 255), (77, 77, 77)))
    assert read_map(file).cells.tolist() == [[X, U, X, X]]  # green is bright: luma 0.715
    assert read_map(file, "ros1").cells.tolist() == [[X, X, X, X]]  # each 0.667 black


def test_sixteen_bits(tmp_path: Path) -> None:
    file = save(tmp_path, row(0, 22937, 22938, 52690, 52691, 65535, kind=np.uint16))
    assert read_map(file).cells.tolist() == [[X, X, U, U, F, F]]
    raw = save(tmp_path, row(0, 257 * 19, 257 * 65, 257 * 101, kind=np.uint16), mode="raw")
    assert read_map(raw).cells.tolist() == [[F, F, X, U]]


def test_a_pgm_with_another_white(tmp_path: Path) -> None:
    file = save(tmp_path, row(0), image="map.pgm")
    (tmp_path / "map.pgm").write_bytes(b"P2 4 1 100\n0 35 36 100")
    assert read_map(file).cells.tolist() == [[X, X, U, F]]


def test_205_that_becomes_free_is_warned_about(tmp_path: Path) -> None:
    pixels = row(0, 205, 205, 254)
    with pytest.warns(MapWarning, match=r"2 pixels have the grey 205.*free_thresh: 0\.196") as caught:
        grid = read_map(save(tmp_path, pixels, free_thresh=0.25))
    assert grid.cells.tolist() == [[X, F, F, F]]
    assert caught[0].filename == __file__


@pytest.mark.parametrize(
    ("pixels", "changes"),
    [
        (row(0, 205, 254), {"free_thresh": 0.196}),
        (row(0, 204, 254), {"free_thresh": 0.25}),
        (row(0, 205, 254), {"free_thresh": 0.25, "negate": 1}),
        (row(0, 205, 254), {"free_thresh": 0.25, "mode": "raw"}),
        (row((0, 0, 0, 255), (205, 205, 205, 0)), {"free_thresh": 0.25}),
    ],
)
def test_no_warning_without_reason(tmp_path: Path, pixels: np.ndarray, changes: dict[str, object]) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        read_map(save(tmp_path, pixels, **changes))


@pytest.mark.parametrize("value", [0, 128, 255])
def test_maps_of_one_class_are_read(tmp_path: Path, value: int) -> None:
    assert len(np.unique(read_map(save(tmp_path, np.full((3, 4), value, np.uint8))).cells)) == 1


def test_errors_name_the_file_at_fault(tmp_path: Path) -> None:
    file = save(tmp_path, row(0), image="nowhere.png")
    with pytest.raises(MapError, match=r"nowhere\.png"):
        read_map(file)
    with pytest.raises(MapError, match="'nav2' or 'ros1'"):
        read_map(save(tmp_path, row(0)), "ros3")  # type: ignore[arg-type]


@pytest.mark.parametrize("suffix", ["yaml", "yml"])
def test_what_is_written_is_read_to_the_last_bit(tmp_path: Path, suffix: str) -> None:
    cells = np.random.default_rng(4).integers(0, 3, (17, 23), dtype=np.uint8)
    grid = OccupancyGrid(cells, 0.1 + 0.2, Pose(-1e-7, 12345.678901234567, math.pi))
    file = tmp_path / f"#a map: of {{some}} 'plän'.{suffix}"
    write_map(grid, file)
    for semantics in ("nav2", "ros1"):
        read = read_map(file, semantics)
        assert (read.cells == cells).all()
        assert (read.resolution, read.origin) == (grid.resolution, grid.origin)
    assert sorted(each.suffix for each in tmp_path.iterdir()) == [".pgm", f".{suffix}"]


def test_writing_where_it_cannot_be(tmp_path: Path) -> None:
    grid = OccupancyGrid(np.zeros((2, 2), np.uint8), 0.05)
    with pytest.raises(OutputError, match="cannot be written"):
        write_map(grid, tmp_path / "no folder" / "map.yaml")
    with pytest.raises(OutputError, match=r"ends in \.yaml"):
        write_map(grid, tmp_path / "map.pgm")
    assert not list(tmp_path.iterdir())


@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    image=st.binary(max_size=100),
    start=st.sampled_from([b"", b"P5 4 3 255\n", b"P2 2 2 99\n", b"\x89PNG\r\n\x1a\n"]),
    mode=st.sampled_from(["trinary", "raw"]),
)
def test_random_images_are_a_map_or_an_error(tmp_path: Path, image: bytes, start: bytes, mode: str) -> None:
    file = save(tmp_path, row(0), image="random.pgm", mode=mode)
    (tmp_path / "random.pgm").write_bytes(start + image)
    try:
        text = f"random.pgm was read: {read_map(file).cells.shape}"
    except MapError as error:
        text = str(error)
    assert "random.pgm" in text


@pytest.mark.filterwarnings("always::ial.maps.grids.map_warning.MapWarning")
def test_real_maps(data_folder: Path) -> None:
    files = sorted(data_folder.glob("*/map*.yaml"))
    assert len(files) >= 8
    for file in files:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            counts = read_map(file).describe()["cells"]
        assert counts["occupied"] > 500
        assert counts["free"] > 10_000
        assert bool(caught) is (file.parent.name == "olin_mac_tb4")  # the one with free_thresh 0.25
