"""What `ial bounce build` says about a filter of a robot with real geometry."""

from collections.abc import Iterator, Mapping
from typing import Any

from ial.bouncing.exports.piece_source import PieceTables
from ial.bouncing.filters.piece_filter import PieceFilter


def about(made: PieceFilter) -> dict[str, Any]:
    """Return what a filter is, as plain values that JSON can hold."""
    tables, bounds, goal = PieceTables.of(made.map, "bounce", made.first), made.bounds, made.goal
    return {
        "environment": made.name,
        "bounce_deg": float(made.bounce_deg),
        "step_m": float(made.step_m),
        "radius_m": float(made.radius_m),
        "turn_error_deg": float(bounds.turn_deg),
        "step_error": float(bounds.step),
        "count_error": bounds.count,
        "headings": made.map.headings,
        "parts": int(made.map.parts.sum()),
        "pieces": len(made.map),
        "arcs": len(made.map.ends),
        "first_pieces": None if made.first is None else len(made.first),
        "rooms": [room.name for room in goal.rooms],
        "within_m": None if goal.width is None else float(goal.width),
        "flash_bytes": tables.flash_bytes,
        "ram_bytes": tables.ram_bytes,
    }


def lines(record: Mapping[str, Any]) -> Iterator[str]:
    """Yield the lines to print."""
    yield (
        f"{record['environment']}: {record['pieces']} pieces ({record['parts']} parts of walls, {record['headings']} headings), "
        f"{record['arcs']} arcs"
    )
    robot = f"a disk of radius {record['radius_m']:g} m" if record["radius_m"] else "a point"
    yield (
        f"{robot} with real geometry; turns of {record['bounce_deg']:g}° ± {record['turn_error_deg']:g}°, "
        f"steps of {record['step_m']:g} m ± {100 * record['step_error']:g} %, counts ± {record['count_error']}"
    )
    if record["first_pieces"] is not None:
        yield f"by what is known of its start, it leaves its first bump from one of {record['first_pieces']} pieces"
    where = f"in {' or '.join(record['rooms'])}" if record["rooms"] else f"within {record['within_m']:g} m"
    yield f"localized is a robot whose last bump was {where}"
    yield f"as a C header: {record['flash_bytes']:,} bytes of flash, {record['ram_bytes']:,} of RAM"
