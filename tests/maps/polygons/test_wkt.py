import pytest

from ial.errors import MapError
from ial.maps.polygons.wkt import parse_wkt, wkt

WKT = "POLYGON ((0 0, 8 0, 8 4, 0 4, 0 0), (1 1, 1 2, 2 2, 2 1, 1 1))"


def test_several_polygons_are_written_as_they_are_read() -> None:
    both = parse_wkt("MULTIPOLYGON (((0 0, 1 0, 0 1, 0 0)), ((5 5, 6 5, 5 6, 5 5)))")
    assert len(both) == 2
    assert parse_wkt(wkt(both)) == both
    assert parse_wkt(wkt(both[:1])) == both[:1]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("POLYGON ((0 0, 8 0, 8 4))", "ring at token 3 is open"),
        ("POINT (1 2)", "begins with 'POINT'"),
        ("", "begins with 'nothing'"),
        ("POLYGON ((0 0, 8 0, x 4, 0 0))", "'x' is no number"),
        ("POLYGON ((0 0, 8 0, 8 4, 0 0)", "'an end'"),
        ("POLYGON ((0 0 1, 8 0 1, 8 4 1, 0 0 1))", "where , or \\) belongs"),
        (WKT + " POLYGON", "goes on with 'POLYGON'"),
        ("POLYGON ((0 0, 4 4, 4 0, 0 3, 0 0))", "crosses or touches itself"),
    ],
)
def test_bad_text_is_refused(text: str, message: str) -> None:
    with pytest.raises(MapError, match=message):
        parse_wkt(text)
