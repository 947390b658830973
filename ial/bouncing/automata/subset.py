"""The subset construction on arrays: the information states that streams of bumps lead to, breadth first.

The set after a word w is C^|w|(P_w), P_w being the starts from which w is observed. Words of one length have disjoint P_w, so the sets of
one level of the search have no more elements together than there are vertices: two buffers hold them, and nothing else keeps a set. A set
is recognized by its size and two sums of 64 bits, over its elements, of well mixed numbers.

A set S that comes back to itself, S –w–> S, consists of vertices that all emit w, and C^|w| permutes it. States on cycles therefore have
one successor only: knowledge cycles are disjoint and never left. That is how they are found while the search runs: chains of states with
one successor are joined (union–find), and the arc that closes a chain is noticed while the set of its state is still at hand.
"""

import numpy as np

from ial.contractors.kernels import kernel

DONE, TOO_MANY, PAUSED = 0, 1, 2

_MIX_1, _MIX_2, _MIX_3 = np.uint64(0x9E3779B97F4A7C15), np.uint64(0xBF58476D1CE4E5B9), np.uint64(0x94D049BB133111EB)
_30, _27, _31, _32 = np.uint64(30), np.uint64(27), np.uint64(31), np.uint64(32)
_ONE = np.uint64(1)


@kernel
def _mixed(vertex):  # type: ignore[no-untyped-def]
    """Return a number of 64 bits in which every bit depends on the vertex (the finalizer of SplitMix64)."""
    x = np.uint64(vertex + 1) * _MIX_1
    x = (x ^ (x >> _30)) * _MIX_2
    x = (x ^ (x >> _27)) * _MIX_3
    return x ^ (x >> _31)


@kernel
def _remixed(x):  # type: ignore[no-untyped-def]
    """Return a second number of 64 bits from the first one."""
    y = (x ^ (x >> _32)) * _MIX_3
    return y ^ (y >> _30)


@kernel
def _grown(array, size):  # type: ignore[no-untyped-def]
    """Return a copy of an array with room for so many numbers."""
    # Slices would say it shorter, and take seconds to compile: here and below.
    larger = np.empty(size, dtype=array.dtype)
    for at in range(len(array)):
        larger[at] = array[at]
    return larger


@kernel
def _grown_rows(array, size):  # type: ignore[no-untyped-def]
    """Return a copy of a table with room for so many rows."""
    larger = np.empty((size, array.shape[1]), dtype=array.dtype)
    for at in range(len(array)):
        for column in range(array.shape[1]):
            larger[at, column] = array[at, column]
    return larger


@kernel
def _root(parents, state):  # type: ignore[no-untyped-def]
    """Return the end of the chain of states with one successor each, halving the way for the next time."""
    while parents[state] != state:
        parents[state] = parents[parents[state]]
        state = parents[state]
    return state


@kernel
def _find(table, sums, sizes, first, second, size):  # type: ignore[no-untyped-def]
    """Return the slot of a set in the open-addressing table: that of the equal one, or an empty one."""
    mask = len(table) - 1
    slot = np.int64(first) & mask
    while table[slot] >= 0:
        state = table[slot]
        if sums[state, 0] == first and sums[state, 1] == second and sizes[state, 0] == size:
            break
        slot = (slot + 1) & mask
    return slot


@kernel
def _larger_table(sums, sizes, states, slots):  # type: ignore[no-untyped-def]
    table = np.full(slots, -1, dtype=np.int32)
    for state in range(states):
        table[_find(table, sums, sizes, sums[state, 0], sums[state, 1], sizes[state, 0])] = state
    return table


@kernel
def _collect(candidates, count, stamps, stamp, out, at, weights, parts):  # type: ignore[no-untyped-def]
    """Write the candidates without repeats to `out`; return (the end, sums, weight, bits of the environments met)."""
    first = second = met = np.uint64(0)
    weight = np.int64(0)
    for i in range(count):
        vertex = candidates[i]
        if stamps[vertex] == stamp:
            continue
        stamps[vertex] = stamp
        out[at] = vertex
        at += 1
        mixed = _mixed(vertex)
        first += mixed
        second += _remixed(mixed)
        if len(weights):
            weight += weights[vertex]
        if len(parts):
            met |= _ONE << np.uint64(parts[vertex])
    return at, first, second, weight, met


@kernel
def begun(begins, arcs, weights, parts):  # type: ignore[no-untyped-def]
    """Return the construction before its first step, as `construct` takes it: the start is the only state.

    Parameters
    ----------
    begins
        The vertices in which the robot can start, int32, each once.
    arcs
        As in `LabelledGraph`.
    weights, parts
        The weight and the environment of each vertex; of length 0 for one each, and for one environment.
    """
    count = len(arcs)
    room = np.int64(256)
    successors = np.empty((room, 2), dtype=np.int32)
    sizes = np.empty((room, 2), dtype=np.int64)  # the number of vertices, and their weight
    sums = np.empty((room, 3), dtype=np.uint64)  # two to recognize the set, and the bits of the environments
    parents = np.empty(room, dtype=np.int32)
    table = np.full(1024, -1, dtype=np.int32)
    stamps = np.full(count, -1, dtype=np.int32)  # 2·state + label of the last set that held a vertex
    now, later = np.empty(count, dtype=np.int32), np.empty(count, dtype=np.int32)
    now_starts, later_starts = np.empty(count + 1, dtype=np.int32), np.empty(count + 1, dtype=np.int32)
    images = np.empty((2, count), dtype=np.int32)
    anchors, anchor_starts, members = np.empty(16, dtype=np.int32), np.empty(17, dtype=np.int64), np.empty(256, dtype=np.int32)
    anchor_starts[0] = 0

    images[0, : len(begins)] = begins
    end, sums[0, 0], sums[0, 1], sizes[0, 1], sums[0, 2] = _collect(images[0], len(begins), stamps, -2, now, 0, weights, parts)
    sizes[0, 0], parents[0], now_starts[0], now_starts[1] = end, 0, 0, end
    table[np.int64(sums[0, 0]) & (len(table) - 1)] = 0
    # The number of states, those of the level that comes next, and the number of cycles.
    counts = np.array([1, 0, 1, 0], dtype=np.int64)
    return (
        counts,
        successors,
        sizes,
        sums,
        anchors,
        anchor_starts,
        members,
        parents,
        table,
        stamps,
        now,
        later,
        now_starts,
        later_starts,
        images,
    )


@kernel
def construct(arcs, weights, parts, most, visits, work):  # type: ignore[no-untyped-def]
    """Go on with the deterministic automaton, whose states are in the order of a breadth-first search.

    Parameters
    ----------
    arcs, weights, parts
        As for `begun`.
    most
        The number of states at which to give up, at most 2³⁰.
    visits
        After so many visits of vertices, pause at the next level of the search.
    work
        What `begun` has returned, or an earlier call after its outcome.

    Returns
    -------
    tuple
        Outcome (`DONE`, `TOO_MANY` or `PAUSED`), and the construction: counts (states, the first of the next level, and the one past its
        last, cycles), successors (−1 for none), sizes and weights, sums (the third: environments met as bits), anchors of cycles (one state
        of each), where the set of each anchor starts in an array, that array; and what only a further call needs. Arrays are longer than
        filled, and are used by the next call.
    """
    (
        counts,
        successors,
        sizes,
        sums,
        anchors,
        anchor_starts,
        members,
        parents,
        table,
        stamps,
        now,
        later,
        now_starts,
        later_starts,
        images,
    ) = work
    states, level_start, level_stop, cycles = counts[0], counts[1], counts[2], counts[3]
    room = np.int64(len(successors))
    visited = np.int64(0)
    outcome = DONE
    while level_start < level_stop:
        if visited >= visits:
            outcome = PAUSED
            break
        end = 0
        for state in range(level_start, level_stop):
            begin, stop = now_starts[state - level_start], now_starts[state - level_start + 1]
            visited += stop - begin
            still = bumped = 0
            for i in range(begin, stop):
                arc = arcs[now[i]]
                # Both are written and one is kept: no branch that the processor would mispredict.
                images[0, still] = arc
                images[1, bumped] = ~arc
                still += arc >= 0
                bumped += arc < 0
            for label in range(2):
                candidates = bumped if label else still
                if candidates == 0:
                    successors[state, label] = -1
                    continue
                after, first, second, weight, met = _collect(
                    images[label], candidates, stamps, 2 * state + label, later, end, weights, parts
                )
                slot = _find(table, sums, sizes, first, second, after - end)
                if table[slot] < 0:
                    if states >= most:
                        counts[0] = states
                        return TOO_MANY, (
                            counts,
                            successors,
                            sizes,
                            sums,
                            anchors,
                            anchor_starts,
                            members,
                            parents,
                            table,
                            stamps,
                            now,
                            later,
                            now_starts,
                            later_starts,
                            images,
                        )
                    if states == room:
                        room *= 2
                        successors, parents = _grown_rows(successors, room), _grown(parents, room)
                        sizes, sums = _grown_rows(sizes, room), _grown_rows(sums, room)
                    sizes[states, 0], sizes[states, 1], parents[states] = after - end, weight, states
                    sums[states, 0], sums[states, 1], sums[states, 2] = first, second, met
                    table[slot] = states
                    successors[state, label] = states
                    later_starts[states - level_stop] = end
                    end = after
                    states += 1
                    if 2 * states > len(table):
                        table = _larger_table(sums, sizes, states, 4 * len(table))
                else:
                    successors[state, label] = table[slot]
            if still == 0 or bumped == 0:
                target = successors[state, 0 if bumped == 0 else 1]
                if _root(parents, target) != state:
                    parents[state] = target
                    continue
                if cycles == len(anchors):
                    anchors, anchor_starts = _grown(anchors, 2 * cycles), _grown(anchor_starts, 2 * cycles + 1)
                size = np.int64(stop - begin)
                while anchor_starts[cycles] + size > len(members):
                    members = _grown(members, 2 * len(members))
                for i in range(size):
                    members[anchor_starts[cycles] + i] = now[begin + i]
                anchors[cycles] = state
                anchor_starts[cycles + 1] = anchor_starts[cycles] + size
                cycles += 1
        later_starts[states - level_stop] = end
        level_start, level_stop = level_stop, states
        now, later = later, now
        now_starts, later_starts = later_starts, now_starts
    counts[0], counts[1], counts[2], counts[3] = states, level_start, level_stop, cycles
    return outcome, (
        counts,
        successors,
        sizes,
        sums,
        anchors,
        anchor_starts,
        members,
        parents,
        table,
        stamps,
        now,
        later,
        now_starts,
        later_starts,
        images,
    )


@kernel
def depth_of(successors, colours):  # type: ignore[no-untyped-def]
    """Return the largest number of steps until a knowledge cycle is reached; its states have colours above 1.

    Without the cycles the automaton is a directed acyclic graph: its states are passed in topological order.
    """
    count = len(successors)
    waiting = np.zeros(count, dtype=np.int32)
    for state in range(count):
        if colours[state] == 1:
            for label in range(2):
                if successors[state, label] >= 0:
                    waiting[successors[state, label]] += 1
    depths, ready = np.zeros(count, dtype=np.int32), np.empty(count, dtype=np.int32)
    ready[0], queued, deepest = 0, 1, 0
    for at in range(count):
        if at == queued:
            break
        state = ready[at]
        if colours[state] > 1:
            deepest = max(deepest, depths[state])
            continue
        for label in range(2):
            target = successors[state, label]
            if target >= 0:
                depths[target] = max(depths[target], depths[state] + 1)
                waiting[target] -= 1
                if waiting[target] == 0:
                    ready[queued] = target
                    queued += 1
    return deepest
