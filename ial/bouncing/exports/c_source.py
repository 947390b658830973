"""`c_header`: a filter as one C99 header: constant tables, and inline functions that look up in them; no heap, no floating point."""

from collections.abc import Mapping

from ial.bouncing.exports.c_array import CArray
from ial.bouncing.exports.c_tables import CTables
from ial.bouncing.exports.exported_filter import ExportedFilter

_STEPPING = """\
/* What else keeps the tables in flash: nothing, but for avr-gcc (-std=gnu99), which copies them to RAM without it: __flash, or
   __memx for a program of more than 64 KiB. */
#ifndef {P}_FLASH
#define {P}_FLASH
#endif

/* What is known; begin with {P}_START. Other numbers than 0 to {P}_TRAP are no states. */
typedef uint{state}_t {p}_state;
#define {P}_START 0
#define {P}_TRAP {trap}
#define {P}_STATES {states}
#define {P}_TRAP_COLOUR {trap_colour}
"""

_FUNCTIONS = """\
/* The state after an observation: bump is not 0 if the step ended in one. */
static inline {p}_state {p}_step({p}_state state, int bump) {{ return {next_at}; }}

static inline uint{colour}_t {p}_colour({p}_state state) {{ return {colour_at}; }}

/* Whether the observations fit no place: the robot is elsewhere, was carried, or erred.
   {trap_says} */
static inline int {p}_trapped({p}_state state) {{ return state == {P}_TRAP; }}

/* Whether the robot knows as much as can ever be known. */
static inline int {p}_localized({p}_state state) {{ return {colour_at} > 1 && state != {P}_TRAP; }}

static inline uint{size}_t {p}_size({p}_state state) {{ return {size_at}; }}

/* In which environments it can be: bit i stands for environment i. */
static inline uint{mask}_t {p}_environment_mask({p}_state state) {{ return {mask_at}; }}
"""

_PLACES = """\
/* A place: cell (row, column) of an environment; its centre is (column + 1/2, row + 1/2) cells from the corner given above. */
typedef struct {{
    uint{environment}_t environment;
    uint{row}_t row;
    uint{column}_t column;
    uint{heading_class}_t heading_class;
}} {p}_place_t;

/* How many places a state has: 0 outside of knowledge cycles, where they are not kept. */
static inline uint{start}_t {p}_place_count({p}_state state) {{
    return (uint{start}_t)({start_after} - {start_at});
}}

/* Place i of a state, i from 0 to {p}_place_count(state) - 1. */
static inline {p}_place_t {p}_place({p}_state state, uint{start}_t i) {{
    const uint{place}_t at = {place_at};
    const {p}_place_t place = {{{environment_at}, {row_at}, {column_at}, {heading_class_at}}};
    return place;
}}

static inline uint{class_start}_t {p}_heading_count({p}_place_t place) {{
    return (uint{class_start}_t)({class_after} - {class_at});
}}

/* Heading i of a place, i from 0 to {p}_heading_count(place) - 1. */
static inline uint{heading}_t {p}_heading({p}_place_t place, uint{class_start}_t i) {{
    return {heading_at};
}}
"""


def c_header(exported: ExportedFilter, prefix: str = "bounce") -> str:
    """Return the text of a header for C99 and C++11.

    Parameters
    ----------
    exported
        The filter.
    prefix
        What all names in it begin with; those of macros in capitals.

    Raises
    ------
    ConfigError
        If the prefix is no identifier.
    """
    tables, table = CTables.of(exported, prefix), exported.table
    arrays = {each.name.removeprefix(f"{prefix}_"): each for each in (*tables.stepping, *tables.telling)}
    restarts = bool(table.successors[table.trap, 0] != table.trap)
    words = {
        "p": prefix,
        "P": prefix.upper(),
        "state": tables.state_bits,
        "states": len(table),
        "trap": table.trap,
        "trap_colour": int(table.colours[table.trap]),
        "trap_says": "The next step starts anew." if restarts else "It stays so; start anew if the robot may have been carried.",
        "colour": arrays["colours"].width,
        "size": arrays["sizes"].width,
        "mask": arrays["environments"].width,
        "next_at": arrays["next"].element("state", "bump != 0"),
        "colour_at": arrays["colours"].element("state"),
        "size_at": arrays["sizes"].element("state"),
        "mask_at": arrays["environments"].element("state"),
    }
    comment = "\n".join(f" * {line}" for line in ("A filter that localizes a bouncing robot, written by ial.", *exported.about()))
    memory = (
        f" * Flash: {tables.stepping_bytes} bytes for steps and colours, {tables.flash_bytes} with all tables; "
        f"tables that are not used are left out.\n * RAM: {tables.ram_bytes} byte{'s' * (tables.ram_bytes != 1)} for the state."
    )
    guard = f"{prefix.upper()}_FILTER_H"
    parts = [f"/*\n{comment}\n{memory}\n */\n#ifndef {guard}\n#define {guard}\n\n#include <stdint.h>\n", _STEPPING.format(**words)]
    parts += [each.declaration(f"{prefix.upper()}_FLASH") for each in arrays.values()]
    parts.append(_FUNCTIONS.format(**words))
    if exported.places is not None:
        parts.append(_PLACES.format(**words, **_place_words(arrays)))
    return "\n".join([*parts, "#endif\n"])


def _place_words(arrays: Mapping[str, CArray]) -> dict[str, object]:
    """Return the types and the elements of the tables of places."""
    start, starts = arrays["place_starts"].element("state"), arrays["class_starts"]
    first = starts.element("place.heading_class")
    widths = {
        "start": "place_starts",
        "place": "places",
        "environment": "place_environments",
        "row": "place_rows",
        "column": "place_columns",
        "heading_class": "place_classes",
        "class_start": "class_starts",
        "heading": "class_headings",
    }
    return {word: arrays[name].width for word, name in widths.items()} | {
        "start_at": start,
        "start_after": arrays["place_starts"].element("(uint32_t)state + 1u"),
        "place_at": arrays["places"].element(f"(uint32_t){start} + i"),
        "environment_at": arrays["place_environments"].element("at"),
        "row_at": arrays["place_rows"].element("at"),
        "column_at": arrays["place_columns"].element("at"),
        "heading_class_at": arrays["place_classes"].element("at"),
        "class_at": first,
        "class_after": starts.element("place.heading_class + 1u"),
        "heading_at": arrays["class_headings"].element(f"{first} + i"),
    }
