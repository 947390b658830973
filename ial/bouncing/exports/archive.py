"""`plain_archive`, `plain_piece_archive`: filters as archives of plain arrays for other tools; filter files of ial hold more."""

import io
from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from ial.bouncing.exports.exported_filter import ExportedFilter
from ial.bouncing.filters.piece_filter import PieceFilter


def plain_archive(exported: ExportedFilter) -> bytes:
    """Return the content of an ``.npz``, in which nothing is pickled.

    Notes
    -----
    N states with the trap, K environments, P places, H headings, C classes of headings that no robot can tell apart:

    ============================  ==============  =======================================================================
    array                         shape           holds
    ============================  ==============  =======================================================================
    ``next``                      (N, 2) int32    the state after no bump and after a bump; 0 is the start, N − 1 the trap
    ``colour``                    (N,) int32      1 until localized, then 2 + number of the knowledge cycle; the trap is last
    ``size``                      (N,) int64      in how many configurations the robot can be
    ``environments``              (N,) uint64     in which environments: bit i stands for environment i
    ``name``                      (K,) text       the environments
    ``corner_m``                  (K, 2) float64  the lower left corner of cell (0, 0), x and y
    ``cell_m``                    () float64      the width of a cell
    ``heading_deg``               (H,) float64    counter-clockwise from the x axis
    ``place_start``, ``place``    (N + 1,), (…)   the places of state s: ``place[place_start[s]:place_start[s + 1]]``
    ``place_environment``         (P,) int64      the environment of a place
    ``place_row``                 (P,) int64      its row of cells, from 0 at the bottom
    ``place_column``              (P,) int64      its column of cells, from 0 at the left
    ``place_class``               (P,) int64      its class of headings
    ``class_start``, ``heading``  (C + 1,), (H,)  the headings of class c: ``heading[class_start[c]:class_start[c + 1]]``
    ============================  ==============  =======================================================================

    The arrays of places and classes are missing if the filter was minimized. Coordinates are the nearest doubles.
    """
    table, setting, places = exported.table, exported.setting, exported.places
    arrays: dict[str, npt.NDArray[Any]] = {
        "next": table.successors,
        "colour": table.colours,
        "size": table.uncertainty,
        "environments": table.environments,
        "name": np.array(setting.names),
        "corner_m": np.array([[float(x), float(y)] for x, y in setting.corners]),
        "cell_m": np.array(float(setting.cell)),
        "heading_deg": np.array([float(setting.headings.angle_deg(heading)) for heading in range(setting.headings.count)]),
    }
    if places is not None:
        arrays |= {
            "place_start": places.starts,
            "place": places.places,
            "place_environment": places.environment,
            "place_row": places.row,
            "place_column": places.column,
            "place_class": places.heading_class,
            "class_start": places.class_starts,
            "heading": places.class_headings,
        }
    return _archive(arrays)


def plain_piece_archive(made: PieceFilter) -> bytes:
    """Return the content of an ``.npz`` about pieces of walls, in which nothing is pickled.

    Notes
    -----
    P parts of walls and H headings; piece heading · P + part is a part that the robot leaves in headings from heading · 360° / H to the
    next multiple. A arcs, F pieces for the first bump:

    ============================  ==============  =======================================================================
    array                         shape           holds
    ============================  ==============  =======================================================================
    ``name``                      () text         the environment
    ``headings``                  () int64        H
    ``turn``                      (2,) int64      by how many headings a bump turns the robot, at least and at most
    ``box_m``                     (P, 4) float64  rectangles that hold the parts: least x and y, greatest x and y
    ``arc_start``                 (P·H + 1,)      the arcs of piece i: from ``arc_start[i]`` on, before ``arc_start[i + 1]``
    ``arc_part``                  (A,) int32      to which part an arc leads; the heading follows from that of the piece and the turn
    ``arc_least``, ``arc_most``   (A,) int32      after how many steps the robot bumps there, at least and at most
    ``first``                     (F,) int32      the pieces after the first bump; none if nothing is known of the start
    ``first_least``               (F,) int32      after how many steps, at least
    ``first_most``                (F,) int32      and at most
    ============================  ==============  =======================================================================
    """
    map_, none = made.map, np.empty(0, dtype=np.int32)
    first = (none, none, none) if made.first is None else (made.first.pieces, made.first.least, made.first.most)
    boxes = np.array([map_.bounds_m([part]) for part in range(int(map_.parts.sum()))])
    arrays: dict[str, npt.NDArray[Any]] = {
        "name": np.array(made.name),
        "headings": np.array(map_.headings),
        "turn": np.array(map_.turns),
        "box_m": boxes,
        "arc_start": map_.starts,
        "arc_part": map_.ends,
        "arc_least": map_.least,
        "arc_most": map_.most,
    }
    return _archive(arrays | dict(zip(("first", "first_least", "first_most"), first, strict=True)))


def _archive(arrays: Mapping[str, npt.NDArray[Any]]) -> bytes:
    content = io.BytesIO()
    np.savez_compressed(content, **arrays)  # type: ignore[arg-type]
    return content.getvalue()
