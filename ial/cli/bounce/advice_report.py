"""What `ial bounce advise` says about filters that might be built."""

from collections.abc import Iterator
from string import ascii_lowercase
from typing import Any

from ial.bouncing.planning.advice import Advice
from ial.bouncing.planning.cell_choice import CellChoice
from ial.bouncing.planning.piece_choice import PieceChoice
from ial.cli.bounce.report import offsets_aside

_TITLES = ("", "filter", "width", "headings", "size", "states", "flash", "RAM", "places")
_LEFT = 2  # so many columns are flush left


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


def lines(advice: Advice) -> Iterator[str]:
    """Yield the lines to print: a table, and what is said below it. Its lines are as long as they must be, on a terminal of any width."""
    rows = [_TITLES, *_rows(advice)]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        cells = (text.ljust(width) if at < _LEFT else text.rjust(width) for at, (text, width) in enumerate(zip(row, widths, strict=True)))
        yield "  ".join(cells).rstrip()
    yield ""
    for letter, fault in zip(ascii_lowercase, _faults(advice), strict=False):
        yield f"{letter}: {fault}"
    aside: dict[int, tuple[float, float]] = {}
    for choice in advice.cells:
        degrees, length = aside.get(choice.headings, (0.0, 0.0))
        aside[choice.headings] = max(degrees, choice.offset_errors[0]), max(length, choice.offset_errors[1])
    told = [f"of {count} headings {text}" for count, errors in aside.items() if (text := offsets_aside(*errors))]
    if told:
        yield f"steps of the cell map are not those of a robot: {'; '.join(told)}"
    if advice.no_pieces and advice.best:
        yield f"no filter of rays: {advice.no_pieces}"
    yield f"{'take the row marked *' if advice.best else 'take none of these'}: {advice.reason}"


def _rows(advice: Advice) -> Iterator[tuple[str, ...]]:
    """Yield the texts of a row for each choice: of cells by their rule, of rays; the one to take has a star."""
    letters = dict(zip(_faults(advice), ascii_lowercase, strict=False))
    for choice in advice.cells:
        states = f"> {choice.more_than:,}" if choice.more_than is not None else _number(choice.states)
        told = choice.refusal or (f"wrong: {''.join(sorted(letters[each] for each in choice.faults))}" if choice.faults else "right")
        sizes = _number(choice.configurations), states, _number(choice.flash_bytes), _number(choice.ram_bytes), told
        yield "*" * (choice is advice.best), choice.rule, f"{float(choice.cell_m):g} m", str(choice.headings), *sizes
    for piece in advice.pieces:
        told = "too much work" if piece.flash_bytes is None else "right"
        sizes = _number(piece.pieces), "", _number(piece.flash_bytes), _number(piece.ram_bytes), told
        yield "*" * (piece is advice.best), "rays", f"{float(piece.part_m):g} m", str(piece.headings), *sizes


def _faults(advice: Advice) -> list[str]:
    """Return the faults of all choices, each once."""
    return list(dict.fromkeys(fault for choice in advice.cells for fault in choice.faults))


def _number(value: int | None) -> str:
    return "" if value is None else f"{value:,}"
