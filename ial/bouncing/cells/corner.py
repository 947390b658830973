"""What a step must not touch: the corner policy."""

from typing import Literal, get_args

from ial.errors import ConfigError

Corner = Literal["segment", "endpoint"]


def passed_cells(columns: int, rows: int, corner: Corner) -> list[tuple[int, int]]:
    """Return the cells, as (columns, rows) from where a step begins, that must be free for a step to be possible; its end comes last.

    Parameters
    ----------
    columns, rows
        The offset of the step.
    corner
        ``segment``: the segment between the two centres misses every closed cell that is not free; a diagonal step cannot slip between two
        of them. ``endpoint``: only the end counts, as in the paper.

    Raises
    ------
    ConfigError
        If the policy is unknown.
    """
    if corner not in get_args(Corner):
        raise ConfigError(f"the corner policy {corner!r} is unknown; give 'segment' or 'endpoint'")
    if corner == "endpoint":
        return [(columns, rows)]
    right, up = (1 if columns >= 0 else -1), (1 if rows >= 0 else -1)
    # A closed cell meets the line exactly if the line passes its centre at no more than half its width along the line's normal.
    met = [
        (right * x, up * y)
        for x in range(abs(columns) + 1)
        for y in range(abs(rows) + 1)
        if 2 * abs(abs(columns) * y - abs(rows) * x) <= abs(columns) + abs(rows)
    ]
    return [each for each in met if each not in ((0, 0), (columns, rows))] + [(columns, rows)]
