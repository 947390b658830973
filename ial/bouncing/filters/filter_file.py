"""Filters on disk: a NumPy archive (.npz) with a version and a checksum of everything in it."""

import hashlib
import json
import zipfile
import zlib
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ial.bouncing.automata.table import FilterTable
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.bouncing.filters.cycle_places import CyclePlaces
from ial.bouncing.filters.goal import Goal
from ial.bouncing.filters.piece_filter import PieceFilter
from ial.bouncing.filters.robust_filter import RobustFilter
from ial.bouncing.filters.setting import Setting
from ial.bouncing.filters.state_places import StatePlaces
from ial.bouncing.rays.first_bump import FirstBumps
from ial.bouncing.rays.piece_map import PieceMap
from ial.errors import FilterError, IalError
from ial.maps.polygons.walls import Walls
from ial.whole_file import whole_files

_VERSION = 1
_EXACT, _ROBUST, _PIECES = "ial bounce filter", "ial robust bounce filter", "ial piece filter"
_TABLE = {"successors": np.int32, "colours": np.int32, "uncertainty": np.int64, "environments": np.uint64}
_CELL = ("environment", "row", "column", "heading_class")
_PLACES: dict[str, dict[str, type[np.generic]]] = {
    _EXACT: dict.fromkeys((*_CELL, "following", "anchors", "members"), np.int32) | {"starts": np.int64},
    _ROBUST: dict.fromkeys((*_CELL, "starts", "places", "class_starts", "class_headings"), np.int64),
}
_WALLS: dict[str, type[np.generic]] = {
    **dict.fromkeys(("x", "y", "bulge", "tilt"), np.float64),
    **dict.fromkeys(("after", "before", "bend"), np.int32),
}
_ARCS: dict[str, type[np.generic]] = {"parts": np.int64, "starts": np.int64, "ends": np.int32, "least": np.int32, "most": np.int32}
_FIRST: dict[str, type[np.generic]] = dict.fromkeys(("first_pieces", "first_least", "first_most"), np.int32)
_ARRAYS = {form: _TABLE | places for form, places in _PLACES.items()} | {_PIECES: _WALLS | _ARCS | _FIRST}
Filter = BounceFilter | RobustFilter | PieceFilter
Arrays = dict[str, npt.NDArray[Any]]


def _checksum(setting: dict[str, Any], arrays: Arrays) -> str:
    digest = hashlib.sha256(json.dumps(setting, sort_keys=True).encode())
    for name in sorted(arrays):
        digest.update(f"{name} {arrays[name].shape}".encode())
        digest.update(np.ascontiguousarray(arrays[name].astype(arrays[name].dtype.newbyteorder("<"))).data)
    return digest.hexdigest()


def write_filter(made: Filter, path: str | Path) -> None:
    """Write a filter; the file appears when it is complete.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    if isinstance(made, PieceFilter):
        form, setting = _PIECES, _piece_record(made)
        arrays = {name: getattr(made.map.walls, name) for name in _WALLS} | {name: getattr(made.map, name) for name in _ARCS}
        arrays |= {
            name: np.empty(0, np.int32) if made.first is None else getattr(made.first, name.removeprefix("first_")) for name in _FIRST
        }
    else:
        form, setting = _EXACT, made.setting.record()
        if isinstance(made, RobustFilter):
            form, setting = _ROBUST, setting | {"bounds": made.bounds.record(), "goal": made.goal.record(), "growth": str(made.growth)}
        arrays = {name: getattr(made.table, name) for name in _TABLE} | {name: getattr(made.places, name) for name in _PLACES[form]}
    about = {"form": form, "version": _VERSION, "setting": setting, "sha256": _checksum(setting, arrays)}
    with whole_files(path, what="the filter") as (lent,), lent.open("wb") as file:
        np.savez_compressed(file, about=np.frombuffer(json.dumps(about).encode(), dtype=np.uint8), **arrays)


def read_filter(path: str | Path) -> Filter:
    """Read a filter.

    Raises
    ------
    FilterError
        If the file is missing, truncated or damaged, no filter, or of another version.
    """
    path = Path(path)
    try:
        with path.open("rb") as file, np.load(file, allow_pickle=False) as archive:
            about = json.loads(archive["about"].tobytes())
            form, version = about["form"], about["version"]
            if version == _VERSION and form in _ARRAYS:
                arrays = {name: archive[name] for name in _ARRAYS[form]}
    except OSError as error:
        raise FilterError(f"{path}: the filter cannot be read ({error.strerror or error}); check the path") from None
    except (ValueError, KeyError, TypeError, EOFError, AttributeError, NotImplementedError, zipfile.BadZipFile, zlib.error):
        raise FilterError(f"{path}: no filter that ial has written, or a truncated one; build it again with `ial bounce build`") from None
    if version != _VERSION or form not in _ARRAYS:
        raise FilterError(f"{path}: a filter of version {version}, and this ial reads {_VERSION}; build it again with `ial bounce build`")
    try:
        if any(arrays[name].dtype != kind for name, kind in _ARRAYS[form].items()):
            raise ValueError("an array of another type")
        if _checksum(about["setting"], arrays) != about["sha256"]:
            raise ValueError("another checksum")
        return _made(form, about["setting"], arrays)
    except (ValueError, KeyError, TypeError, ZeroDivisionError, IalError):
        raise FilterError(f"{path}: the filter is damaged: its checksum differs; build it again with `ial bounce build`") from None


def _made(form: str, record: dict[str, Any], arrays: Arrays) -> Filter:
    if form == _PIECES:
        return _piece_filter(record, arrays)
    setting, table = Setting.of_record(record), FilterTable(**{name: arrays[name] for name in _TABLE})
    places = {name: arrays[name] for name in _PLACES[form]}
    if form == _EXACT:
        return BounceFilter(table, CyclePlaces(**places), setting)
    bounds, goal = ExecutionBounds.of_record(record["bounds"]), Goal.of_record(record["goal"])
    return RobustFilter(table, StatePlaces(**places), setting, bounds, goal, Fraction(record["growth"]))


def _piece_record(made: PieceFilter) -> dict[str, Any]:
    return {
        "name": made.name,
        "bounce_deg": str(made.bounce_deg),
        "step_m": str(made.step_m),
        "radius_m": str(made.radius_m),
        "bounds": made.bounds.record(),
        "goal": made.goal.record(),
        "origin": [str(each) for each in made.map.walls.origin],
        "headings": made.map.headings,
        "turns": list(made.map.turns),
    }


def _piece_filter(record: dict[str, Any], arrays: Arrays) -> PieceFilter:
    x, y = (Fraction(each) for each in record["origin"])
    least, most = record["turns"]
    walls = Walls(**{name: arrays[name] for name in _WALLS}, origin=(x, y))
    pieces = PieceMap(walls=walls, headings=record["headings"], turns=(least, most), **{name: arrays[name] for name in _ARCS})
    angle, step = Fraction(record["bounce_deg"]), Fraction(record["step_m"])
    bounds, goal = ExecutionBounds.of_record(record["bounds"]), Goal.of_record(record["goal"])
    first = FirstBumps(*(arrays[name] for name in _FIRST)) if len(arrays["first_pieces"]) else None
    return PieceFilter(pieces, record["name"], angle, step, bounds, goal, Fraction(record["radius_m"]), first)
