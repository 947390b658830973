"""`dot_text`: a filter as a graph for Graphviz."""

from ial.bouncing.exports.exported_filter import ExportedFilter
from ial.errors import ConfigError

MOST_DRAWN = 2000


def dot_text(exported: ExportedFilter, force: bool = False) -> str:
    """Return the text of a directed graph: states with their colours and sizes, arcs with what is read.

    Parameters
    ----------
    exported
        The filter.
    force
        Whether to write it however many states it has.

    Raises
    ------
    ConfigError
        If there are more than 2,000 states, which no layout makes readable, unless it is forced.
    """
    table = exported.table
    if len(table) - 1 > MOST_DRAWN and not force:
        raise ConfigError(
            f"the filter has {len(table) - 1:,} states, and a picture of more than {MOST_DRAWN:,} cannot be read; make it smaller with "
            "--minimize colours or a larger cell, or insist with --force"
        )
    lines = ["digraph filter {", "  rankdir=LR;", "  node [shape=circle];"]
    for state in range(len(table)):
        colour, size = int(table.colours[state]), int(table.uncertainty[state])
        if state == table.trap:
            lines.append(f'  {state} [label="trap", shape=box];')
        elif table.is_localized(state):
            lines.append(
                f'  {state} [label="{state}\\ncolour {colour}, size {size}", shape=doublecircle, style=filled, '
                f'fillcolor="{0.618034 * (colour - 2) % 1:.3f} 0.3 1.0"];'  # hues that stay apart however many there are
            )
        else:
            lines.append(f'  {state} [label="{state}\\nsize {size}"];')
    for state, row in enumerate(table.successors.tolist()):
        lines += [f'  {state} -> {to} [label="{letter}"];' for letter, to in enumerate(row)]
    return "\n".join([*lines, "}"]) + "\n"
