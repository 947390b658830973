from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from ial.bouncing.cells.headings import Headings
from ial.bouncing.filters.building import build_filter
from ial.errors import FilterError
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.outline import outlines
from ial.results.bouncing.automaton_picture import MOST_STATES, draw_automaton
from ial.results.bouncing.ground import BRIGHT
from tests.results.bouncing.drawn_filter import built, pixels, read


@pytest.mark.slow
def test_the_automaton_shows_each_cycle_in_its_colour(tmp_path: Path) -> None:
    made, _, _ = built(["room"])
    draw_automaton(tmp_path / "a.png", made.table, "room")
    image = read(tmp_path / "a.png")
    shown = [pixels(image, colour) > 50 for colour in BRIGHT]
    assert shown == [number < made.table.cycles for number in range(len(BRIGHT))]


def test_an_automaton_that_is_one_cycle(tmp_path: Path) -> None:
    alone = Environment(outlines(np.ones((1, 1), dtype=np.bool_), Fraction(1)), Fraction(1))
    draw_automaton(tmp_path / "a.png", build_filter({"alone": alone}, Headings(4, 1)).table, "alone")
    assert pixels(read(tmp_path / "a.png"), BRIGHT[0]) > 50


def test_a_large_automaton_is_refused(tmp_path: Path) -> None:
    hall = Environment(outlines(np.ones((9, 20), dtype=np.bool_), Fraction(1)), Fraction(1))
    table = build_filter({"hall": hall}, Headings(8, 3)).table
    assert len(table) > MOST_STATES
    with pytest.raises(FilterError, match=f"{len(table) - 1} states, and at most {MOST_STATES}"):
        draw_automaton(tmp_path / "a.png", table, "hall")
    assert list(tmp_path.iterdir()) == []
