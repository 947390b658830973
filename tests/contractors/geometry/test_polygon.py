"""Polygons against a twin with exact fractions: which points are inside, and how far a box can shrink."""

import math
from fractions import Fraction

import numpy as np
import pytest
import shapely

from ial.contractors import Boxes, Polygon, Separator
from ial.contractors.boxes import FloatArray

INF = math.inf
SQUARE = [(0, 0), (4, 0), (4, 4), (0, 4)]
HOLE = [(1, 1), (2, 1), (2, 2), (1, 2)]
L_SHAPE = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)]

Ring = FloatArray


def star(seed: int, corners: int) -> Ring:
    """Return a random polygon that its centre sees as a whole."""
    rng = np.random.default_rng(seed)
    angle = np.sort(rng.uniform(0, 2 * np.pi, corners))
    radius = rng.uniform(1, 4, corners)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)


def where_is(point: tuple[float, float], rings: list[Ring]) -> int:
    """Return 1 inside, 0 on an edge, -1 outside; exactly."""
    x, y = map(Fraction, point)
    side = -1
    for ring in rings:
        corners = [(Fraction(a), Fraction(b)) for a, b in np.asarray(ring, dtype=float).tolist()]
        for (ax, ay), (bx, by) in zip(corners, corners[1:] + corners[:1], strict=True):
            turn = (bx - ax) * (y - ay) - (by - ay) * (x - ax)
            if turn == 0 and min(ax, bx) <= x <= max(ax, bx) and min(ay, by) <= y <= max(ay, by):
                return 0
            if (ay <= y) != (by <= y) and (turn > 0) == (by > ay):
                side = -side
    return side


def random_boxes(count: int, seed: int, reach: float) -> Boxes:
    rng = np.random.default_rng(seed)
    lower = rng.uniform(-reach, reach, (count, 2))
    lower = np.where(rng.random((count, 2)) < 0.2, np.round(lower), lower)
    return Boxes(
        lower,
        lower + rng.choice([0.0, 0.05, 0.5, 1.0, 3.0], (count, 2)) * np.where(rng.random((count, 2)) < 0.5, 1, rng.random((count, 2))),
    )


SCENES = [
    ([SQUARE], [HOLE]),
    ([L_SHAPE], []),
    ([star(1, 7)], []),
    ([star(2, 40)], [star(3, 9) * 0.1]),
    ([star(4, 300)], []),
]


@pytest.mark.slow
@pytest.mark.parametrize(("outline", "holes"), SCENES)
def test_a_point_is_kept_by_each_side_it_is_on_and_by_no_other(outline: list[Ring], holes: list[Ring]) -> None:
    rng = np.random.default_rng(6)
    rings = [np.asarray(ring, dtype=np.float64) for ring in outline + holes]
    corners = np.concatenate(rings)
    # Anywhere, at a corner, level with one, and next to the middle of two corners.
    middle = 0.5 * (corners + np.roll(corners, 1, axis=0))
    points = np.concatenate(
        [rng.uniform(-5, 5, (150, 2)), corners[:40], np.stack([rng.uniform(-5, 5, 40), rng.choice(corners[:, 1], 40)], axis=1)]
    )
    points = np.concatenate([points, middle[:40], np.nextafter(middle[:40], np.inf), np.nextafter(corners[:40], -np.inf)])
    polygon = Polygon(outline[0], holes)
    inside = ~polygon.contract(Boxes(points, points)).empty
    outside = ~(~polygon).contract(Boxes(points, points)).empty
    for point, is_inside, is_outside in zip(points.tolist(), inside, outside, strict=True):
        side = where_is(point, rings)
        assert is_inside or side < 0, point
        assert is_outside or side > 0, point
        distance = min(shapely.LinearRing(ring).distance(shapely.Point(point)) for ring in rings)
        if distance > 1e-12:
            assert (is_inside, is_outside) == (side > 0, side < 0), point


@pytest.mark.parametrize(("outline", "holes"), SCENES)
@pytest.mark.parametrize("flip", [False, True])
def test_boxes_shrink_to_the_hull_of_their_part(outline: list[Ring], holes: list[Ring], flip: bool) -> None:
    shape = shapely.Polygon(outline[0], holes)
    polygon = Polygon(outline[0], holes)
    boxes = random_boxes(300, 7, 5.0)
    narrowed = (~polygon if flip else polygon).contract(boxes)
    assert ((narrowed.lower >= boxes.lower) & (narrowed.upper <= boxes.upper)).all()
    for i in range(300):
        # Of a box without an area, shapely makes an invalid polygon; its convex hull is a segment or a point.
        box = shapely.box(*boxes.lower[i], *boxes.upper[i]).convex_hull
        # Borders belong to both sides; shapely leaves them out of a difference.
        part = shapely.union(shapely.difference(box, shape), shape.boundary.intersection(box)) if flip else shapely.intersection(box, shape)
        assert narrowed.empty[i] == part.is_empty
        if not part.is_empty:
            assert [*narrowed.lower[i], *narrowed.upper[i]] == pytest.approx(part.bounds, abs=1e-9)


def test_a_square_with_a_hole() -> None:
    polygon = Polygon(SQUARE, [HOLE])
    separator = Separator.of(polygon)
    boxes = Boxes.of(
        [(-1, 2), (-1, 3)],
        [(1.25, 1.5), (1.25, 1.5)],
        [(2.5, 3), (2.5, 3)],
        [(5, 6), (5, 6)],
        [(-INF, INF), (-INF, INF)],
        [(1.5, 3), (1.5, 1.5)],
        [(3, INF), (1, 2)],
        [(INF, -INF), (INF, -INF)],
    )
    inner, outer = separator.separate(boxes)
    assert outer.lower.tolist() == [[0, 0], [INF, INF], [2.5, 2.5], [INF, INF], [0, 0], [2, 1.5], [3, 1], [INF, INF]]
    assert outer.upper.tolist() == [[2, 3], [-INF, -INF], [3, 3], [-INF, -INF], [4, 4], [3, 1.5], [4, 2], [-INF, -INF]]
    assert inner.lower.tolist() == [[-1, -1], [1.25, 1.25], [INF, INF], [5, 5], [-INF, -INF], [1.5, 1.5], [4, 1], [INF, INF]]
    assert inner.upper.tolist() == [[2, 3], [1.5, 1.5], [-INF, -INF], [6, 6], [INF, INF], [2, 1.5], [INF, 2], [-INF, -INF]]


def test_the_complement_of_the_complement_is_the_polygon() -> None:
    polygon = Polygon(L_SHAPE)
    boxes = random_boxes(100, 8, 4.0)
    once, twice = polygon.contract(boxes), (~~polygon).contract(boxes)
    assert (once.lower == twice.lower).all()
    assert (once.upper == twice.upper).all()


def test_direction_and_a_repeated_corner_do_not_matter() -> None:
    boxes = random_boxes(100, 9, 4.0)
    plain = Polygon(L_SHAPE).contract(boxes)
    for vertices in (L_SHAPE[::-1], [*L_SHAPE, L_SHAPE[0]], L_SHAPE[2:] + L_SHAPE[:2]):
        narrowed = Polygon(vertices).contract(boxes)
        assert (narrowed.lower == plain.lower).all()
        assert (narrowed.upper == plain.upper).all()


def test_shapes_of_shapely() -> None:
    several = shapely.MultiPolygon([(SQUARE, [HOLE]), ([(6, 0), (8, 0), (8, 2)], [])])
    narrowed = Polygon.from_shapely(several).contract(Boxes.of([(3, 9), (0.5, 1)], [(4.5, 5.5), (0, 4)], [(7.5, 9), (1, 1)]))
    assert narrowed.empty.tolist() == [False, True, False]
    assert narrowed.lower[0].tolist() == [3, 0.5]
    assert narrowed.upper[0].tolist() == [8, 1]
    high = shapely.Polygon([(x, y, 7) for x, y in SQUARE])
    assert not Polygon.from_shapely(high).contract(Boxes.of([(1, 2), (1, 2)])).empty[0]


@pytest.mark.parametrize(
    ("vertices", "holes", "message"),
    [
        ([(0, 0), (1, 1), (1, 0), (0, 1)], [], "Self-intersection"),
        ([(0, 0), (1, 1)], [], "2 different vertices"),
        ([(0, 0), (1, 1), (0, 0), (1, 1)], [], "2 different vertices"),
        ([(0, 0), (1, 1), (2, 2)], [], "not valid"),
        ([(0, 0), (1, 0), (1, math.nan)], [], "row 2 of the vertices of the polygon"),
        ([(0, 0), (1, 0), (math.inf, 1)], [], "finite"),
        ([(0, 0, 0), (1, 0, 0), (1, 1, 0)], [], "3 coordinates"),
        ([], [], "shape"),
        (SQUARE, [[(5, 5), (6, 5), (6, 6)]], "Hole lies outside"),
        (SQUARE, [[(1, 1), (2, 1)]], "hole 0 of the polygon has 2"),
        (SQUARE, [HOLE, [(1.5, 1.5), (3, 1.5), (3, 3)]], "not valid"),
    ],
)
def test_polygons_that_cannot_be_meant(vertices: list[tuple[float, ...]], holes: list[list[tuple[float, float]]], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Polygon(vertices, holes)


def test_geometries_that_are_no_polygons() -> None:
    with pytest.raises(ValueError, match="LineString, which has no inside"):
        Polygon.from_shapely(shapely.LineString(SQUARE))
    with pytest.raises(ValueError, match="empty"):
        Polygon.from_shapely(shapely.Polygon())
    with pytest.raises(ValueError, match="list, which"):
        Polygon.from_shapely([])
    with pytest.raises(ValueError, match="needs 2"):
        Polygon(SQUARE).contract(Boxes.of([(0, 1)]))
