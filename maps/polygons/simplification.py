"""`simplified`: an environment with fewer walls, for outlines of grids, which have one for every stair of a slanted wall."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction

from ial.errors import ConfigError, MapError
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.polygon import ExactRing, Polygon, common_denominator, scaled
from ial.maps.polygons.ring import Point

_EXACT = 2**52  # whole numbers up to here are doubles
_MICROMETRES = 10**6


@dataclass(frozen=True)
class Simplification:
    """An environment with fewer walls, and what was done to get it.

    Parameters
    ----------
    environment
        What is left. Its corners are corners of the original.
    tolerance_m
        How far outlines might move, in metres.
    walls
        How many walls there were, and how many are left.
    moved_m
        By how much the outlines that are left have moved at most, in metres, rounded up to micrometres: no point of an old one is further
        from the new one, and no point of a new one further from the old one (Hausdorff distance).
    parts, parts_m2
        How many parts of the free space were left out, and their area.
    holes, holes_m2
        How many holes, that is obstacles, were left out of the parts that were kept, and their area.
    """

    environment: Environment
    tolerance_m: Fraction
    walls: tuple[int, int]
    moved_m: Fraction
    parts: int
    parts_m2: Fraction
    holes: int
    holes_m2: Fraction

    def __repr__(self) -> str:
        return f"<Simplification by {float(self.tolerance_m):g} m: {self.walls[1]} of {self.walls[0]} walls>"


def simplified(environment: Environment, tolerance_m: Fraction, width_m: Fraction = Fraction(0)) -> Simplification:
    """Return an environment with fewer walls; its guarantee is about a robot among those.

    Corners are left out where that moves the outline by no more than the tolerance and no ring comes to cross another one (after Douglas
    and Peucker, by `shapely.simplify`). Left out as a whole are holes whose bounding boxes are not wider than the tolerance in
    either direction, and parts of the free space whose bounding boxes are not wider than it, or narrower than the robot, in one.

    Parameters
    ----------
    environment
        The free space.
    tolerance_m
        How far an outline may move, in metres.
    width_m
        The width of the robot in metres, which cannot be in parts that are narrower; 0 for a point.

    Raises
    ------
    ConfigError
        If the tolerance is not positive.
    MapError
        If nothing would be left, the corners do not fit into doubles, rings would cross, or parts overlap.
    """
    if tolerance_m <= 0:
        raise ConfigError(f"the tolerance of a simplification is {float(tolerance_m):g} m; give a length greater than 0")
    kept, left_out, holes = [], [], []
    for polygon in environment.polygons:
        narrow = min(_extent(polygon.outer))
        if narrow <= tolerance_m or narrow < width_m:
            left_out.append(polygon)
            continue
        small = [max(_extent(hole)) <= tolerance_m for hole in polygon.holes]
        holes += [hole for hole, out in zip(polygon.holes, small, strict=True) if out]
        kept.append((polygon.outer, *(hole for hole, out in zip(polygon.holes, small, strict=True) if not out)))
    if not kept:
        raise MapError(
            f"every part of the free space is narrower than {float(max(tolerance_m, width_m)):g} m, so a simplification by "
            f"{float(tolerance_m):g} m leaves nothing; use a smaller tolerance"
        )
    polygons, moved = _fewer_corners(kept, tolerance_m)
    return Simplification(
        Environment(polygons, environment.cell),
        tolerance_m,
        (_walls(environment.polygons), _walls(polygons)),
        moved,
        len(left_out),
        sum((polygon.area for polygon in left_out), Fraction(0)),
        len(holes),
        -sum((Polygon.trusted(hole, ()).area for hole in holes), Fraction(0)),  # holes run clockwise
    )


def _walls(polygons: Iterable[Polygon]) -> int:
    return sum(len(ring) for polygon in polygons for ring in polygon.rings)


def _extent(ring: ExactRing) -> tuple[Fraction, Fraction]:
    xs, ys = zip(*ring, strict=True)
    return max(xs) - min(xs), max(ys) - min(ys)


def _fewer_corners(kept: list[tuple[ExactRing, ...]], tolerance_m: Fraction) -> tuple[tuple[Polygon, ...], Fraction]:
    """Return the simplified polygons, and by how much a ring has moved at most, in metres, rounded up to micrometres.

    Corners become whole numbers, which doubles hold exactly, so those that are left are found again by their coordinates.
    """
    import shapely  # type: ignore[import-untyped]

    scale = common_denominator(ring for rings in kept for ring in rings)
    x0, y0 = (min(point[axis] for rings in kept for ring in rings for point in ring) for axis in (0, 1))
    whole = [[scaled(tuple((x - x0, y - y0) for x, y in ring), scale) for ring in rings] for rings in kept]
    if max(number for rings in whole for ring in rings for point in ring for number in point) > _EXACT:
        raise MapError("the corners of the environment are fractions that doubles do not hold together; give coordinates of fewer digits")
    # All parts are given as one geometry: each is kept from the others.
    together = shapely.MultiPolygon([(rings[0], rings[1:]) for rings in whole])
    parts = shapely.get_parts(shapely.simplify(together, float(tolerance_m * scale), preserve_topology=True))
    fault = f"simplified by {float(tolerance_m):g} m"
    if len(parts) != len(kept) or any(len(part.interiors) != len(rings) - 1 for part, rings in zip(parts, kept, strict=True)):
        raise MapError(f"{fault}, a part of the free space or a hole vanishes; use another tolerance")
    limit, most = (tolerance_m * scale) ** 2, Fraction(0)
    polygons = []
    for part, rings, exact in zip(parts, whole, kept, strict=True):
        fewer = []
        for left, ring, same in zip((part.exterior, *part.interiors), rings, exact, strict=True):
            corners, squared = _within(ring, [(int(x), int(y)) for x, y in shapely.get_coordinates(left)[:-1].tolist()], limit)
            fewer.append(tuple(same[at] for at in corners))
            most = max(most, squared)
        try:
            polygons.append(Polygon(fewer[0], tuple(fewer[1:])))
        except MapError as error:
            raise MapError(f"{fault}: {error}; or use another tolerance") from None
    if not shapely.is_valid(
        shapely.MultiPolygon([(each[0], each[1:]) for each in (_scaled(polygon, x0, y0, scale) for polygon in polygons)])
    ):
        raise MapError(f"{fault}, parts of the free space overlap; use another tolerance")
    micrometres = math.ceil(most * Fraction(_MICROMETRES, scale) ** 2)
    return tuple(polygons), Fraction(math.isqrt(micrometres - 1) + 1 if micrometres else 0, _MICROMETRES)


def _scaled(polygon: Polygon, x0: Fraction, y0: Fraction, scale: int) -> list[list[Point]]:
    return [scaled(tuple((x - x0, y - y0) for x, y in ring), scale) for ring in polygon.rings]


def _within(ring: list[Point], left: list[Point], limit: Fraction) -> tuple[list[int], Fraction]:
    """Return which corners of a ring are left, and the squared distance by which it has moved at most, which keeps to a limit.

    GEOS tries the corner at which a ring starts last, against corners that are left, and so moves outlines by more than the tolerance
    there: the corner that is furthest off comes back, as Douglas and Peucker have it.

    Each edge of the new ring stands for a path along the old one between the same two corners. No point of the path is further from the
    edge than the furthest corner of the path, because the distance from a segment is convex; and the path passes beside every point of
    the edge, no further from it.
    """
    place, count = {point: at for at, point in enumerate(ring)}, len(ring)
    corners = sorted(place[point] for point in left)  # in the order of the old ring, whichever way round they came
    kept, most = [], Fraction(0)
    waiting = [(begin, end if end > begin else end + count) for begin, end in zip(corners, [*corners[1:], corners[0]], strict=True)]
    while waiting:
        begin, end = waiting.pop()
        a, b = ring[begin % count], ring[end % count]
        squared, furthest = max(
            ((_squared_distance(ring[at % count], a, b), at) for at in range(begin + 1, end)), default=(Fraction(0), end)
        )
        if squared > limit:
            waiting += [(begin, furthest), (furthest, end)]
        else:
            kept.append(begin % count)
            most = max(most, squared)
    return sorted(kept), most


def _squared_distance(point: Point, a: Point, b: Point) -> Fraction:
    """Return the squared distance of a point from a segment."""
    x, y, dx, dy = point[0] - a[0], point[1] - a[1], b[0] - a[0], b[1] - a[1]
    along, length = x * dx + y * dy, dx * dx + dy * dy
    if along <= 0:
        return Fraction(x * x + y * y)
    if along >= length:
        return Fraction((x - dx) ** 2 + (y - dy) ** 2)
    return Fraction((x * dy - y * dx) ** 2, length)
