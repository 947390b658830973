"""`minimize`: the smallest filter with the same colours on every stream; sets of cells and uncertainties are given up for it."""

from typing import Literal

import numpy as np

from ial.bouncing.automata.partition import coarsest_partition
from ial.bouncing.automata.table import FilterTable

Keep = Literal["colours", "localized"]


def minimize(table: FilterTable, keep: Keep = "colours") -> FilterTable:
    """Return a filter of the fewest states.

    Parameters
    ----------
    table
        A filter, not a restarting one.
    keep
        ``colours``: which knowledge cycle it is. ``localized``: only whether it is one, with colour 2 for all of them. The trap is kept.

    Returns
    -------
    FilterTable
        Its uncertainty is the largest of the states taken together; on knowledge cycles that are told apart it is exact. Its environments
        are those of all of them.
    """
    colours = table.colours
    if keep == "localized":
        colours = np.minimum(colours, 2)
        colours[table.trap] = 3
    blocks = coarsest_partition(table.successors, colours)
    _, first = np.unique(blocks, return_index=True)
    uncertainty, environments = np.zeros(len(first), dtype=np.int64), np.zeros(len(first), dtype=np.uint64)
    np.maximum.at(uncertainty, blocks, table.uncertainty)
    np.bitwise_or.at(environments, blocks, table.environments)
    return FilterTable(blocks[table.successors[first]], colours[first], uncertainty, environments)
