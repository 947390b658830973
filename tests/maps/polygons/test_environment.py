import json
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from ial.errors import MapError
from ial.maps.grids.map_file import write_map
from ial.maps.grids.map_warning import MapWarning
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.maps.polygons.environment import Environment, load_environment
from ial.maps.polygons.geojson import parse_geojson
from ial.maps.polygons.polygon import Polygon
from ial.maps.polygons.polygon_json import parse_polygon_json, polygon_json
from ial.maps.polygons.svg import parse_svg
from ial.maps.polygons.wkt import parse_wkt, wkt
from ial.pose import Pose

RING = [[0, 0], [8, 0], [8, 4], [0, 4], [0, 0]]
HOLE = [[1, 1], [1, 2], [2, 2], [2, 1], [1, 1]]
WKT = "POLYGON ((0 0, 8 0, 8 4, 0 4, 0 0), (1 1, 1 2, 2 2, 2 1, 1 1))"
GEOJSON = json.dumps({"type": "Polygon", "coordinates": [RING, HOLE]})
CANONICAL = '{"polygons": [{"outer": [["0","0"],["8","0"],["8","4"],["0","4"]], "holes": [[["1","1"],["1","2"],["2","2"],["2","1"]]]}]}'
SVG = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0,0 H8 V-4 h-8 Z M1-1 l0-1 1 0 0 1z"/></svg>'


@pytest.mark.parametrize(
    ("name", "text"), [("a.wkt", WKT), ("a.geojson", GEOJSON), ("a.json", CANONICAL), ("a.svg", SVG)], ids=lambda value: value[:6]
)
def test_the_same_environment_in_every_format(name: str, text: str, tmp_path: Path) -> None:
    path = tmp_path / name
    path.write_text(text)
    environment = load_environment(path)
    assert environment.area == 31
    assert environment.bounds == (0, 0, 8, 4)
    assert environment.polygons == parse_wkt(WKT)


def test_coordinates_are_not_rounded() -> None:
    (polygon,) = parse_polygon_json('{"polygons": [{"outer": [["1/3", 0], [0.1, 1], [1e-3, "2/7"]]}]}')
    assert polygon.outer[1] == (Fraction(1, 1000), Fraction(2, 7)) or (Fraction(1, 10), Fraction(1)) in polygon.outer
    assert {x for x, _ in polygon.outer} == {Fraction(1, 3), Fraction(1, 10), Fraction(1, 1000)}
    assert parse_polygon_json(polygon_json([polygon])) == (polygon,)


def test_several_polygons() -> None:
    both = parse_wkt("MULTIPOLYGON (((0 0, 1 0, 0 1, 0 0)), ((5 5, 6 5, 5 6, 5 5)))")
    assert len(both) == 2
    assert parse_wkt(wkt(both)) == both
    assert parse_wkt(wkt(both[:1])) == both[:1]
    features = [{"type": "Feature", "geometry": {"type": "MultiPolygon", "coordinates": [[RING], [[[x + 20, y, 0] for x, y in RING]]]}}]
    assert sum(each.area for each in parse_geojson(json.dumps({"type": "FeatureCollection", "features": features}))) == 64


def test_the_free_cells_of_a_map_are_the_environment(tmp_path: Path) -> None:
    cells = np.zeros((5, 7), dtype=np.uint8)
    cells[2, 3] = 1
    cells[0, 0] = 2
    write_map(OccupancyGrid(cells, 0.05), tmp_path / "map.yaml")
    environment = load_environment(tmp_path / "map.yaml")
    assert environment.cell == Fraction(1, 20)
    assert environment.area == Fraction(33, 400)
    assert environment.bounds == (0, 0, Fraction(7, 20), Fraction(1, 4))


def test_places_are_in_the_map_frame_unless_the_grid_is_turned_in_it(tmp_path: Path) -> None:
    cells = np.zeros((5, 7), dtype=np.uint8)
    write_map(OccupancyGrid(cells, 0.05, Pose(-1.5, 2.25)), tmp_path / "map.yaml")
    assert load_environment(tmp_path / "map.yaml").bounds == (Fraction(-3, 2), Fraction(9, 4), Fraction(-23, 20), Fraction(5, 2))
    write_map(OccupancyGrid(cells, 0.05, Pose(-1.5, 2.25, 0.5)), tmp_path / "turned.yaml")
    with pytest.warns(MapWarning, match=r"turned by 0.5 rad"):
        assert load_environment(tmp_path / "turned.yaml").bounds == (0, 0, Fraction(7, 20), Fraction(1, 4))


def test_an_svg_with_polygons_has_its_y_axis_turned() -> None:
    (polygon,) = parse_svg('<svg><g><polygon points="0,0 4,0 4,3"/></g><title>x</title></svg>')
    assert polygon == Polygon(tuple((Fraction(x), Fraction(y)) for x, y in ((0, 0), (4, -3), (4, 0))))


@pytest.mark.parametrize(
    ("parse", "text", "message"),
    [
        (parse_wkt, "POLYGON ((0 0, 8 0, 8 4))", "ring at token 3 is open"),
        (parse_wkt, "POINT (1 2)", "begins with 'POINT'"),
        (parse_wkt, "", "begins with 'nothing'"),
        (parse_wkt, "POLYGON ((0 0, 8 0, x 4, 0 0))", "'x' is no number"),
        (parse_wkt, "POLYGON ((0 0, 8 0, 8 4, 0 0)", "'an end'"),
        (parse_wkt, "POLYGON ((0 0 1, 8 0 1, 8 4 1, 0 0 1))", "where , or \\) belongs"),
        (parse_wkt, WKT + " POLYGON", "goes on with 'POLYGON'"),
        (parse_wkt, "POLYGON ((0 0, 4 4, 4 0, 0 3, 0 0))", "crosses or touches itself"),
        (parse_geojson, '{"type": "Polygon", "coordinates": [[[0,0],[8,0],[8,4]]]}', "ring 1 is open"),
        (parse_geojson, '{"type": "Polygon", "coordinates": []}', "ring has 0 corners"),
        (parse_geojson, '{"type": "Polygon", "coordinates": [[[0,0],[8,0],["a",4],[0,0]]]}', "'a' is no number"),
        (parse_geojson, '{"type": "LineString", "coordinates": [[0,0],[8,0]]}', "holds a LineString"),
        (parse_geojson, '{"type": "FeatureCollection", "features": []}', "holds no polygon"),
        (parse_geojson, '{"type": "FeatureCollection"}', "lacks a list"),
        (parse_geojson, "[1]", "without a type"),
        (parse_geojson, '{"type": "Polygon", "coordinates": [[[NaN,0],[8,0]]]}', "NaN is no number"),
        (parse_polygon_json, "{", "not JSON"),
        (parse_polygon_json, "[" * 100_000, "not JSON"),
        (parse_polygon_json, '{"rings": []}', 'no list "polygons"'),
        (parse_polygon_json, '{"polygons": [[]]}', 'polygon 1 has no "outer" ring'),
        (parse_polygon_json, '{"polygons": [{"outer": [[0, 0], [1]]}]}', "no list of points"),
        (parse_svg, "<svg>", "no SVG"),
        (parse_svg, "<svg/>", "holds no <polygon>"),
        (parse_svg, '<!DOCTYPE svg [<!ENTITY a "b">]><svg/>', "document type"),
        (parse_svg, '<svg><path d="M0 0 L1 0 L1 1"/></svg>', "open"),
        (parse_svg, '<svg><path d="M0 0 L1 0 L1 1 M5 5 L6 5 L6 6Z"/></svg>', "open"),
        (parse_svg, '<svg><path d="M0 0 C1 0 1 1 2 2Z"/></svg>', "curves are not read"),
        (parse_svg, '<svg><path d="M0 0 L1"/></svg>', "without all of its numbers"),
        (parse_svg, '<svg><path d="0 0 L1 1"/></svg>', "where one of the commands"),
        (parse_svg, '<svg><path transform="scale(2)" d="M0 0L1 0L1 1Z"/></svg>', "transform"),
        (parse_svg, '<svg><rect width="3"/></svg>', "holds a <rect>"),
        (parse_svg, '<svg><polygon points="0 0 1 0 1"/></svg>', "pairs of x and y"),
        (parse_svg, '<svg><polygon points="0 0 1 0 # 1"/></svg>', "'#' is no number"),
    ],
)
def test_bad_text_is_refused(parse: object, text: str, message: str) -> None:
    assert callable(parse)
    with pytest.raises(MapError, match=message):
        parse(text)


def test_a_path_goes_on_behind_z_from_where_the_ring_began() -> None:
    (polygon,) = parse_svg('<svg><path d="M0 0 h9 v9 h-9 z m1 1 h2 v2 z m4 0 h2 v2 z"/></svg>')
    assert polygon.area == 81 - 2 - 2
    assert {ring[0] for ring in polygon.holes} == {(1, -1), (5, -1)}


def test_files_that_cannot_be_read_are_named(tmp_path: Path) -> None:
    with pytest.raises(MapError, match=r"nowhere\.wkt: the environment cannot be read"):
        load_environment(tmp_path / "nowhere.wkt")
    with pytest.raises(MapError, match=r"a\.xyz: the environment does not exist"):
        load_environment(tmp_path / "a.xyz")
    (tmp_path / "a.xyz").write_text("")
    with pytest.raises(MapError, match=r"a\.xyz: this is no environment"):
        load_environment(tmp_path / "a.xyz")
    (tmp_path / "a.wkt").write_bytes(b"\xff\xfe")
    with pytest.raises(MapError, match="no text in UTF-8"):
        load_environment(tmp_path / "a.wkt")
    (tmp_path / "a.wkt").write_text("POLYGON ((0 0, 1 0))")
    with pytest.raises(MapError, match=r"a\.wkt: the ring at token 3 is open"):
        load_environment(tmp_path / "a.wkt")
    (tmp_path / "a.json").write_text('{"polygons": []}')
    with pytest.raises(MapError, match="no free space"):
        load_environment(tmp_path / "a.json")
    with pytest.raises(MapError, match="no free space"):
        Environment(())
