"""Which filter is advised to whom."""

from fractions import Fraction

import pytest

from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.planning import advice, piece_choice
from ial.bouncing.planning.advice import advise, cell_widths
from ial.bouncing.planning.cell_choice import CellChoice
from ial.bouncing.planning.piece_choice import PieceChoice
from ial.errors import ConfigError
from ial.maps.polygons.environment import Environment
from tests.bouncing.judged_runs import WORLDS, judged, robots

HALL = {"hall": WORLDS["hall"]}
RIGHT_ANGLE, HALF = Fraction(90), Fraction(1, 2)


@pytest.mark.parametrize(("radius", "cell"), [("1/2", 1), ("3/10", 1), ("1/4", Fraction(1, 2)), ("2/9", Fraction(1, 2))])
def test_a_disk_as_wide_as_cells_on_the_lattice_is_given_the_smallest_exact_filter(radius: str, cell: Fraction) -> None:
    made = advise(HALL, RIGHT_ANGLE, radius_m=Fraction(radius))
    assert isinstance(made.best, CellChoice)
    assert (made.best.cell_m, made.best.headings, made.best.rule, made.best.is_right) == (cell, 4, "centre", True)
    assert made.best.flash_bytes == min(each.flash_bytes for each in made.cells if each.is_right and each.flash_bytes)
    assert len(made.pieces) == 6, "for a disk that errs"


@pytest.mark.parametrize(("angle", "bounds"), [(90, ExecutionBounds()), (100, ExecutionBounds(Fraction(2), Fraction(1, 50), 1))])
def test_a_point_is_given_the_finest_filter_of_rays_that_fits(angle: int, bounds: ExecutionBounds) -> None:
    made = advise(HALL, Fraction(angle), bounds=bounds, flash_bytes=50_000)
    assert isinstance(made.best, PieceChoice)
    fitting = [each for each in made.pieces if (each.flash_bytes or 0) <= 50_000]
    assert len(made.pieces) == 6
    assert 0 < len(fitting) < 6
    assert made.best in fitting
    assert made.best.pieces == max(each.pieces for each in fitting)
    assert "at most 50,000 bytes" in made.reason
    assert not any(each.is_right for each in made.cells)
    least = advise(HALL, Fraction(angle), bounds=bounds, flash_bytes=10)
    assert least.best == min(made.pieces, key=lambda each: each.flash_bytes or 0)
    assert "none here takes as little as 10 bytes" in least.reason


@pytest.mark.parametrize(
    ("radius", "bounds", "words"),
    [
        (HALF, ExecutionBounds(Fraction(1)), "it errs"),
        (Fraction(9, 10), ExecutionBounds(), "walls are not on the lattice of cells"),
    ],
)
def test_a_disk_for_which_no_exact_filter_is_right_is_given_rays(radius: Fraction, bounds: ExecutionBounds, words: str) -> None:
    made = advise(HALL, RIGHT_ANGLE, radius_m=radius, bounds=bounds)
    assert isinstance(made.best, PieceChoice)
    assert words in made.reason


def test_a_robot_for_which_nothing_is_right_is_given_nothing() -> None:
    two = {**HALL, "L": WORLDS["L"]}
    made = advise(two, RIGHT_ANGLE)
    assert made.best is None
    assert "of one environment" in made.reason
    assert advise(two, RIGHT_ANGLE, radius_m=HALF).best is not None


def test_what_is_advised_is_right_for_robots_with_real_geometry() -> None:
    from ial.bouncing.cells.headings import Headings
    from ial.bouncing.filters.building import build_filter

    best = advise(HALL, RIGHT_ANGLE, radius_m=Fraction(2, 9)).best
    assert isinstance(best, CellChoice)
    made = build_filter(HALL, Headings.of_angle(RIGHT_ANGLE, best.headings), best.cell_m, Fraction(2, 9), best.rule)
    assert len(made.table) - 1 == best.states
    assert judged(made, robots(HALL["hall"], made, 20)) == {"right": 20}


def test_what_was_not_computed_is_never_advised(monkeypatch: pytest.MonkeyPatch) -> None:
    made = advise(HALL, RIGHT_ANGLE, radius_m=HALF, most_states=20)
    assert isinstance(made.best, PieceChoice)
    assert "the exact filter that is right for this robot has too many states" in made.reason
    assert {each.more_than for each in made.cells} == {20}
    monkeypatch.setattr(piece_choice, "_MOST_WORK", 10)
    made = advise(HALL, RIGHT_ANGLE)
    assert made.best is None
    assert "too much work here: take longer steps" in made.reason
    assert all(each.flash_bytes is None for each in made.pieces)


def test_choices_that_cannot_be_made_say_why(monkeypatch: pytest.MonkeyPatch) -> None:
    made = advise(HALL, Fraction(45), Fraction(1, 4), radius_m=HALF)
    assert {each.refusal for each in made.cells if each.cell_m == 1} == {"a step leads out of no cell"}
    made = advise(HALL, RIGHT_ANGLE, radius_m=Fraction(9))
    assert {each.refusal for each in made.cells} == {"no cell is free"}
    assert "there is no exact filter here; a robot of radius 9 m fits nowhere" in made.reason
    made = advise(HALL, Fraction(45), Fraction(5000), radius_m=HALF)
    assert "a step leads over too many cells" in {each.refusal for each in made.cells}
    assert len(made.pieces) == 6
    monkeypatch.setattr(advice, "_MOST_CELLS", 100)
    made = advise(HALL, RIGHT_ANGLE)
    assert {each.refusal for each in made.cells if each.cell_m == HALF} == {"more than 100 cells"}
    monkeypatch.setattr(advice, "MOST_WALLS", 9)
    made = advise(HALL, RIGHT_ANGLE)
    assert made.pieces == ()
    assert "at most 9 walls, and here are 10; use fewer (--simplify)" in made.reason


def test_which_cells_are_looked_at() -> None:
    assert cell_widths(HALL, None, Fraction(0), Fraction(1)) == [1, HALF]
    assert cell_widths(HALL, Fraction(2), Fraction(3, 10), Fraction(1)) == [2, 1, Fraction(3, 5), Fraction(3, 10)]
    assert cell_widths(HALL, None, Fraction(1, 10), Fraction(1)) == [Fraction(1, 5), Fraction(1, 10)]
    assert cell_widths(HALL, None, Fraction(1, 5), None) == [Fraction(2, 5), Fraction(1, 5)]
    grid = {"grid": Environment(WORLDS["L"].polygons, Fraction(1, 20))}
    assert cell_widths(grid, None, Fraction(0), Fraction(1)) == [HALF, Fraction(1, 4), Fraction(1, 20)]


def test_what_is_done_is_told() -> None:
    told: list[tuple[int, int]] = []
    made = advise(HALL, RIGHT_ANGLE, progress=lambda done, total: told.append((done, total)))
    count = len(made.cells) + len(made.pieces)
    assert told == [(done, count) for done in range(1, count + 1)]


@pytest.mark.parametrize(
    ("angle", "more", "message"),
    [
        (360, {}, "multiple of 360"),
        (90, {"step_m": Fraction(0)}, "step is 0 m"),
        (90, {"radius_m": Fraction(-1)}, "radius of the robot is -1"),
    ],
)
def test_what_cannot_be_meant_is_refused(angle: int, more: dict[str, Fraction], message: str) -> None:
    with pytest.raises(ConfigError, match=message):
        advise(HALL, Fraction(angle), **more)  # type: ignore[arg-type]
