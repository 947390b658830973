"""What `ial bounce advise` says about filters that might be built."""

from typing import Any

from rich.table import Table

from ial.bouncing.planning.advice import Advice
from ial.bouncing.planning.cell_choice import CellChoice
from ial.bouncing.planning.piece_choice import PieceChoice
from ial.cli.bounce.report import offsets_aside

_RIGHT = "right, from the centre of a cell"


def about(advice: Advice) -> dict[str, Any]:
    """Return what was computed, as plain values that JSON can hold."""
    return {
        "cells": [{**_about_cells(each), "advised": each is advice.best} for each in advice.cells],
        "rays": [{**_about_pieces(each), "advised": each is advice.best} for each in advice.pieces],
        "no_rays": advice.no_pieces,
        "reason": advice.reason,
    }


def _about_cells(choice: CellChoice) -> dict[str, Any]:
    return {
        "cell_m": float(choice.cell_m),
        "headings": choice.headings,
        "rule": choice.rule,
        "refusal": choice.refusal,
        "faults": list(choice.faults),
        "offset_error_deg": choice.offset_errors[0],
        "offset_error": choice.offset_errors[1],
        "configurations": choice.configurations,
        "states": choice.states,
        "more_than_states": choice.more_than,
        "flash_bytes": choice.flash_bytes,
        "stepping_bytes": choice.stepping_bytes,
        "ram_bytes": choice.ram_bytes,
    }


def _about_pieces(choice: PieceChoice) -> dict[str, Any]:
    return {
        "part_m": float(choice.part_m),
        "headings": choice.headings,
        "pieces": choice.pieces,
        "flash_bytes": choice.flash_bytes,
        "ram_bytes": choice.ram_bytes,
    }


def table(advice: Advice) -> Table:
    """Return a row for each choice; the one to take has a star."""
    made = Table("", "filter", box=None, pad_edge=False, header_style="bold")
    for name in ("width", "headings"):
        made.add_column(name, justify="right")
    made.add_column("rule")
    for name in ("size", "states", "flash", "RAM"):
        made.add_column(name, justify="right")
    made.add_column("for this robot")
    for choice in advice.cells:
        made.add_row("*" if choice is advice.best else "", *_cell_texts(choice))
    for piece in advice.pieces:
        size = f"{piece.pieces:,}"
        told = (_number(piece.flash_bytes, " B"), _number(piece.ram_bytes, " B"), "right" if piece.flash_bytes else "too much work")
        made.add_row("*" if piece is advice.best else "", "rays", f"{float(piece.part_m):g} m", str(piece.headings), "", size, "", *told)
    return made


def _cell_texts(choice: CellChoice) -> tuple[str, ...]:
    states = f"> {choice.more_than:,}" if choice.more_than is not None else _number(choice.states)
    told = f"wrong: {', '.join(choice.faults)}" if choice.faults else _RIGHT
    if aside := offsets_aside(*choice.offset_errors):
        told += f" ({aside})"
    return (
        "cells",
        f"{float(choice.cell_m):g} m",
        str(choice.headings),
        choice.rule,
        _number(choice.configurations),
        states,
        _number(choice.flash_bytes, " B"),
        _number(choice.ram_bytes, " B"),
        choice.refusal or told,
    )


def _number(value: int | None, unit: str = "") -> str:
    return "" if value is None else f"{value:,}{unit}"
