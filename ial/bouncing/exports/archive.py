"""`plain_archive`: a filter as an archive of plain arrays for other tools; the filter files of ial hold more, in a form of their own."""

import io

import numpy as np

from ial.bouncing.exports.exported_filter import ExportedFilter


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
    arrays = {
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
    content = io.BytesIO()
    np.savez_compressed(content, **arrays)  # type: ignore[arg-type]
    return content.getvalue()
