"""`csv_text`: the states of a filter as a table for spreadsheets and scripts."""

from ial.bouncing.automata.table import FilterTable


def csv_text(table: FilterTable) -> str:
    """Return one line for each state: its number, the state after each observation, its colour, and in how many configurations a robot is.

    The last line is the trap, of size 0.
    """
    rows = zip(table.successors.tolist(), table.colours.tolist(), table.uncertainty.tolist(), strict=True)
    lines = [f"{state},{free},{bump},{colour},{size}" for state, ((free, bump), colour, size) in enumerate(rows)]
    return "\n".join(["state,next_0,next_1,colour,size", *lines]) + "\n"
