import json

import pytest

from ial.errors import MapError
from ial.maps.polygons.geojson import parse_geojson

RING = [[0, 0], [8, 0], [8, 4], [0, 4], [0, 0]]


def test_several_polygons() -> None:
    features = [{"type": "Feature", "geometry": {"type": "MultiPolygon", "coordinates": [[RING], [[[x + 20, y, 0] for x, y in RING]]]}}]
    assert sum(each.area for each in parse_geojson(json.dumps({"type": "FeatureCollection", "features": features}))) == 64


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('{"type": "Polygon", "coordinates": [[[0,0],[8,0],[8,4]]]}', "ring 1 is open"),
        ('{"type": "Polygon", "coordinates": []}', "ring has 0 corners"),
        ('{"type": "Polygon", "coordinates": [[[0,0],[8,0],["a",4],[0,0]]]}', "'a' is no number"),
        ('{"type": "LineString", "coordinates": [[0,0],[8,0]]}', "holds a LineString"),
        ('{"type": "FeatureCollection", "features": []}', "holds no polygon"),
        ('{"type": "FeatureCollection"}', "lacks a list"),
        ("[1]", "without a type"),
        ('{"type": "Polygon", "coordinates": [[[NaN,0],[8,0]]]}', "NaN is no number"),
    ],
)
def test_bad_text_is_refused(text: str, message: str) -> None:
    with pytest.raises(MapError, match=message):
        parse_geojson(text)
