"""The coarsest partition of states that successors respect: Hopcroft's algorithm on arrays, O(letters · n log n).

References
----------
Hopcroft: An n log n algorithm for minimizing states in a finite automaton, 1971. Valmari, Lehtinen: Efficient minimization of DFAs with
partial transition functions, STACS 2008, for the arrays of a refinable partition.
"""

import numpy as np
import numpy.typing as npt

from ial.contractors.kernels import kernel


@kernel
def _inverse(successors, letter, starts, sources):  # type: ignore[no-untyped-def]
    """Fill the lists of the states whose successor is each state."""
    count = len(successors)
    for state in range(count + 1):
        starts[state] = 0
    for state in range(count):
        starts[successors[state, letter] + 1] += 1
    for state in range(count):
        starts[state + 1] += starts[state]
    place = starts.copy()
    for state in range(count):
        to = successors[state, letter]
        sources[place[to]] = state
        place[to] += 1


@kernel
def _refine(successors, initial, blocks):  # type: ignore[no-untyped-def]
    """Write the block of each state; return the number of blocks."""
    count, letters = successors.shape
    starts = np.empty((letters, count + 1), dtype=np.int32)
    sources = np.empty((letters, count), dtype=np.int32)
    for letter in range(letters):
        _inverse(successors, letter, starts[letter], sources[letter])
    # Block b holds elements[first[b] : stop[b]], of which the first marked[b] are marked.
    elements = np.argsort(initial, kind="mergesort").astype(np.int32)
    places = np.empty(count, dtype=np.int32)
    first, stop = np.empty(count, dtype=np.int32), np.empty(count, dtype=np.int32)
    marked, touched = np.zeros(count, dtype=np.int32), np.empty(count, dtype=np.int32)
    waiting, splitter = np.empty(count, dtype=np.int32), np.empty(count, dtype=np.int32)
    number = 0
    for at in range(count):
        if at == 0 or initial[elements[at]] != initial[elements[at - 1]]:
            first[number] = at
            number += 1
        stop[number - 1] = at + 1
        places[elements[at]] = at
        blocks[elements[at]] = number - 1
    pending = number
    for block in range(number):
        waiting[block] = block
    while pending > 0:
        pending -= 1
        block = waiting[pending]
        size = stop[block] - first[block]
        # What waits is split by the block as it is now. If it is split itself meanwhile, its new part waits for all letters anyway.
        for i in range(size):
            splitter[i] = elements[first[block] + i]
        for letter in range(letters):
            met = 0
            for i in range(size):
                for at in range(starts[letter, splitter[i]], starts[letter, splitter[i] + 1]):
                    state = sources[letter, at]
                    home = blocks[state]
                    if marked[home] == 0:
                        touched[met] = home
                        met += 1
                    border = first[home] + marked[home]  # swap the state next to the last marked one
                    other, place = elements[border], places[state]
                    elements[border], elements[place] = state, other
                    places[state], places[other] = border, place
                    marked[home] += 1
            for i in range(met):
                home = touched[i]
                middle = first[home] + marked[home]
                marked[home] = 0
                if middle == stop[home]:
                    continue
                if middle - first[home] <= stop[home] - middle:  # the smaller part becomes the new block
                    first[number], stop[number] = first[home], middle
                    first[home] = middle
                else:
                    first[number], stop[number] = middle, stop[home]
                    stop[home] = middle
                for at in range(first[number], stop[number]):
                    blocks[elements[at]] = number
                waiting[pending] = number
                pending += 1
                number += 1
    return number


def coarsest_partition(successors: npt.NDArray[np.int32], initial: npt.NDArray[np.int32]) -> npt.NDArray[np.int32]:
    """Return the coarsest partition that is finer than a given one and whose blocks have successors in one block each.

    Parameters
    ----------
    successors
        int32 of shape (n, letters), all of them states.
    initial
        What tells states apart at once, int32 of shape (n,).

    Returns
    -------
    array
        The block of each state, int32 of shape (n,), numbered by their first states.
    """
    blocks = np.empty(len(successors), dtype=np.int32)
    _refine(np.ascontiguousarray(successors), initial, blocks)
    _, first, named = np.unique(blocks, return_index=True, return_inverse=True)
    rank = np.argsort(np.argsort(first))
    return rank[named].astype(np.int32)
