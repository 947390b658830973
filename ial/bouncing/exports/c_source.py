"""`c_header`: a filter as one C99 header: constant tables, and inline functions that look up in them; no heap, no floating point."""

from ial.bouncing.exports.c_tables import CTables
from ial.bouncing.exports.exported_filter import ExportedFilter

_STEPPING = """\
/* What else keeps the tables in flash: __flash for avr-gcc (-std=gnu99), which copies them to RAM without it; nothing elsewhere. */
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
static inline {p}_state {p}_step({p}_state state, int bump) {{ return {p}_next[state][bump != 0]; }}

static inline uint{colour}_t {p}_colour({p}_state state) {{ return {p}_colours[state]; }}

/* Whether the observations fit no place: the robot is elsewhere, was carried, or erred.
   {trap_says} */
static inline int {p}_trapped({p}_state state) {{ return state == {P}_TRAP; }}

/* Whether the robot knows as much as can ever be known. */
static inline int {p}_localized({p}_state state) {{ return {p}_colours[state] > 1 && state != {P}_TRAP; }}

static inline uint{size}_t {p}_size({p}_state state) {{ return {p}_sizes[state]; }}
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
    return (uint{start}_t)({p}_place_starts[state + 1u] - {p}_place_starts[state]);
}}

/* Place i of a state, i from 0 to {p}_place_count(state) - 1. */
static inline {p}_place_t {p}_place({p}_state state, uint{start}_t i) {{
    const uint{place}_t at = {p}_places[{p}_place_starts[state] + i];
    const {p}_place_t place = {{{p}_place_environments[at], {p}_place_rows[at], {p}_place_columns[at], {p}_place_classes[at]}};
    return place;
}}

static inline uint{class_start}_t {p}_heading_count({p}_place_t place) {{
    return (uint{class_start}_t)({p}_class_starts[place.heading_class + 1u] - {p}_class_starts[place.heading_class]);
}}

/* Heading i of a place, i from 0 to {p}_heading_count(place) - 1. */
static inline uint{heading}_t {p}_heading({p}_place_t place, uint{class_start}_t i) {{
    return {p}_class_headings[{p}_class_starts[place.heading_class] + i];
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
        parts.append(_PLACES.format(**words, **{word: arrays[name].width for word, name in widths.items()}))
    return "\n".join([*parts, "#endif\n"])
