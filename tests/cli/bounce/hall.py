"""The hall that the commands of the bouncing robot are tried in, and robots there."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.bouncing.filters.filter_file import read_filter

Cli = Callable[..., Any]
WKT = "POLYGON ((0 0, 9 0, 9 4, 5 4, 5 7, 0 7, 0 0), (2 2, 2 4, 3 4, 3 2, 2 2))"
REAL = ("--angle", 100, "--turn-error", 2, "--step-error", "0.02", "--count-error", 1)
ROOMS = ("--room", "left=-1,-1,5,8", "--room", "right=5,-1,10,5")


def stream_of(path: Path, start: int = 3, count: int = 60) -> str:
    """Observations that never lead to the trap."""
    made = read_filter(path)
    assert isinstance(made, BounceFilter)
    table, state, letters = made.table, 0, ""
    for at in range(count):
        options = [letter for letter in (0, 1) if table.step(state, letter) != table.trap]
        letter = options[(at + start) % len(options)]
        letters, state = letters + str(letter), table.step(state, letter)
    return letters
