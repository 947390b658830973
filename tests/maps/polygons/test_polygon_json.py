from fractions import Fraction

import pytest

from ial.errors import MapError
from ial.maps.polygons.polygon_json import parse_polygon_json, polygon_json


def test_coordinates_are_not_rounded() -> None:
    (polygon,) = parse_polygon_json('{"polygons": [{"outer": [["1/3", 0], [0.1, 1], [1e-3, "2/7"]]}]}')
    assert polygon.outer[1] == (Fraction(1, 1000), Fraction(2, 7)) or (Fraction(1, 10), Fraction(1)) in polygon.outer
    assert {x for x, _ in polygon.outer} == {Fraction(1, 3), Fraction(1, 10), Fraction(1, 1000)}
    assert parse_polygon_json(polygon_json([polygon])) == (polygon,)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{", "not JSON"),
        ("[" * 100_000, "not JSON"),
        ('{"rings": []}', 'no list "polygons"'),
        ('{"polygons": [[]]}', 'polygon 1 has no "outer" ring'),
        ('{"polygons": [{"outer": [[0, 0], [1]]}]}', "no list of points"),
    ],
)
def test_bad_text_is_refused(text: str, message: str) -> None:
    with pytest.raises(MapError, match=message):
        parse_polygon_json(text)
