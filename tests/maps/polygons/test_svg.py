from fractions import Fraction

import pytest

from ial.errors import MapError
from ial.maps.polygons.polygon import Polygon
from ial.maps.polygons.svg import parse_svg


def test_an_svg_with_polygons_has_its_y_axis_turned() -> None:
    (polygon,) = parse_svg('<svg><g><polygon points="0,0 4,0 4,3"/></g><title>x</title></svg>')
    assert polygon == Polygon(tuple((Fraction(x), Fraction(y)) for x, y in ((0, 0), (4, -3), (4, 0))))


def test_a_path_goes_on_behind_z_from_where_the_ring_began() -> None:
    (polygon,) = parse_svg('<svg><path d="M0 0 h9 v9 h-9 z m1 1 h2 v2 z m4 0 h2 v2 z"/></svg>')
    assert polygon.area == 81 - 2 - 2
    assert {ring[0] for ring in polygon.holes} == {(1, -1), (5, -1)}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("<svg>", "no SVG"),
        ("<svg/>", "holds no <polygon>"),
        ('<!DOCTYPE svg [<!ENTITY a "b">]><svg/>', "document type"),
        ('<svg><path d="M0 0 L1 0 L1 1"/></svg>', "open"),
        ('<svg><path d="M0 0 L1 0 L1 1 M5 5 L6 5 L6 6Z"/></svg>', "open"),
        ('<svg><path d="M0 0 C1 0 1 1 2 2Z"/></svg>', "curves are not read"),
        ('<svg><path d="M0 0 L1"/></svg>', "without all of its numbers"),
        ('<svg><path d="0 0 L1 1"/></svg>', "where one of the commands"),
        ('<svg><path transform="scale(2)" d="M0 0L1 0L1 1Z"/></svg>', "transform"),
        ('<svg><rect width="3"/></svg>', "holds a <rect>"),
        ('<svg><polygon points="0 0 1 0 1"/></svg>', "pairs of x and y"),
        ('<svg><polygon points="0 0 1 0 # 1"/></svg>', "'#' is no number"),
    ],
)
def test_bad_text_is_refused(text: str, message: str) -> None:
    with pytest.raises(MapError, match=message):
        parse_svg(text)
