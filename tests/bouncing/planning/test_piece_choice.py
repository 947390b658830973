from fractions import Fraction

import pytest

from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.exports.piece_source import PieceTables
from ial.bouncing.planning import piece_choice
from ial.bouncing.planning.piece_choice import PieceChoice
from ial.bouncing.rays.piece_map import PieceMap
from tests.bouncing.judged_runs import WORLDS

ROBOT = WORLDS["L"], Fraction(100), Fraction(1, 2), ExecutionBounds(Fraction(1)), Fraction(1), 36


def test_what_a_filter_takes_is_what_it_takes() -> None:
    made = PieceMap.of(*ROBOT)
    tables = PieceTables.of(made, "bounce")
    assert PieceChoice.of(*ROBOT) == PieceChoice(Fraction(1), 36, len(made), tables.flash_bytes, tables.ram_bytes)


def test_what_is_too_much_work_is_not_guessed_but_pieces_are_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(piece_choice, "_MOST_WORK", 1000)
    assert PieceChoice.of(*ROBOT) == PieceChoice(Fraction(1), 36, len(PieceMap.of(*ROBOT)))
