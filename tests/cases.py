"""How many cases a test draws: few where Python interprets the kernels, which takes it a hundred times as long."""

from ial.contractors.interpreter import INTERPRETED


def cases(compiled: int, interpreted: int) -> int:
    """Return the number of cases that a test draws."""
    return interpreted if INTERPRETED else compiled
