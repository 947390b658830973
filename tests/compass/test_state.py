from fractions import Fraction

from ial.compass.state import InformationState, Piece
from ial.maps.polygons.exact.rational import rational
from ial.maps.polygons.exact.shooter import Shooter
from tests.maps.polygons.known_polygons import SQUARE, TOUCHING

SHOOTER = Shooter(SQUARE)


def piece(edge: int, low: str, high: str) -> Piece:
    return Piece(edge, rational(Fraction(low)), rational(Fraction(high)))


def point(edge: int, part: str, shooter: Shooter = SHOOTER):  # type: ignore[no-untyped-def]
    return shooter.on_edge(edge, rational(Fraction(part)))


def test_pieces_that_overlap_are_one() -> None:
    state = InformationState.of(SHOOTER, [piece(1, "1/2", "3/4"), piece(1, "0", "2/3"), piece(0, "0", "1/3")], [])
    assert state.pieces == (piece(0, "0", "1/3"), piece(1, "0", "3/4"))
    assert state.sizes == (2, 0)


def test_pieces_that_meet_are_one_if_the_point_between_them_belongs_to_the_state() -> None:
    pieces = [piece(1, "1/2", "1"), piece(1, "0", "1/2")]
    assert InformationState.of(SHOOTER, pieces, []).sizes == (2, 0)
    assert InformationState.of(SHOOTER, pieces, [point(1, "1/2")]) == InformationState.of(SHOOTER, [piece(1, "0", "1")], [])
    assert InformationState.of(SHOOTER, pieces, [point(2, "1/2")]).sizes == (2, 1)


def test_points_that_a_piece_covers_are_dropped_and_its_ends_are_not() -> None:
    points = [point(0, "1/3"), point(0, "1/2"), point(0, "1/2"), point(0, "2/3"), point(1, "1/2"), SHOOTER.corner(0)]
    state = InformationState.of(SHOOTER, [piece(0, "1/3", "2/3")], points)
    assert {each.place for each in state.points} == {each.place for each in (points[0], points[3], points[4], points[5])}
    assert InformationState.of(SHOOTER, [piece(0, "0", "1")], [SHOOTER.corner(0)]).sizes == (1, 1)


def test_a_corner_of_one_ring_inside_of_a_wall_of_another_belongs_to_that_wall() -> None:
    shooter = Shooter(TOUCHING)
    corner = shooter.corners.index((4, 0))
    assert shooter.touched == {corner: [0]}
    low, high = piece(0, "0", "4/9"), piece(0, "4/9", "1")
    assert InformationState.of(shooter, [low, high], []).sizes == (2, 0)
    assert InformationState.of(shooter, [low, high], [shooter.corner(corner)]).sizes == (1, 0)
    assert InformationState.of(shooter, [piece(0, "0", "1")], [shooter.corner(corner)]).sizes == (1, 0)


def test_the_boundary_is_every_wall_and_every_corner() -> None:
    state = InformationState.boundary(SHOOTER)
    assert state.sizes == (4, 4)
    assert state.single is None
    assert repr(state) == "<InformationState of 4 pieces and 4 points>"
    assert InformationState.of(SHOOTER, [], [point(2, "1/4")]).single == (3, 4)
