"""`c_piece_header`: the set filter of a robot with errors as one C99 header: constant tables, and a row of bits for what is known."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.bouncing.exports.c_array import CArray, width_of
from ial.bouncing.exports.identifier import check_identifier
from ial.bouncing.rays.first_bump import FirstBumps
from ial.bouncing.rays.piece_map import PieceMap
from ial.errors import FilterError

_MOST_STEPS = 2**16 - 1  # the counter stays there

_HEADER = """\
/*
 * A filter that localizes a bouncing robot with bounded errors, written by ial.
 * {pieces} pieces of walls with headings, {arcs} arcs. Coordinates count millimetres from x {x} m, y {y} m.
 * Flash: {flash} bytes. RAM: {ram} bytes for {p}_filter.
 */
#ifndef {P}_FILTER_H
#define {P}_FILTER_H

#include <stdint.h>

/* What else keeps the tables in flash: nothing, but for avr-gcc (-std=gnu99), which copies them to RAM without it: __flash, or
   __memx for a program of more than 64 KiB. */
#ifndef {P}_FLASH
#define {P}_FLASH
#endif

#define {P}_PIECES {pieces}u
#define {P}_PARTS {parts}u
#define {P}_HEADINGS {headings}u
#define {P}_BYTES {bytes}u
"""

_FUNCTIONS = """\
/* What is known: a bit for each piece that the robot may have left from, and the steps since then. */
typedef struct {{
    uint8_t held[{P}_BYTES];
    uint8_t next[{P}_BYTES];
    uint16_t steps;
    uint8_t arriving;
    uint8_t trapped;
}} {p}_filter;

/* A rectangle, in millimetres. */
typedef struct {{
    uint{mm}_t x0, y0, x1, y1;
}} {p}_box_t;

/* Begin: the robot {begins}, and has not bumped yet. */
static inline void {p}_start({p}_filter *filter) {{
    uint{byte}_t i;
    for (i = 0; i < {P}_BYTES; i++) {{
        filter->held[i] = 0;
    }}
    filter->steps = 0;
    filter->arriving = 1;
    filter->trapped = 0;
}}

/* Take an observation: bump is not 0 if the step ended in one. Returns 0 if the observations fit no place; then start anew. */
static inline int {p}_update({p}_filter *filter, int bump) {{
    uint{byte}_t i;
    uint8_t any = 0;
    if (filter->trapped) {{
        return 0;
    }}
    if (!bump && filter->steps < 65535u) {{
        filter->steps++;
    }}
    if (filter->arriving) {{
        any = filter->steps <= {longest_first}u;
        if (bump && any) {{
{first_bump}        }}
    }} else {{
        for (i = 0; i < {P}_BYTES; i++) {{
            filter->next[i] = 0;
        }}
        for (i = 0; i < {P}_BYTES; i++) {{
            uint8_t bit;
            if (filter->held[i] == 0) {{
                continue;
            }}
            for (bit = 0; bit < 8u; bit++) {{
                const uint{piece}_t piece = (uint{piece}_t)(8u * (uint32_t)i + bit);
                uint{arc}_t at, stop;
                uint{heading}_t heading;
                if (!(filter->held[i] >> bit & 1u)) {{
                    continue;
                }}
                if (!bump) {{
                    if (filter->steps <= {longest_at}) {{
                        filter->next[i] |= (uint8_t)(1u << bit);
                        any = 1;
                    }}
                    continue;
                }}
                heading = (uint{heading}_t)(piece / {P}_PARTS);
                stop = {stop_at};
                for (at = {start_at}; at < stop; at++) {{
                    uint16_t turn;
                    if (filter->steps < {least_at} || filter->steps > {most_at}) {{
                        continue;
                    }}
                    for (turn = {first_turn}u; turn <= {last_turn}u; turn++) {{
                        const uint32_t to = ((uint32_t)heading + turn) % {P}_HEADINGS * {P}_PARTS + {end_at};
                        filter->next[to >> 3] |= (uint8_t)(1u << (to & 7u));
                        any = 1;
                    }}
                }}
            }}
        }}
        for (i = 0; i < {P}_BYTES; i++) {{
            filter->held[i] = filter->next[i];
        }}
    }}
    if (bump) {{
        filter->steps = 0;
        filter->arriving = 0;
    }}
    filter->trapped = (uint8_t)!any;
    return any;
}}

/* How many pieces the robot may have left from; all of them if it has not bumped yet. */
static inline uint32_t {p}_count(const {p}_filter *filter) {{
    uint{byte}_t i;
    uint32_t count = 0;
    if (filter->arriving) {{
        return filter->trapped ? 0 : {P}_PIECES;
    }}
    for (i = 0; i < {P}_BYTES; i++) {{
        uint8_t bits;
        for (bits = filter->held[i]; bits; bits = (uint8_t)(bits & (bits - 1u))) {{
            count++;
        }}
    }}
    return count;
}}

/* The smallest rectangle that holds the place of the last bump; returns 0 if there was none, or the observations fit no place. */
static inline int {p}_box(const {p}_filter *filter, {p}_box_t *box) {{
    uint{byte}_t i;
    uint8_t any = 0;
    if (filter->arriving || filter->trapped) {{
        return 0;
    }}
    for (i = 0; i < {P}_BYTES; i++) {{
        uint8_t bit;
        for (bit = 0; bit < 8u; bit++) {{
            if (filter->held[i] >> bit & 1u) {{
                const uint{part}_t part = (uint{part}_t)((8u * (uint32_t)i + bit) % {P}_PARTS);
                const {p}_box_t one = {{{x0_at}, {y0_at}, {x1_at}, {y1_at}}};
                if (!any) {{
                    *box = one;
                    any = 1;
                }}
                box->x0 = one.x0 < box->x0 ? one.x0 : box->x0;
                box->y0 = one.y0 < box->y0 ? one.y0 : box->y0;
                box->x1 = one.x1 > box->x1 ? one.x1 : box->x1;
                box->y1 = one.y1 > box->y1 ? one.y1 : box->y1;
            }}
        }}
    }}
    return any;
}}

#endif
"""


# What a robot is in after its first bump: every piece that leads somewhere, or those of a table.
_ANYWHERE = """\
            uint{piece}_t piece;
            for (piece = 0; piece < {P}_PIECES; piece++) {{
                if ({start_at} < {stop_at}) {{
                    filter->held[piece >> 3] |= (uint8_t)(1u << (piece & 7u));
                }}
            }}
"""
_STARTED = """\
            uint32_t at;
            any = 0;
            for (at = 0; at < {first_count}u; at++) {{
                if (filter->steps >= {first_least_at} && filter->steps <= {first_most_at}) {{
                    const uint{piece}_t piece = {first_at};
                    filter->held[piece >> 3] |= (uint8_t)(1u << (piece & 7u));
                    any = 1;
                }}
            }}
"""


@dataclass(frozen=True, eq=False)
class PieceTables:
    """The tables of a set filter in C, and how much memory they take.

    Parameters
    ----------
    arrays
        The tables by their names without the prefix.
    pieces
        How many pieces there are.
    """

    arrays: dict[str, CArray]
    pieces: int

    @classmethod
    def of(cls, map_: PieceMap, prefix: str, first: FirstBumps | None = None) -> "PieceTables":
        """Return the tables of a map, and of what a robot is in after its first bump.

        Raises
        ------
        ConfigError
            If the prefix is no identifier.
        """
        check_identifier(prefix)
        x0, y0, x1, y1 = map_.boxes_mm.T
        values: dict[str, tuple[npt.NDArray[np.integer], str]] = {
            "starts": (map_.starts, "where the arcs of each piece begin in the next tables, and where they end"),
            "ends": (map_.ends, "to which part of the walls an arc leads"),
            "least": (map_.least, "after how many steps a robot bumps there, at least"),
            "most": (map_.most, "and at most"),
            "longest": (np.maximum(map_.longest, 0), "after how many steps a robot has bumped at the latest that left a piece"),
            "x0": (x0, "the least x of each part of the walls"),
            "y0": (y0, "the least y"),
            "x1": (x1, "the greatest x"),
            "y1": (y1, "the greatest y"),
        }
        if first is not None:
            values |= {
                "first": (first.pieces, "in which pieces the robot can be after its first bump"),
                "first_least": (first.least, "after how many steps, at least"),
                "first_most": (first.most, "and at most"),
            }
        return cls({name: CArray(f"{prefix}_{name}", array, comment) for name, (array, comment) in values.items()}, len(map_))

    @property
    def flash_bytes(self) -> int:
        """The bytes of flash that all tables take."""
        return sum(each.size for each in self.arrays.values())

    @property
    def ram_bytes(self) -> int:
        """The bytes of memory that a robot writes to."""
        return 2 * -(-self.pieces // 8) + 4


def c_piece_header(map_: PieceMap, prefix: str = "bounce", first: FirstBumps | None = None) -> str:
    """Return the text of a header for C99 and C++11, which follows sets as `PieceModel` does.

    Parameters
    ----------
    map_
        The pieces and their arcs.
    prefix
        What all names in it begin with; those of macros in capitals.
    first
        Where the robot can be after its first bump, if something is known of its start.

    Raises
    ------
    ConfigError
        If the prefix is no identifier.
    FilterError
        If a robot can make more steps between two bumps than fit into 16 bits.
    """
    tables = PieceTables.of(map_, prefix, first)
    arrays, count = tables.arrays, len(map_)
    if (longest := int(map_.longest.max(initial=0))) >= _MOST_STEPS:
        raise FilterError(f"there can be {longest} steps between two bumps, and the header counts up to {_MOST_STEPS}; use longer steps")
    first_turn = map_.turns[0] % map_.headings
    last_turn = first_turn + map_.turns[1] - map_.turns[0]
    millimetres = max(arrays[name].width for name in ("x0", "y0", "x1", "y1"))
    x, y = map_.walls.origin
    words = {
        "p": prefix,
        "P": prefix.upper(),
        "pieces": count,
        "parts": int(map_.parts.sum()),
        "headings": map_.headings,
        "bytes": -(-count // 8),
        "arcs": len(map_.ends),
        "x": x,
        "y": y,
        "flash": tables.flash_bytes,
        "ram": tables.ram_bytes,
        "mm": millimetres,
        "byte": max(width_of(-(-count // 8)), 16),
        "piece": max(width_of(count), 16),
        "arc": arrays["starts"].width,
        "heading": max(width_of(map_.headings), 16),
        "part": max(width_of(int(map_.parts.sum())), 16),
        "longest_first": longest if first is None else int(first.most.max()),
        "begins": "is anywhere, in any heading" if first is None else "is where it was said to start",
        "first_turn": first_turn,
        "last_turn": last_turn,
        "longest_at": arrays["longest"].element("piece"),
        "start_at": arrays["starts"].element("piece"),
        "stop_at": arrays["starts"].element("piece + 1u"),
        "least_at": arrays["least"].element("at"),
        "most_at": arrays["most"].element("at"),
        "end_at": arrays["ends"].element("at"),
        "x0_at": arrays["x0"].element("part"),
        "y0_at": arrays["y0"].element("part"),
        "x1_at": arrays["x1"].element("part"),
        "y1_at": arrays["y1"].element("part"),
    }
    if first is not None:
        words |= {f"{name}_at": arrays[name].element("at") for name in ("first", "first_least", "first_most")} | {"first_count": len(first)}
    words["first_bump"] = (_ANYWHERE if first is None else _STARTED).format(**words)
    declared = [each.declaration(f"{prefix.upper()}_FLASH") for each in arrays.values()]
    return "\n".join([_HEADER.format(**words), *declared, _FUNCTIONS.format(**words)])
